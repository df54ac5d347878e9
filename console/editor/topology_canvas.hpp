// The topology as a picture: devices in lanes by site, links as double arrows with what is known of them.
#pragma once

#include "model/session_model.hpp"

#include <QGraphicsView>
#include <QTimer>

#include <optional>
#include <utility>
#include <vector>

namespace console {

class DeviceItem;
class LinkItem;
class LinkLabel;

/// Shows a session model: a link's state at once, its figures five times a second while visible. Tab walks devices, then links; Enter or a
/// click chooses.
class TopologyCanvas : public QGraphicsView {
    Q_OBJECT
public:
    enum class Size {
        Full,
        Mini, ///< icons and arrows only; one click anywhere chooses the whole
    };

    TopologyCanvas(const SessionModel& sessions, Size size, QWidget* parent = nullptr);
    ~TopologyCanvas() override;

    void refresh(Instant now);

    /// The ends of the link that has the canvas's focus.
    std::optional<std::pair<quint32, quint32>> currentLink() const;
    std::optional<quint32> currentDevice() const;

    QSize sizeHint() const override;

    /// Where a link or a device stands, in the viewport's pixels.
    QPoint placeOfLink(quint32 a, quint32 b) const;
    QPoint placeOfDevice(quint32 id) const;

Q_SIGNALS:
    void linkChosen(quint32 a, quint32 b);
    void deviceChosen(quint32 id);
    void chosen(); ///< Mini: the whole was clicked

protected:
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    bool focusNextPrevChild(bool next) override;
    void drawBackground(QPainter* painter, const QRectF& rect) override;

private:
    void rebuild();
    void fit();
    void announceLabels();
    void setCurrent(int index);
    void activate(int index);
    int indexAt(const QPoint& place) const;
    int count() const;

    const SessionModel& m_sessions;
    Size m_size;
    QGraphicsScene* m_scene;
    std::vector<DeviceItem*> m_devices;
    std::vector<LinkItem*> m_links;
    std::vector<LinkLabel*> m_labels; ///< in the order of the links; none when it is shown small
    std::vector<std::pair<QString, QRectF>> m_lanes;
    int m_current = -1; ///< devices first, then links
    QTimer m_clock;
};

} // namespace console
