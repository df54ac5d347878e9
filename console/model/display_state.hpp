// The display settings in force, and who changes them: the mouse on the picture, its keys, and the controls under it.
#pragma once

#include "model/display_settings.hpp"

#include <QObject>

namespace console {

/// What a picture pane does with the mouse, beside window and pan.
enum class MeasureMode : std::uint8_t { Off, Distance, Angle };
QString word(MeasureMode mode);

/// GUI thread only.
class DisplayState : public QObject {
    Q_OBJECT
public:
    explicit DisplayState(QObject* parent = nullptr);

    const DisplaySettings& settings() const { return m_settings; }
    void set(const DisplaySettings& settings);

    // One step of one setting each.
    void setAutomatic();
    void nextWindow(); ///< as sent, full range, half, twice, and round again
    void nextFunction();
    void nextShutter();
    void toggleInverted();
    void stepNoiseReduction(int steps);                          ///< of 10 %
    void stepEdge(int steps);                                    ///< of 10 %
    void setWindow(GreyWindow window, const WindowBasis& basis); ///< of the picture on which it was set

    /// Everything as it is without a person's choice.
    void reset();

    MeasureMode measureMode() const { return m_measure; }
    void nextMeasureMode();

    const MeasurePlane& plane() const { return m_plane; }

    /// From the isocentre's to that above the table at the usual height, then to each other of objectHeights, and back.
    void nextPlane();

    /// `usualObject`: one of objectHeights; where it is another than before, a plane above the table that is chosen goes there.
    void setTable(std::optional<int> tableTop, int usualObject);

Q_SIGNALS:
    void changed(const console::DisplaySettings& settings);
    void measureModeChanged(console::MeasureMode mode);
    void planeChanged(const console::MeasurePlane& plane);

private:
    void setPlane(const MeasurePlane& plane);

    DisplaySettings m_settings;
    MeasureMode m_measure = MeasureMode::Off;
    MeasurePlane m_plane;
    int m_usualObject = 100; ///< mm
};

} // namespace console
