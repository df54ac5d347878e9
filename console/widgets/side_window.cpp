// The line that says what the window is, its keys, and its parts.
#include "widgets/side_window.hpp"

#include "widgets/labels.hpp"
#include "widgets/urgent_keys.hpp"

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
    auto* urgent = new UrgentKeys(this);
    connect(urgent, &UrgentKeys::emergencyStopPressed, this, [this] {
        Q_EMIT emergencyStopRequested(
            QString::fromLatin1(QT_TRANSLATE_NOOP("console::SystemLink", "Esc key on the console's further screen")));
    });
    connect(urgent, &UrgentKeys::holdPressed, this, &SideWindow::panicHoldRequested);
    connect(urgent, &UrgentKeys::audioPausePressed, this, &SideWindow::audioPauseRequested);
    auto* back = new QShortcut(QKeySequence(Qt::Key_F1), this);
    back->setAutoRepeat(false);
    connect(back, &QShortcut::activated, this, &SideWindow::cockpitRequested);
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
