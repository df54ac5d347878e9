// One link of this console: device, both directions, state, figures, the last minute, and the one thing to do.
#pragma once

#include "model/session_model.hpp"

#include <QElapsedTimer>
#include <QFrame>

class QPushButton;

namespace console {

class LinkCard : public QFrame {
    Q_OBJECT
public:
    explicit LinkCard(quint32 peer, QWidget* parent = nullptr);

    quint32 peer() const { return m_peer; }

    /// Ages are those of LinkNode::heardAgo(now); they stand until the next call.
    void setLink(const LinkNode& link, const DeviceNode& device, Instant now);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

Q_SIGNALS:
    void openRequested(quint32 peer);
    void closeRequested(quint32 peer);
    void reopenRequested(quint32 peer);

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    struct Metrics;
    Metrics metricsNow() const;
    void paintHead(QPainter& painter, const Metrics& m) const;
    void paintDirections(QPainter& painter, const Metrics& m) const;
    void paintFigures(QPainter& painter, const Metrics& m) const;
    void updateButton();
    void act();

    quint32 m_peer;
    LinkNode m_link;
    DeviceNode m_device;
    Instant m_now;
    QPushButton* m_action;
    QElapsedTimer m_acted; ///< since the last wish
};

} // namespace console
