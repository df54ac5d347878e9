// The canvas's kinds of things: a device, a link, and a link's label.
#pragma once

#include "editor/topology_layout.hpp"

#include <QGraphicsItem>

namespace console {

/// Texts grow by at most this where the whole is shown small.
inline constexpr double largestTextFactor = 1.35;

class DeviceItem : public QGraphicsItem {
public:
    DeviceItem(const DeviceNode& device, const QRectF& box, bool mini);
    quint32 id() const { return m_device.id; }
    void setCurrent(bool current);
    void setTextFactor(double factor);
    QRectF boundingRect() const override;
    void paint(QPainter* painter, const QStyleOptionGraphicsItem* option, QWidget* widget) override;

private:
    DeviceNode m_device;
    QRectF m_box;
    bool m_mini;
    bool m_current = false;
    double m_factor = 1;
};

class LinkItem : public QGraphicsItem {
public:
    LinkItem(const LinkNode& link, PlacedLink place, bool mini);
    quint32 a() const { return m_link.a; }
    quint32 b() const { return m_link.b; }
    void setCurrent(bool current);
    void setLink(const LinkNode& link, Instant now);
    /// Where the widest label beside a lane ends, in any state; 0 for a link whose label stands on its line.
    double roomBeside() const;
    void setTextFactor(double factor);
    QRectF labelBox() const;
    void paintLabel(QPainter& painter) const;
    QRectF boundingRect() const override;
    QPainterPath shape() const override;
    void paint(QPainter* painter, const QStyleOptionGraphicsItem* option, QWidget* widget) override;

private:
    QString stateText() const;
    QString figureText() const;
    void paintWay(QPainter& painter) const;

    LinkNode m_link;
    PlacedLink m_place;
    Instant m_now;
    bool m_mini;
    bool m_current = false;
    double m_factor = 1; ///< of the text: grows when the canvas is small
};

/// By itself, so that no other link's line is drawn through it. The link outlives it; whoever changes the link announces it here before.
class LinkLabel : public QGraphicsItem {
public:
    explicit LinkLabel(const LinkItem& link);
    void announceChange() { prepareGeometryChange(); }
    QRectF boundingRect() const override { return m_link.labelBox().adjusted(-4, -4, 4, 4); }
    QPainterPath shape() const override;
    void paint(QPainter* painter, const QStyleOptionGraphicsItem* option, QWidget* widget) override;

private:
    const LinkItem& m_link;
};

} // namespace console
