// The live picture: the pane that a surgeon moves instruments by.
#include "imaging/live_image_view.hpp"

#include "imaging/pane_colours.hpp"
#include "imaging/picture_overlay.hpp"

#include <QPainter>

#include <algorithm>

namespace console {

namespace {

constexpr int tickMs = 100;

} // namespace

LiveImageView::LiveImageView(PictureState& state, QWidget* parent)
    : PictureCanvas(parent), m_state(state), m_clock([] { return std::chrono::steady_clock::now(); })
{
    setObjectName(QStringLiteral("liveImage"));
    setMinimumSize(240, 240);
    setAccessibleName(tr("Live X-ray image"));
    describe({});
    m_timer.setInterval(tickMs);
    connect(&m_timer, &QTimer::timeout, this, &LiveImageView::tick);
    m_timer.start();
}

LiveImageView::~LiveImageView() = default;

void LiveImageView::showPicture(const DisplayPicture& picture)
{
    // Whatever is connected to what: only what was made to be live is shown here.
    if (picture.role != PictureRole::Live)
        return;
    // A frame that comes twice is not a sign of life.
    m_pictureIsNew = m_pictureIsNew || !m_picture || !picture.isSameFrameAs(*m_picture);
    m_picture = picture;
    followPicture(picture);
}

void LiveImageView::showRefusal(quint32 frame, const QString& reason)
{
    m_refusal = tr("Frame %1 is refused: %2.").arg(frame).arg(reason);
    update();
}

void LiveImageView::tick()
{
    const PictureReading reading = m_state.reading(m_clock());
    if (reading.condition != m_paintedCondition || !m_picture)
        update();
    else
        update(m_overlay);
}

void LiveImageView::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.fillRect(rect(), pane_colours::background);
    if (!m_picture) {
        paintNothingYet(painter);
        paintTold(painter);
        if (hasFocus())
            paintFocusFrame(painter, rect());
        return;
    }
    paintShown(painter);
    notePainted();
    const PictureReading reading = m_state.reading(m_clock());
    paintCondition(painter, reading);
    const PictureOverlay overlay(pictureRect(), asSeenHere(*m_picture), reading, m_paintedPictures, overlayFont(), viewport().zoom());
    overlay.paint(painter);
    const QRect refused = paintRefusal(painter, overlay.footTop());
    m_overlay = overlay.region() + refused + paintTold(painter, refused);
    m_overlay += paintMeasurement(painter, m_overlay);
    m_liveness = overlay.livenessRect();
    if (reading.condition != m_paintedCondition || reading.reduction != m_paintedReduction)
        describe(reading);
    m_paintedReduction = reading.reduction;
    m_paintedCondition = reading.condition;
}

void LiveImageView::paintCondition(QPainter& painter, const PictureReading& reading)
{
    if (reading.condition == PictureCondition::Frozen) {
        paintStaleVeil(painter, pictureRect());
        paintHatchedFrame(painter, rect());
    } else {
        paintSolidFrame(painter, rect());
    }
    if (hasFocus())
        paintFocusFrame(painter, rect());
}

void LiveImageView::notePainted()
{
    if (!m_pictureIsNew)
        return;
    m_pictureIsNew = false;
    ++m_paintedPictures;
    m_refusal.clear();
    const XrayFrame& about = m_picture->about;
    PictureStamp stamp;
    stamp.frame = about.frame;
    stamp.acquisition = about.acquisition;
    stamp.source = about.source;
    stamp.role = m_picture->role;
    stamp.reduction = reductionOf(about);
    stamp.captureNs = about.captureNs;
    stamp.captured = about.captured();
    stamp.uncertainty = about.ageUncertainty;
    stamp.beforeSending = about.beforeSending;
    stamp.arrived = about.arrival;
    stamp.decoding = m_picture->times.decode;
    stamp.filters = m_picture->times.temporal + m_picture->times.edge;
    stamp.window = m_picture->times.window;
    stamp.filterDelay = m_picture->treatment.filterDelay;
    stamp.painted = m_clock();
    m_state.notePainted(stamp);
    const auto age = stamp.captured ? std::optional(milliseconds(stamp.painted - *stamp.captured)) : std::nullopt;
    Q_EMIT picturePainted(stamp.frame, age);
    // Behind the present event, which ends when the window's pixels are handed over.
    QMetaObject::invokeMethod(
        this, [this, frame = stamp.frame, painted = stamp.painted] { m_state.notePresented(frame, m_clock() - painted); },
        Qt::QueuedConnection);
}

void LiveImageView::paintNothingYet(QPainter& painter)
{
    paintSolidFrame(painter, rect());
    painter.setPen(pane_colours::text);
    QFont large = overlayFont();
    large.setPixelSize(large.pixelSize() * 3 / 2);
    large.setWeight(QFont::DemiBold);
    painter.setFont(large);
    const QRect upper = rect().adjusted(40, 0, -40, -height() / 2 - 8);
    painter.drawText(upper, Qt::AlignHCenter | Qt::AlignBottom | Qt::TextWordWrap, tr("No picture yet"));
    painter.setFont(overlayFont());
    painter.setPen(pane_colours::secondary);
    const QString advice = m_refusal.isEmpty() ? tr("Open the link to the X-ray system and press its pedal.") : m_refusal;
    painter.drawText(rect().adjusted(40, height() / 2 + 8, -40, 0), Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap, advice);
}

/// Whole, in as many rows as it needs, and always at the same height above the foot.
QRect LiveImageView::paintRefusal(QPainter& painter, int footTop) const
{
    if (m_refusal.isEmpty())
        return {};
    const QFont font = overlayFont();
    const int gap = font.pixelSize() / 2;
    QRect room = pictureRect().adjusted(4 * gap, 0, -4 * gap, -13 * gap);
    room.setBottom(std::min(room.bottom(), footTop - gap));
    return paintWrapped(painter, font, m_refusal, room, Qt::AlignHCenter | Qt::AlignBottom);
}

void LiveImageView::describe(const PictureReading& reading)
{
    const QString words = conditionWords(reading);
    setAccessibleDescription(reading.reduction.stands() ? tr("%1 %2.").arg(words, line(reading.reduction)) : words);
}

QString LiveImageView::conditionWords(const PictureReading& reading)
{
    switch (reading.condition) {
    case PictureCondition::None:
        break;
    case PictureCondition::Live:
        return tr("The picture is live.");
    case PictureCondition::Unknown:
        return tr("Pictures come, but their age is unknown.");
    case PictureCondition::Frozen:
        return tr("The picture is frozen; it was taken at %1.").arg(clockTime(reading.captureNs));
    case PictureCondition::Held:
        return tr("Last image hold; the picture was taken at %1.").arg(clockTime(reading.captureNs));
    }
    return tr("No picture yet.");
}

} // namespace console
