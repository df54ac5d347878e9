// The three-dimensional pane: what is painted over the drawing.
#include "imaging/pane_colours.hpp"
#include "imaging/scene_view.hpp"
#include "imaging/text_plates.hpp"

#include <QPainter>

#include <array>

namespace console {

namespace {

constexpr double ringRadius = 9; // pixels

} // namespace

void SceneView::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.fillRect(rect(), pane_colours::background);
    TextPlates plates(paneFont(*this));
    placeWords(plates);
    m_overlay = {};
    if (!m_drawn.image.isNull()) {
        painter.drawImage(rect(), m_drawn.image);
        paintTipBefore(painter, plates);
        placeTipMark(plates);
        placeLetters(plates);
    }
    m_overlay = paintNotice(painter) + plates.region();
    plates.paint(painter);
    paintFrame(painter);
}

void SceneView::placeWords(TextPlates& plates) const
{
    const int margin = plates.gap();
    QPoint corner(margin, margin);
    const auto add = [&](const QString& text, const QFont& font) {
        corner.setY(plates.add(text, font, corner, Qt::AlignLeft | Qt::AlignTop).bottom() + 1);
    };
    add(tr("3-D SCENE"), plates.font());
    if (!m_state.tip)
        add(tr("tip not tracked"), plates.font());
    else if (m_state.tip->isStale)
        add(tr("tip position stale"), plates.font());
    if (const QString picture = pictureWords(); !picture.isEmpty())
        add(picture, plates.font());
}

// A letter whose place is taken already stands nearer to the middle, on the same line of sight.
void SceneView::placeLetters(TextPlates& plates) const
{
    constexpr double nearest = 0.5;
    constexpr double step = 0.05;
    const std::array<QVector3D, 6> sides{QVector3D(1, 0, 0),  QVector3D(-1, 0, 0), QVector3D(0, 1, 0),
                                         QVector3D(0, -1, 0), QVector3D(0, 0, 1),  QVector3D(0, 0, -1)};
    // Far enough from the focus to stand near the pane's edge at any zoom.
    const double reach = m_drawn.camera.distance() * 0.2;
    const QFont font = larger(plates.font(), 1.1);
    for (const QVector3D& side : sides) {
        const bool faces = QVector3D::dotProduct(side, m_drawn.camera.offset()) > 0;
        for (double share = 1; share >= nearest; share -= step) {
            const auto place = m_drawn.camera.project(side * static_cast<float>(share * reach), size());
            if (!place)
                break;
            TextPlates alone(plates.font());
            if (!plates.isFree(alone.add(sideLetter(side), font, place->toPoint(), Qt::AlignHCenter | Qt::AlignVCenter)))
                continue;
            plates.add(sideLetter(side), font, place->toPoint(), Qt::AlignHCenter | Qt::AlignVCenter);
            plates.setInk(faces ? pane_colours::text : pane_colours::secondary);
            break;
        }
    }
}

void SceneView::placeTipMark(TextPlates& plates) const
{
    if (!m_state.tip || !m_state.tip->isStale)
        return;
    if (const auto place = placeOf(m_state.tip->position))
        plates.add(tr("? LAST KNOWN"), larger(plates.font(), 1), (*place + QPointF(14, -6)).toPoint(), Qt::AlignLeft | Qt::AlignBottom);
}

std::optional<QPointF> SceneView::placeOf(const QVector3D& inPatient) const
{
    return m_drawn.camera.project(toScene(inPatient) - m_focus, size());
}

/// A ring where it was, and a dashed line to where it is now.
void SceneView::paintTipBefore(QPainter& painter, TextPlates& plates) const
{
    const auto before = m_tipBefore ? placeOf(*m_tipBefore) : std::nullopt;
    if (!before)
        return;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(pane_colours::text, 2));
    painter.drawEllipse(*before, ringRadius, ringRadius);
    const QFont font = larger(plates.font(), 1);
    plates.add(tr("BEFORE"), font, (*before - QPointF(ringRadius, ringRadius + 2)).toPoint(), Qt::AlignLeft | Qt::AlignBottom);
    const auto now = m_state.tip ? placeOf(m_state.tip->position) : std::nullopt;
    if (!now)
        return;
    plates.add(tr("NOW"), font, (*now + QPointF(ringRadius, ringRadius + 2)).toPoint(), Qt::AlignLeft | Qt::AlignTop);
    painter.setPen(QPen(pane_colours::text, 2, Qt::DashLine));
    if (const QLineF way(*before, *now); way.length() > ringRadius)
        painter.drawLine(way.pointAt(ringRadius / way.length()), *now);
}

// Dashed: not the live pane.
void SceneView::paintFrame(QPainter& painter) const
{
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(hasFocus() ? pane_colours::focus : pane_colours::line, hasFocus() ? 3 : 2, Qt::DashLine));
    painter.drawRect(rect().adjusted(1, 1, -2, -2));
}

QRegion SceneView::paintNotice(QPainter& painter) const
{
    const QString words = notice();
    if (words.isEmpty())
        return {};
    return paintWrapped(painter, paneFont(*this), words, rect().adjusted(24, 80, -24, -24), Qt::AlignCenter);
}

} // namespace console
