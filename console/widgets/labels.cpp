// Labels that take their text as it is.
#include "widgets/labels.hpp"

#include <QPainter>

namespace console {

QLabel* plainLabel(const QString& text, theme::TextRole role, QWidget* parent)
{
    auto* label = new QLabel(text, parent);
    label->setTextFormat(Qt::PlainText);
    theme::setTextRole(label, role);
    return label;
}

ElidedLabel::ElidedLabel(theme::TextRole role, QWidget* parent) : QLabel(parent)
{
    setTextFormat(Qt::PlainText);
    theme::setTextRole(this, role);
}

void ElidedLabel::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setFont(font());
    painter.setPen(palette().color(foregroundRole()));
    const QRect room = contentsRect();
    painter.drawText(room, int(alignment()) | Qt::TextSingleLine, fontMetrics().elidedText(text(), Qt::ElideRight, room.width()));
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
