// The row's words follow the link; its button offers the one thing that the state allows.
#include "editor/link_row.hpp"

#include "widgets/double_click.hpp"
#include "widgets/figures.hpp"
#include "widgets/labels.hpp"
#include "widgets/sheet_button.hpp"

#include <QHBoxLayout>
#include <QPainter>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

LinkRow::LinkRow(int number, quint32 peer, const QString& title, QWidget* parent)
    : QFrame(parent),
      m_peer(peer),
      m_title(title),
      m_count(plainLabel(QString::number(number), TextRole::Strong, this)),
      m_progress(plainLabel({}, TextRole::Body, this)),
      m_action(new SheetButton(tr("Open"), SheetButton::Enter::Ignored, this))
{
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(10, 2, 10, 2);
    row->setSpacing(14);
    setInk(m_count, colour::secondary);
    QLabel* name = plainLabel(title, TextRole::Strong, this);
    name->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_progress->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_progress->setWordWrap(true);
    m_action->setProperty("compact", true);
    row->addWidget(m_count);
    row->addWidget(name, 2);
    row->addWidget(m_progress, 5);
    row->addWidget(m_action);
    connect(m_action, &QPushButton::clicked, this, &LinkRow::act);
}

QString LinkRow::progress(const LinkNode& link, Instant now)
{
    if (isChanging(link.state))
        return tr("%1, for %2").arg(word(link.state), spokenAge(now - link.since));
    if (link.state == LinkState::Closed && !link.failure.isEmpty())
        return tr("not opened: %1").arg(link.failure);
    if (link.state == LinkState::StandBy && !link.failure.isEmpty())
        return tr("%1; not re-opened: %2").arg(word(link.state), link.failure);
    if (carriesMessages(link.state) && link.openingMs)
        return tr("%1, took %2").arg(word(link.state), figure(link.openingMs, 0, tr("ms")));
    return word(link.state);
}

void LinkRow::setLink(const LinkNode& link, Instant now)
{
    m_state = link.state;
    m_progress->setText(progress(link, now));
    setInk(m_progress, isTrouble(link.state) || !link.failure.isEmpty() ? colour::bright : colour::text);
    const bool may = mayOpen(m_state) || mayClose(m_state) || mayReopen(m_state);
    const QString text = mayClose(m_state) ? tr("Close") : mayReopen(m_state) ? tr("Re-open") : tr("Open");
    m_action->setEnabled(may);
    if (text == m_action->text())
        return;
    m_action->setText(text);
    m_action->setAccessibleName(tr("%1 the link to %2").arg(text, m_title));
}

void LinkRow::setChosen(bool chosen)
{
    m_chosen = chosen;
    update();
}

void LinkRow::focusAction() { m_action->setFocus(Qt::OtherFocusReason); }

void LinkRow::act()
{
    if (isDoubleClick(m_acted))
        return; // the button may offer the opposite by now
    if (mayOpen(m_state))
        Q_EMIT openRequested(m_peer);
    else if (mayClose(m_state))
        Q_EMIT closeRequested(m_peer);
    else if (mayReopen(m_state))
        Q_EMIT reopenRequested(m_peer);
}

// Every row's columns begin at the same place, whatever its number and its button's word.
void LinkRow::resizeEvent(QResizeEvent*)
{
    const QFontMetrics metrics(m_action->font());
    m_count->setFixedWidth(metrics.horizontalAdvance(QStringLiteral("00")));
    m_action->setMinimumWidth(metrics.horizontalAdvance(tr("Re-open")) + 2 * metrics.height());
}

void LinkRow::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.fillRect(rect(), m_chosen ? colour::raised : colour::background);
    if (isTrouble(m_state))
        painter.fillRect(QRect(0, 2, 4, height() - 4), m_state == LinkState::Suspect ? colour::bright : colour::high);
}

} // namespace console
