// The canvas follows the model; its plan is made anew only when the topology changed.
#include "editor/topology_canvas.hpp"

#include "editor/topology_items.hpp"
#include "widgets/theme.hpp"

#include <QGraphicsScene>
#include <QKeyEvent>
#include <QMouseEvent>

#include <algorithm>

namespace console {

namespace colour = theme::colour;

namespace {

constexpr int clockMs = 200;
constexpr double sceneTextPixels = 20;
constexpr double leastTextPixels = 12.5;

QString siteWords(const QString& site)
{
    if (site.isEmpty())
        return TopologyCanvas::tr("no site given");
    return TopologyCanvas::tr("%1 side").arg(site);
}

} // namespace

TopologyCanvas::TopologyCanvas(const SessionModel& sessions, Size size, QWidget* parent)
    : QGraphicsView(parent), m_sessions(sessions), m_size(size), m_scene(new QGraphicsScene(this))
{
    setScene(m_scene);
    setRenderHint(QPainter::Antialiasing);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setFocusPolicy(Qt::TabFocus);
    setAccessibleName(size == Size::Mini ? tr("Small topology; choose it to see the whole") : tr("Topology"));
    connect(&m_sessions, &SessionModel::topologyChanged, this, &TopologyCanvas::rebuild);
    // At once, as the cards do: two pictures of a link that say different things are worse than one.
    const auto follow = [this] { refresh(std::chrono::steady_clock::now()); };
    connect(&m_sessions, &SessionModel::linkStateChanged, this, follow);
    connect(&m_sessions, &SessionModel::linkIncidentChanged, this, follow);
    m_clock.setInterval(clockMs);
    connect(&m_clock, &QTimer::timeout, this, follow);
    rebuild();
}

TopologyCanvas::~TopologyCanvas() = default;

QSize TopologyCanvas::sizeHint() const { return m_size == Size::Mini ? QSize(160, 120) : QSize(700, 420); }

int TopologyCanvas::count() const { return int(m_devices.size() + m_links.size()); }

void TopologyCanvas::rebuild()
{
    m_scene->clear();
    m_devices.clear();
    m_links.clear();
    m_labels.clear();
    m_lanes.clear();
    m_current = -1;
    const TopologyPlan plan = planTopology(m_sessions);
    const bool mini = m_size == Size::Mini;
    for (const Lane& lane : plan.lanes)
        m_lanes.emplace_back(siteWords(lane.site), lane.area);
    for (const PlacedDevice& place : plan.devices) {
        m_devices.push_back(new DeviceItem(*m_sessions.device(place.id), place.box, mini));
        m_scene->addItem(m_devices.back());
    }
    for (const PlacedLink& place : plan.links) {
        m_links.push_back(new LinkItem(*m_sessions.link(place.a, place.b), place, mini));
        m_scene->addItem(m_links.back());
        if (mini)
            continue;
        m_labels.push_back(new LinkLabel(*m_links.back()));
        m_scene->addItem(m_labels.back());
    }
    QRectF bounds = plan.bounds;
    for (const LinkItem* item : m_links)
        bounds.setRight(std::max(bounds.right(), item->roomBeside()));
    m_scene->setSceneRect(bounds);
    fit();
}

void TopologyCanvas::fit()
{
    if (m_scene->sceneRect().isEmpty())
        return;
    fitInView(m_scene->sceneRect(), Qt::KeepAspectRatio);
    const double factor = std::clamp(leastTextPixels / (sceneTextPixels * transform().m11()), 1.0, largestTextFactor);
    for (DeviceItem* item : m_devices)
        item->setTextFactor(factor);
    announceLabels();
    for (LinkItem* item : m_links)
        item->setTextFactor(factor);
}

void TopologyCanvas::announceLabels()
{
    for (LinkLabel* label : m_labels)
        label->announceChange();
}

void TopologyCanvas::refresh(Instant now)
{
    announceLabels();
    for (LinkItem* item : m_links)
        if (const LinkNode* link = m_sessions.link(item->a(), item->b()))
            item->setLink(*link, now);
}

std::optional<std::pair<quint32, quint32>> TopologyCanvas::currentLink() const
{
    const int index = m_current - int(m_devices.size());
    if (index < 0 || index >= int(m_links.size()))
        return std::nullopt;
    return std::pair(m_links[std::size_t(index)]->a(), m_links[std::size_t(index)]->b());
}

std::optional<quint32> TopologyCanvas::currentDevice() const
{
    if (m_current < 0 || m_current >= int(m_devices.size()))
        return std::nullopt;
    return m_devices[std::size_t(m_current)]->id();
}

void TopologyCanvas::setCurrent(int index)
{
    m_current = index;
    for (int i = 0; i < int(m_devices.size()); ++i)
        m_devices[std::size_t(i)]->setCurrent(i == index);
    for (int i = 0; i < int(m_links.size()); ++i)
        m_links[std::size_t(i)]->setCurrent(i + int(m_devices.size()) == index);
    for (LinkLabel* label : m_labels)
        label->update();
    if (const auto link = currentLink())
        setAccessibleDescription(tr("Link of %1 and %2").arg(m_sessions.titleOf(link->first), m_sessions.titleOf(link->second)));
    else if (const auto device = currentDevice())
        setAccessibleDescription(m_sessions.titleOf(*device));
}

void TopologyCanvas::activate(int index)
{
    setCurrent(index);
    if (const auto link = currentLink())
        Q_EMIT linkChosen(link->first, link->second);
    else if (const auto device = currentDevice())
        Q_EMIT deviceChosen(*device);
}

int TopologyCanvas::indexAt(const QPoint& place) const
{
    const QGraphicsItem* hit = itemAt(place);
    for (int i = 0; i < int(m_devices.size()); ++i)
        if (m_devices[std::size_t(i)] == hit)
            return i;
    for (int i = 0; i < int(m_links.size()); ++i)
        if (m_links[std::size_t(i)] == hit || (i < int(m_labels.size()) && m_labels[std::size_t(i)] == hit))
            return i + int(m_devices.size());
    return -1;
}

void TopologyCanvas::mousePressEvent(QMouseEvent* event)
{
    if (event->button() != Qt::LeftButton)
        return;
    if (m_size == Size::Mini) {
        Q_EMIT chosen();
        return;
    }
    const int index = indexAt(event->position().toPoint());
    if (index >= 0)
        activate(index);
}

void TopologyCanvas::keyPressEvent(QKeyEvent* event)
{
    const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (!enter || event->isAutoRepeat()) {
        event->ignore();
        return;
    }
    if (m_size == Size::Mini)
        Q_EMIT chosen();
    else if (m_current >= 0)
        activate(m_current);
}

// The picture is fitted to its place; a wheel turned by accident moves nothing.
void TopologyCanvas::wheelEvent(QWheelEvent* event) { event->ignore(); }

bool TopologyCanvas::focusNextPrevChild(bool next)
{
    if (m_size == Size::Mini || !hasFocus())
        return QGraphicsView::focusNextPrevChild(next);
    const int to = m_current + (next ? 1 : -1);
    if (to < 0 || to >= count()) {
        setCurrent(-1);
        return QGraphicsView::focusNextPrevChild(next);
    }
    setCurrent(to);
    return true;
}

void TopologyCanvas::focusInEvent(QFocusEvent* event)
{
    QGraphicsView::focusInEvent(event);
    if (m_size == Size::Full && m_current < 0 && count() > 0)
        setCurrent(event->reason() == Qt::BacktabFocusReason ? count() - 1 : 0);
    viewport()->update();
}

void TopologyCanvas::focusOutEvent(QFocusEvent* event)
{
    QGraphicsView::focusOutEvent(event);
    viewport()->update();
}

void TopologyCanvas::drawBackground(QPainter* painter, const QRectF&)
{
    painter->setRenderHint(QPainter::Antialiasing);
    QFont font = theme::font(theme::TextRole::Strong, 1.0);
    font.setPixelSize(21);
    for (const auto& [name, area] : m_lanes) {
        painter->setPen(QPen(colour::line, 1.5));
        painter->setBrush(colour::panel);
        painter->drawRoundedRect(area, 10, 10);
        if (m_size == Size::Mini)
            continue;
        painter->setFont(font);
        painter->setPen(colour::secondary);
        painter->drawText(QRectF(area.left() + 16, area.top() + 10, area.width() - 32, 34), Qt::AlignLeft | Qt::AlignVCenter, name);
    }
}

QPoint TopologyCanvas::placeOfLink(quint32 a, quint32 b) const
{
    for (const LinkItem* item : m_links)
        if ((item->a() == a && item->b() == b) || (item->a() == b && item->b() == a))
            return mapFromScene(item->labelBox().center());
    return {};
}

QPoint TopologyCanvas::placeOfDevice(quint32 id) const
{
    for (const DeviceItem* item : m_devices)
        if (item->id() == id)
            return mapFromScene(item->boundingRect().center());
    return {};
}

void TopologyCanvas::resizeEvent(QResizeEvent* event)
{
    QGraphicsView::resizeEvent(event);
    fit();
}

void TopologyCanvas::showEvent(QShowEvent* event)
{
    QGraphicsView::showEvent(event);
    fit();
    refresh(std::chrono::steady_clock::now());
    m_clock.start();
}

void TopologyCanvas::hideEvent(QHideEvent* event)
{
    m_clock.stop();
    QGraphicsView::hideEvent(event);
}

} // namespace console
