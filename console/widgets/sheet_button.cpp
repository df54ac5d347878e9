// What Enter may do is decided here and not by the platform's habits.
#include "widgets/sheet_button.hpp"

#include "widgets/theme.hpp"

#include <QKeyEvent>

namespace console {

namespace {

bool isEnter(const QKeyEvent* event) { return event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter; }

} // namespace

SheetButton::SheetButton(const QString& text, Enter enter, QWidget* parent) : TouchButton(text, parent), m_enter(enter)
{
    setAutoDefault(false);
    setAccessibleName(text);
    theme::setTextRole(this, theme::TextRole::Strong);
}

void SheetButton::keyPressEvent(QKeyEvent* event)
{
    if (!isEnter(event)) {
        QPushButton::keyPressEvent(event);
        return;
    }
    event->accept();
    if (m_enter == Enter::Clicks && !event->isAutoRepeat())
        click();
}

void SheetButton::keyReleaseEvent(QKeyEvent* event)
{
    if (isEnter(event))
        event->accept();
    else
        QPushButton::keyReleaseEvent(event);
}

} // namespace console
