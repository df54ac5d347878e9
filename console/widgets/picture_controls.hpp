// The controls under the live picture: window, zoom, filters, shutter, measuring, saving.
#pragma once

#include "model/display_state.hpp"

#include <QWidget>

#include <functional>

class QBoxLayout;
class QLabel;

namespace console {

class SmallButton;

/// A row of small buttons, or two where the pane is narrow. A click does not take the focus: the keys stay with the hand; Tab reaches every
/// one. `display` outlives it.
class PictureControls : public QWidget {
    Q_OBJECT
public:
    explicit PictureControls(DisplayState& display, QWidget* parent = nullptr);

    void showZoom(double zoom);

Q_SIGNALS:
    void zoomRequested(int steps);
    void wholeRequested();
    void saveRequested();
    void catheterRequested(); ///< the distance that stands is the width of the next one
    void planeRequested();

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    SmallButton* addButton(const QString& text, const QString& name, const QString& tip);
    void addGap(int width);
    QLabel* addStepper(const QString& name, const std::function<void(int)>& step);
    void buildWindowButtons();
    void buildSteppers();
    void buildToolButtons();
    void buildMeasuringButtons();
    void showMeasuring(MeasureMode mode);
    void showPlane(const MeasurePlane& plane);
    void showSettings(const DisplaySettings& settings);

    DisplayState& m_display;
    QBoxLayout* m_rows;
    QBoxLayout* m_row = nullptr; ///< that buttons are added to
    SmallButton* m_automatic = nullptr;
    SmallButton* m_window = nullptr;
    SmallButton* m_invert = nullptr;
    SmallButton* m_shutter = nullptr;
    SmallButton* m_measure = nullptr;
    SmallButton* m_catheter = nullptr;
    SmallButton* m_plane = nullptr;
    QLabel* m_zoom = nullptr;
    QLabel* m_noise = nullptr;
    QLabel* m_edge = nullptr;
};

} // namespace console
