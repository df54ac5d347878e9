// The live picture: the pane that a surgeon moves instruments by.
#include "imaging/live_image_view.hpp"

#include "imaging/pane_colours.hpp"
#include "imaging/picture_overlay.hpp"

#include <QPainter>

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr int tickMs = 100;

} // namespace

LiveImageView::LiveImageView(PictureState& state, QWidget* parent)
    : QWidget(parent), m_state(state), m_clock([] { return std::chrono::steady_clock::now(); })
{
    setObjectName(QStringLiteral("liveImage"));
    setAttribute(Qt::WA_OpaquePaintEvent);
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
    // A frame that comes twice is not a sign of life.
    m_pictureIsNew = m_pictureIsNew || !m_picture || !picture.isSameFrameAs(*m_picture);
    m_picture = picture;
    update();
}

void LiveImageView::showRefusal(quint32 frame, const QString& reason)
{
    m_refusal = tr("Frame %1. %2").arg(frame).arg(reason);
    update();
}

QRect LiveImageView::pictureRect() const
{
    if (!m_picture)
        return {};
    const QRect room = rect().adjusted(hatchWidth, hatchWidth, -hatchWidth, -hatchWidth);
    QRect fitted(QPoint(0, 0), m_picture->image.size().scaled(room.size(), Qt::KeepAspectRatio));
    fitted.moveCenter(room.center());
    return fitted;
}

QFont LiveImageView::overlayFont() const
{
    QFont overlay = font();
    overlay.setPixelSize(std::clamp(static_cast<int>(std::lround(std::min(width(), height()) / 56.0)), 10, 32));
    return overlay;
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
        return;
    }
    paintPicture(painter);
    notePainted();
    const PictureReading reading = m_state.reading(m_clock());
    const bool frozen = reading.condition == PictureCondition::Frozen;
    if (frozen) {
        paintStaleVeil(painter, pictureRect());
        paintHatchedFrame(painter, rect());
    } else {
        paintSolidFrame(painter, rect());
    }
    const PictureOverlay overlay(pictureRect(), *m_picture, reading, m_paintedPictures, m_refusal, overlayFont());
    overlay.paint(painter);
    m_overlay = overlay.region();
    m_liveness = overlay.livenessRect();
    if (reading.condition != m_paintedCondition || reading.reduction != m_paintedReduction)
        describe(reading);
    m_paintedCondition = reading.condition;
    m_paintedReduction = reading.reduction;
}

void LiveImageView::paintPicture(QPainter& painter)
{
    const QRect target = pictureRect();
    const bool scaled = target.size() * devicePixelRatioF() != m_picture->image.size();
    painter.setRenderHint(QPainter::SmoothPixmapTransform, scaled);
    painter.drawImage(target, m_picture->image);
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
    stamp.reduction = reductionOf(about);
    stamp.captureNs = about.captureNs;
    stamp.captured = about.captured();
    stamp.uncertainty = about.ageUncertainty;
    stamp.arrived = about.arrival;
    stamp.painted = m_clock();
    m_state.notePainted(stamp);
    const auto age = stamp.captured ? std::optional(milliseconds(stamp.painted - *stamp.captured)) : std::nullopt;
    Q_EMIT picturePainted(stamp.frame, age);
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
