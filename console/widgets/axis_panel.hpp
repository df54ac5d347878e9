// One instrument on its drive: where it is between its limits, how fast it goes and was asked to go, and its gripper.
#pragma once

#include "model/instrument_state.hpp"
#include "widgets/icons.hpp"
#include "widgets/theme.hpp"

#include <QWidget>

#include <optional>

namespace console {

/// Of one of an instrument's two drives.
struct DriveReading {
    double current = 0;     ///< A
    double temperature = 0; ///< °C
};

struct AxisReading {
    Freshness freshness = Freshness::Unknown;
    Duration age{};
    double position = 0;                    ///< mm
    std::optional<InstrumentTravel> travel; ///< nothing until the robot has reported it
    double velocity = 0;                    ///< mm/s, advance positive
    double angle = 0;                       ///< deg
    double rotation = 0;                    ///< deg/s, clockwise from behind positive
    bool gripperClosed = false;
    bool softLow = false, softHigh = false, hardLow = false, hardHigh = false;
    std::optional<double> askedVelocity; ///< while engaged: what was commanded
    std::optional<double> askedRotation;
    Freshness drives = Freshness::Unknown;
    DriveReading advance, turn;
};

class AxisPanel : public QWidget {
    Q_OBJECT
public:
    AxisPanel(const QString& name, icons::Icon icon, QWidget* parent = nullptr);
    void setReading(const AxisReading& reading);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void paintName(QPainter& painter, const QRectF& where) const;
    void paintPosition(QPainter& painter, const QRectF& where) const;
    void paintAngle(QPainter& painter, const QRectF& where) const;
    void paintTrack(QPainter& painter, const QRectF& track) const;
    void paintLimits(QPainter& painter, const QRectF& track) const;
    void paintTrackEnds(QPainter& painter, const QRectF& where) const;
    struct Ends {
        double low, high;
    };
    Ends softEnds(const QRectF& track) const;
    double placeOf(double position, const QRectF& track) const;
    struct Speed {
        double value;
        std::optional<double> asked;
        double fullScale;
        QString words, unit;
        DriveReading drive;
    };
    theme::TextRole speedRole(double height) const;
    double speedBarHeight() const;
    double speedWidth(theme::TextRole role) const; ///< of words and figures at their widest
    void paintSpeed(QPainter& painter, const QRectF& where, theme::TextRole role, const Speed& speed) const;
    void paintDrive(QPainter& painter, const QRectF& where, const DriveReading& drive) const;
    QString driveText(const DriveReading& drive) const;
    QString limitWord(bool soft, bool hard) const;
    QString travelText() const; ///< for who does not see the bar
    QString figureText(double value, int decimals, const QString& unit) const;

    QString m_name;
    icons::Icon m_icon;
    AxisReading m_reading;
};

/// `advance`, `retract`, `still`.
QString advanceWord(double velocity);
/// `clockwise`, `anticlockwise`, `still`.
QString turnWord(double rotation);

} // namespace console
