// The line that says what the window is, its keys, and its parts.
#include "widgets/side_window.hpp"

#include "widgets/labels.hpp"

#include <QCloseEvent>
#include <QHBoxLayout>
#include <QResizeEvent>
#include <QShortcut>
#include <QVBoxLayout>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

SideWindow::SideWindow(const QString& name) : m_column(new QVBoxLayout(this))
{
    setWindowTitle(tr("LiENa %1 \u2014 research system, not a medical device").arg(name));
    setAccessibleName(name);
    setAttribute(Qt::WA_ShowWithoutActivating); // it must not take the keys from the hand
    m_column->setContentsMargins(8, 6, 8, 8);
    m_column->setSpacing(6);
    auto* head = new QHBoxLayout;
    QLabel* title = plainLabel(name, TextRole::Title, this);
    QLabel* where = plainLabel(tr("The live picture, alarms and motion are in the cockpit (F1). Esc is the emergency stop here, too."),
                               TextRole::Body, this);
    setInk(where, colour::secondary);
    head->setSpacing(18);
    head->addWidget(title);
    head->addWidget(where, 1);
    head->addWidget(plainLabel(tr("RESEARCH SYSTEM\nNOT A MEDICAL DEVICE"), TextRole::Caption, this));
    m_column->addLayout(head);
    addKeys();
}

void SideWindow::addKeys()
{
    const auto bind = [this](Qt::Key key, auto act) {
        auto* shortcut = new QShortcut(QKeySequence(key), this);
        shortcut->setAutoRepeat(false);
        connect(shortcut, &QShortcut::activated, this, act);
    };
    bind(Qt::Key_Escape, [this] {
        Q_EMIT emergencyStopRequested(
            QString::fromLatin1(QT_TRANSLATE_NOOP("console::SystemLink", "Esc key on the console's further screen")));
    });
    bind(Qt::Key_F12, [this] { Q_EMIT panicHoldRequested(); });
    bind(Qt::Key_F9, [this] { Q_EMIT audioPauseRequested(); });
    bind(Qt::Key_F1, [this] { Q_EMIT cockpitRequested(); });
}

void SideWindow::add(std::initializer_list<QWidget*> parts, int share)
{
    auto* row = new QHBoxLayout;
    row->setSpacing(14);
    m_column->addLayout(row, share);
    for (QWidget* part : parts)
        row->addWidget(part, 1);
}

void SideWindow::closeEvent(QCloseEvent* event)
{
    if (event->spontaneous())
        Q_EMIT closedByPerson();
    QWidget::closeEvent(event);
}

void SideWindow::resizeEvent(QResizeEvent* event) { theme::applyScale(this, theme::scaleFor(event->size())); }

} // namespace console
