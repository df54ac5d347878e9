// Dashed edge: nothing live is ever shown here.
#include "widgets/not_yet_pane.hpp"

#include "widgets/labels.hpp"

#include <QPainter>
#include <QVBoxLayout>

namespace console {

NotYetPane::NotYetPane(const QString& heading, const QString& sentence, QWidget* parent) : QFrame(parent)
{
    setAccessibleName(heading);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(18, 12, 18, 12);
    column->addWidget(headingLabel(heading, this));
    QLabel* text = plainLabel(sentence, theme::TextRole::Body, this);
    text->setWordWrap(true);
    setInk(text, theme::colour::secondary);
    column->addWidget(text);
    column->addStretch(1);
}

void NotYetPane::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setPen(QPen(theme::colour::line, 1, Qt::DashLine));
    painter.drawRect(rect().adjusted(4, 4, -5, -5));
}

} // namespace console
