// The rail follows the session model: one card per own link, in the topology's order.
#include "widgets/links_rail.hpp"

#include "widgets/focus_return.hpp"
#include "widgets/labels.hpp"
#include "widgets/link_card.hpp"
#include "widgets/touch_button.hpp"
#include "widgets/touch_scrolling.hpp"

#include <QHBoxLayout>
#include <QScrollArea>
#include <QVBoxLayout>

#include <algorithm>

namespace console {

using theme::TextRole;

LinksRail::LinksRail(const SessionModel& sessions, QWidget* parent)
    : QFrame(parent),
      m_sessions(sessions),
      m_count(headingLabel(tr("Links"), this)),
      m_openAll(new TouchButton(tr("Open all"), this)),
      m_topology(new TouchButton(tr("Topology  F2"), this)),
      m_scroll(new QScrollArea(this)),
      m_column(new QVBoxLayout(this)),
      m_cardColumn(new QVBoxLayout)
{
    setAccessibleName(tr("Links of this console"));
    theme::setTextRole(m_openAll, TextRole::Strong);
    m_openAll->setAccessibleName(tr("Open all closed links, one after the other"));
    theme::setTextRole(m_topology, TextRole::Body);
    m_topology->setAccessibleName(tr("Show the topology"));
    m_topology->setProperty("compact", true);
    for (QPushButton* button : {m_openAll, m_topology})
        button->setFocusPolicy(Qt::TabFocus); // a click leaves the keys with the hand
    auto* cards = new QWidget(m_scroll);
    m_cardColumn->setContentsMargins(0, 0, 0, 0);
    m_cardColumn->setSpacing(6);
    m_cardColumn->addStretch(1);
    cards->setLayout(m_cardColumn);
    m_scroll->setWidget(cards);
    m_scroll->setWidgetResizable(true);
    m_scroll->setFrameShape(QFrame::NoFrame);
    m_scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_scroll->setFocusPolicy(Qt::NoFocus);
    m_scroll->setAccessibleName(tr("Link cards"));
    scrollByTouch(*m_scroll);
    m_column->setContentsMargins(8, 6, 8, 6);
    m_column->setSpacing(6);
    auto* head = new QHBoxLayout;
    head->addWidget(m_count, 1);
    head->addWidget(m_openAll);
    m_column->addLayout(head);
    m_column->addWidget(m_scroll, 1);
    m_column->addWidget(m_topology);
    connect(m_openAll, &QPushButton::clicked, this, &LinksRail::openAllRequested);
    connect(m_topology, &QPushButton::clicked, this, &LinksRail::topologyRequested);
    connect(&m_sessions, &SessionModel::topologyChanged, this, &LinksRail::rebuild);
    rebuild();
}

void LinksRail::setMiniTopology(QWidget* topology)
{
    m_mini = topology;
    m_column->insertWidget(m_column->count() - 1, topology);
}

void LinksRail::rebuild()
{
    for (LinkCard* card : m_cards) {
        returnFocus(card);
        card->deleteLater();
    }
    m_cards.clear();
    for (const LinkNode& link : m_sessions.links()) {
        if (!link.own)
            continue;
        auto* card = new LinkCard(link.peer, this);
        m_cardColumn->insertWidget(m_cardColumn->count() - 1, card);
        connect(card, &LinkCard::openRequested, this, &LinksRail::openRequested);
        connect(card, &LinkCard::closeRequested, this, &LinksRail::closeRequested);
        connect(card, &LinkCard::reopenRequested, this, &LinksRail::reopenRequested);
        m_cards.push_back(card);
    }
}

// Cards first: the small topology takes the room that they leave, and none when that is too little.
void LinksRail::fitMini()
{
    if (!m_mini)
        return;
    const QMargins margins = m_column->contentsMargins();
    const int cards = m_scroll->widget()->sizeHint().height();
    const int others =
        m_openAll->sizeHint().height() + m_topology->sizeHint().height() + 3 * m_column->spacing() + margins.top() + margins.bottom();
    const int room = std::min(height() - cards - others, width() * 3 / 4);
    const bool fits = room >= width() * 2 / 5;
    m_mini->setVisible(fits);
    if (fits)
        m_mini->setFixedHeight(room);
}

void LinksRail::refresh(Instant now)
{
    for (LinkCard* card : m_cards) {
        const LinkNode* link = m_sessions.linkTo(card->peer());
        const DeviceNode* device = m_sessions.device(card->peer());
        if (link && device)
            card->setLink(*link, *device, now);
    }
    m_count->setText(m_sessions.ownLinkCount() == 0 ? tr("No links")
                                                    : tr("%1 of %2 open").arg(m_sessions.openCount()).arg(m_sessions.ownLinkCount()));
    const auto& links = m_sessions.links();
    const bool some = std::any_of(links.begin(), links.end(), [](const LinkNode& link) { return link.own && mayOpen(link.state); });
    if (!some)
        returnFocus(m_openAll);
    m_openAll->setEnabled(some);
    fitMini();
}

} // namespace console
