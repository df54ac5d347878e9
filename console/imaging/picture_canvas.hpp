// A pane with an X-ray picture in it: window, zoom, pan and measuring by mouse and keys.
#pragma once

#include "imaging/display_picture.hpp"
#include "imaging/measurement.hpp"
#include "imaging/picture_viewport.hpp"
#include "model/display_state.hpp"
#include "model/table_rest.hpp"

#include <QPointer>
#include <QRegion>
#include <QScreen>
#include <QString>
#include <QStringList>
#include <QTimer>
#include <QWidget>

#include <optional>

namespace console {

/// Left button: window (sideways its width, up and down its centre), or a point while measuring; middle button, or Shift with the left:
/// pan; right button while measuring: the distance is a catheter's width, with Shift: the next plane of lengths; wheel: zoom. Keys while
/// the pane has the focus, none of them one of the hand's: + − zoom, 8 2 4 6 pan, Home whole picture, A automatic window, P next window, V
/// next function, Q W narrower and wider, S X lower and higher centre, N invert, T Shift+T noise reduction, E Shift+E edges, H shutter, M
/// measure, 5 point, B catheter, O plane, Delete clear. All other keys are left to the window.
class PictureCanvas : public QWidget {
    Q_OBJECT
public:
    explicit PictureCanvas(QWidget* parent = nullptr);

    /// Whose settings mouse and keys change; outlives the pane. Without one they change nothing.
    void setDisplay(DisplayState* display);

    /// Where the picture stands in the pane; empty without one.
    QRect pictureRect() const;

    /// Fitted to the present pane and picture.
    PictureViewport viewport() const;

    const Measurement& measurement() const { return m_measurement; }

    void zoomBy(double factor);
    void resetView();
    void clearMeasurement();
    void nextCatheter(); ///< without a distance it says what is missing
    void nextPlane();

    /// Where the table stood in which picture; outlives the pane. Without one the table never moves.
    void setTable(const TableRest* table) { m_table = table; }

    /// Of whose light pictures are calibrated to; on another one none of them is. Without this they are on any.
    void setMeasuredScreen(const QScreen* screen) { m_measuredScreen = screen; }

    /// `picture` as it has to be called where the pane is.
    DisplayPicture asSeenHere(DisplayPicture picture) const;

    /// It was reported anew: where it stood in the picture that is shown may be known better, or no more.
    void followTable();

    /// What became of a button that was pressed: in the pane for some seconds.
    void tell(const QString& what);
    const QString& told() const { return m_told; }

Q_SIGNALS:
    void viewChanged();
    void pointSet(); ///< by mouse or key: this is where a person measures

protected:
    bool event(QEvent* event) override;

    /// What stands in the pane; null for nothing.
    virtual const DisplayPicture* shown() const = 0;

    /// The subclass tells of each picture when shown() gives it, and before it paints it. One of another size is shown whole.
    void followPicture(const DisplayPicture& picture);
    void paintShown(QPainter& painter) const;

    /// Over the picture, what fits on it whatever its resolution; `opacity` 0 to 1.
    void paintOver(QPainter& painter, const QImage& layer, double opacity) const;
    QRegion paintMeasurement(QPainter& painter, const QRegion& taken) const; ///< beside what other words have taken
    QRegion paintTold(QPainter& painter, const QRect& below = {}) const; ///< at the foot of the pane, above `below` where that is not empty

    /// With its upper left corner there: beneath words at the picture's edge, so that the middle stays free.
    QRegion paintToldAt(QPainter& painter, QPoint corner) const;
    QFont overlayFont() const;

    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

private:
    enum class Drag { None, Window, Pan };

    bool takeViewKey(int key);
    bool takeWindowKey(int key);
    bool takeDisplayKey(int key, bool shift);
    bool takeMeasureKey(int key);
    bool step(int key, QPointF& by) const;
    void moveWindow(double centreShare, double widthShare);
    void addPoint(QPointF picture);
    QStringList measuredWords() const;

    DisplayState* m_display = nullptr;
    const TableRest* m_table = nullptr;
    std::optional<QPointer<const QScreen>> m_measuredScreen;
    QString m_told;
    QTimer m_tellingEnds;
    PictureViewport m_viewport;
    Measurement m_measurement;
    std::optional<QPointF> m_cursor; ///< of the keys while measuring, in pixels of the picture
    Drag m_drag = Drag::None;
    QPointF m_dragStart;
    QPointF m_dragLast;
    GreyWindow m_dragWindow;
    WindowBasis m_dragBasis;
};

} // namespace console
