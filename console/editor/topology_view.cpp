// Canvas above, steps below; choosing a link above goes to its button below.
#include "editor/topology_view.hpp"

#include "editor/link_row.hpp"
#include "widgets/labels.hpp"
#include "widgets/sheet_button.hpp"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include <algorithm>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

constexpr int statusClockMs = 200;

} // namespace

TopologyView::TopologyView(const SessionModel& sessions, QWidget* parent)
    : QFrame(parent),
      m_sessions(sessions),
      m_title(plainLabel({}, TextRole::Title, this)),
      m_identity(plainLabel({}, TextRole::Body, this)),
      m_said(plainLabel({}, TextRole::Body, this)),
      m_openAll(new SheetButton(tr("Open all"), SheetButton::Enter::Ignored, this)),
      m_canvas(new TopologyCanvas(sessions, TopologyCanvas::Size::Full, this)),
      m_rowColumn(new QVBoxLayout)
{
    setAccessibleName(tr("Topology view"));
    setFocusPolicy(Qt::NoFocus);
    setFocusProxy(m_canvas);
    setAutoFillBackground(true);
    m_openAll->setAccessibleName(tr("Open all closed links, one after the other"));
    setInk(m_identity, colour::secondary);
    m_said->setWordWrap(true);
    auto* head = new QHBoxLayout;
    auto* names = new QVBoxLayout;
    names->setSpacing(0);
    names->addWidget(m_title);
    names->addWidget(m_identity);
    head->addLayout(names, 1);
    head->addWidget(m_openAll);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(14, 10, 14, 10);
    column->setSpacing(6);
    column->addLayout(head);
    column->addWidget(m_canvas, 1);
    column->addWidget(m_said);
    m_rowColumn->setSpacing(2);
    column->addLayout(m_rowColumn);
    connect(m_openAll, &QPushButton::clicked, this, &TopologyView::openAllRequested);
    connect(m_canvas, &TopologyCanvas::linkChosen, this, &TopologyView::chooseLink);
    connect(m_canvas, &TopologyCanvas::deviceChosen, this, &TopologyView::chooseDevice);
    connect(&m_sessions, &SessionModel::topologyChanged, this, &TopologyView::rebuild);
    m_clock.setInterval(statusClockMs);
    connect(&m_clock, &QTimer::timeout, this, [this] { refresh(std::chrono::steady_clock::now()); });
    rebuild();
}

void TopologyView::rebuild()
{
    for (LinkRow* row : m_rows)
        row->deleteLater();
    m_rows.clear();
    int number = 1;
    for (const LinkNode& link : m_sessions.links()) {
        if (!link.own)
            continue;
        auto* row = new LinkRow(number++, link.peer, m_sessions.titleOf(link.peer), this);
        connect(row, &LinkRow::openRequested, this, &TopologyView::openRequested);
        connect(row, &LinkRow::closeRequested, this, &TopologyView::closeRequested);
        connect(row, &LinkRow::reopenRequested, this, &TopologyView::reopenRequested);
        m_rowColumn->addWidget(row);
        m_rows.push_back(row);
    }
    m_title->setText(m_sessions.topologyTitle().isEmpty() ? m_sessions.topologyName() : m_sessions.topologyTitle());
    m_identity->setText(tr("%1 %2 \u00B7 hash %3 \u00B7 %4")
                            .arg(m_sessions.topologyName(), m_sessions.topologyVersion(), m_sessions.topologyHash().left(6),
                                 m_sessions.secured() ? tr("encrypted, identities checked") : tr("NOT ENCRYPTED, identities not checked")));
    m_said->setText(tr("Choose a link with the mouse, or with Tab and Enter."));
}

void TopologyView::refresh(Instant now)
{
    for (LinkRow* row : m_rows)
        if (const LinkNode* link = m_sessions.linkTo(row->peer()))
            row->setLink(*link, now);
    const auto& links = m_sessions.links();
    m_openAll->setEnabled(std::any_of(links.begin(), links.end(), [](const LinkNode& link) { return link.own && mayOpen(link.state); }));
}

void TopologyView::chooseLink(quint32 a, quint32 b)
{
    const LinkNode* link = m_sessions.link(a, b);
    for (LinkRow* row : m_rows)
        row->setChosen(link && link->own && row->peer() == link->peer);
    if (!link)
        return;
    const QString names = tr("%1 and %2").arg(m_sessions.titleOf(a), m_sessions.titleOf(b));
    if (!link->own) {
        m_said->setText(tr("%1: these two talk without this console. Their state is not known here.").arg(names));
        return;
    }
    m_said->setText(tr("%1: %2").arg(names, word(link->state)));
    for (LinkRow* row : m_rows)
        if (row->peer() == link->peer)
            row->focusAction();
}

void TopologyView::chooseDevice(quint32 id)
{
    const DeviceNode* device = m_sessions.device(id);
    if (!device)
        return;
    for (LinkRow* row : m_rows)
        row->setChosen(row->peer() == id);
    m_said->setText(tr("%1: %2, message set %3, at %4").arg(device->title, device->idText(), device->messageSet, device->address));
}

void TopologyView::showEvent(QShowEvent* event)
{
    QFrame::showEvent(event);
    refresh(std::chrono::steady_clock::now());
    m_clock.start();
}

void TopologyView::hideEvent(QHideEvent* event)
{
    m_clock.stop();
    QFrame::hideEvent(event);
}

} // namespace console
