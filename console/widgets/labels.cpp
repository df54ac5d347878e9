// Labels that take their text as it is.
#include "widgets/labels.hpp"

namespace console {

QLabel* plainLabel(const QString& text, theme::TextRole role, QWidget* parent)
{
    auto* label = new QLabel(text, parent);
    label->setTextFormat(Qt::PlainText);
    theme::setTextRole(label, role);
    return label;
}

void setInk(QWidget* widget, const QColor& ink)
{
    QPalette palette = widget->palette();
    palette.setColor(QPalette::WindowText, ink);
    palette.setColor(QPalette::Text, ink);
    widget->setPalette(palette);
}

QLabel* headingLabel(const QString& text, QWidget* parent)
{
    QLabel* label = plainLabel(text, theme::TextRole::Strong, parent);
    setInk(label, theme::colour::secondary);
    return label;
}

} // namespace console
