// Axial force on the guidewire as an arc, with the marks of warning and stop, the peak, and ten seconds behind it.
#pragma once

#include "model/instrument_state.hpp"

#include <QPainterPath>
#include <QWidget>

namespace console {

class ForceGauge : public QWidget {
    Q_OBJECT
public:
    explicit ForceGauge(QWidget* parent = nullptr);
    void setState(const InstrumentState& instrument, Instant now);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    double angleOf(double force) const;
    void paintArc(QPainter& painter, const QRectF& circle) const;
    void paintMark(QPainter& painter, const QRectF& circle, double force, const QString& words) const;
    void paintWords(QPainter& painter, const QRectF& circle) const;
    double faceFoot(const QRectF& circle) const;
    QRectF faceCircle() const;
    void paintTrail(QPainter& painter, const QRectF& where) const;
    QPainterPath trailPath(const QRectF& where) const;

    Freshness m_freshness = Freshness::Unknown;
    Duration m_age{};
    double m_force = 0;
    double m_peak = 0;
    RobotLimits m_limits;
    std::deque<InstrumentState::ForceSample> m_trail;
    Instant m_now;
};

} // namespace console
