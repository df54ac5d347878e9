// The rectangles of the regions, from the reference of 2560 x 1440.
#include "widgets/cockpit_layout.hpp"

#include "widgets/theme.hpp"

#include <QWidget>

#include <algorithm>
#include <cmath>
#include <optional>

namespace console {

namespace {

constexpr double statusHeight = 72;
constexpr double alarmHeight = 56;
constexpr double motionHeight = 176;
constexpr double linksWidth = 300;
constexpr double lowerShare = 574.0 / 1136.0; // of the column right of the live image
constexpr double robotShare = 0.63;           // of the lower part
constexpr double widestBeside = 0.36;         // of the width right of C, for the live picture beside another
constexpr double otherShare = 0.85;           // of its height
constexpr double doseShare = 0.64;            // of the column's width

struct Lines {
    int a, b, c, j;  // lower edges of A, B and the middle; of J
    int links, live; // right edges of C and D
    int upper;       // lower edge of E and F
    int robot;       // lower edge of G
    int half;        // between E and F
    int dose;        // between H and I
};

Lines linesFor(const QSize& window)
{
    const double tall = double(window.height()) / theme::referenceHeight;
    const double wide = double(window.width()) / theme::referenceWidth;
    Lines l{};
    l.a = int(std::lround(statusHeight * tall));
    l.b = int(std::lround((statusHeight + alarmHeight) * tall));
    l.c = int(std::lround((theme::referenceHeight - motionHeight) * tall));
    l.j = window.height();
    l.links = int(std::lround(linksWidth * wide));
    const int room = int(std::lround((theme::referenceWidth - linksWidth) * wide * 0.56));
    l.live = l.links + std::min(l.c - l.b, room);
    l.upper = l.b + int(std::lround((l.c - l.b) * (1 - lowerShare)));
    l.robot = l.upper + int(std::lround((l.c - l.upper) * robotShare));
    l.half = (l.live + window.width()) / 2;
    l.dose = l.live + int(std::lround((window.width() - l.live) * doseShare));
    return l;
}

QRect between(int left, int top, int right, int bottom) { return {left, top, right - left, bottom - top}; }

/// The chosen picture on the left, the third in the middle, the live one on the right; sheets and views lie over the first two. Those are
/// lower than the live one by more than the controls that it has beneath.
std::optional<QRect> besideRect(Region region, const QSize& window, Arrangement arrangement)
{
    const Lines l = linesFor(window);
    const int width = window.width();
    const int robotHeight = l.robot - l.upper;
    const int side = std::min(l.c - l.b - robotHeight, int(std::lround((width - l.links) * widestBeside)));
    const int foot = l.b + side;
    const int live = width - side;
    const int other = std::min((live - l.links) / 2, side);
    const int otherFoot = l.b + int(std::lround(side * otherShare));
    const int gauges = (l.links + width) / 2;
    const int dose = gauges + int(std::lround((width - gauges) * doseShare));
    const Region chosen = arrangement == Arrangement::ReferenceBeside ? Region::Reference : Region::Scene;
    switch (region) {
    case Region::Live:
        return QRect(live, l.b, side, side);
    case Region::Reference:
    case Region::Scene:
        return region == chosen ? between(l.links, l.b, l.links + other, otherFoot)
                                : between(l.links + other, l.b, l.links + 2 * other, otherFoot);
    case Region::Robot:
        return between(l.links, otherFoot, std::min(gauges, live), l.c);
    case Region::Dose:
        return between(gauges, foot, dose, l.c);
    case Region::Trends:
        return between(dose, foot, width, l.c);
    case Region::Sheet:
    case Region::Overlay:
        return between(l.links, l.b, live, otherFoot);
    case Region::Note:
        return between(gauges, foot, width, l.c);
    default:
        return std::nullopt;
    }
}

} // namespace

QRect regionRect(Region region, const QSize& window, Arrangement arrangement)
{
    if (arrangement != Arrangement::Usual)
        if (const auto beside = besideRect(region, window, arrangement))
            return *beside;
    const Lines l = linesFor(window);
    const int width = window.width();
    switch (region) {
    case Region::Status:
        return between(0, 0, width, l.a);
    case Region::Alarm:
        return between(0, l.a, width, l.b);
    case Region::Links:
        return between(0, l.b, l.links, l.c);
    case Region::Live: {
        const int side = l.live - l.links;
        return {l.links, l.b + (l.c - l.b - side) / 2, side, side};
    }
    case Region::Reference:
        return between(l.live, l.b, l.half, l.upper);
    case Region::Scene:
        return between(l.half, l.b, width, l.upper);
    case Region::Robot:
        return between(l.live, l.upper, width, l.robot);
    case Region::Dose:
        return between(l.live, l.robot, l.dose, l.c);
    case Region::Trends:
        return between(l.dose, l.robot, width, l.c);
    case Region::Motion:
        return between(0, l.c, width, l.j);
    case Region::Sheet:
        return between(l.live, l.b, width, l.upper);
    case Region::Overlay:
        return between(l.live, l.b, width, l.robot);
    case Region::Note:
        return between(l.live, l.robot, width, l.c);
    }
    return {};
}

CockpitLayout::CockpitLayout(QWidget* parent) : QLayout(parent) { setContentsMargins(0, 0, 0, 0); }

CockpitLayout::~CockpitLayout() = default;

void CockpitLayout::place(Region region, QWidget* widget)
{
    addChildWidget(widget);
    m_slots.push_back({region, std::make_unique<QWidgetItem>(widget)});
    invalidate();
}

void CockpitLayout::setArrangement(Arrangement arrangement)
{
    m_arrangement = arrangement;
    if (!geometry().isEmpty())
        setGeometry(geometry());
}

void CockpitLayout::addItem(QLayoutItem* item) { m_slots.push_back({Region::Overlay, std::unique_ptr<QLayoutItem>(item)}); }

int CockpitLayout::count() const { return int(m_slots.size()); }

QLayoutItem* CockpitLayout::itemAt(int index) const
{
    return index >= 0 && index < count() ? m_slots[std::size_t(index)].item.get() : nullptr;
}

QLayoutItem* CockpitLayout::takeAt(int index)
{
    if (index < 0 || index >= count())
        return nullptr;
    QLayoutItem* item = m_slots[std::size_t(index)].item.release();
    m_slots.erase(m_slots.begin() + index);
    return item;
}

QSize CockpitLayout::sizeHint() const { return {1920, 1080}; }

QSize CockpitLayout::minimumSize() const { return {1280, 720}; }

void CockpitLayout::setGeometry(const QRect& rect)
{
    QLayout::setGeometry(rect);
    for (const Slot& slot : m_slots)
        slot.item->setGeometry(regionRect(slot.region, rect.size(), m_arrangement).translated(rect.topLeft()));
}

} // namespace console
