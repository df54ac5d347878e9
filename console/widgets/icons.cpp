// Drawings are kept as white SVG lines and coloured when they are drawn.
#include "widgets/icons.hpp"

#include <QFile>
#include <QPainter>
#include <QPixmapCache>
#include <QSvgRenderer>

#include <algorithm>
#include <cmath>

namespace console::icons {

namespace {

QString fileName(Icon icon)
{
    switch (icon) {
    case Icon::Hand:
        return QStringLiteral("hand");
    case Icon::Eye:
        return QStringLiteral("eye");
    case Icon::Brain:
        return QStringLiteral("brain");
    case Icon::Arm:
        return QStringLiteral("arm");
    case Icon::Special:
        return QStringLiteral("special");
    case Icon::Xray:
        return QStringLiteral("xray");
    case Icon::DeadMan:
        return QStringLiteral("deadman");
    case Icon::Clutch:
        return QStringLiteral("clutch");
    case Icon::Hold:
        return QStringLiteral("hold");
    case Icon::Guidewire:
        return QStringLiteral("guidewire");
    case Icon::Catheter:
        return QStringLiteral("catheter");
    }
    return QStringLiteral("special");
}

} // namespace

Icon forKind(DeviceKind kind)
{
    switch (kind) {
    case DeviceKind::Hand:
        return Icon::Hand;
    case DeviceKind::Eye:
        return Icon::Eye;
    case DeviceKind::Brain:
        return Icon::Brain;
    case DeviceKind::Arm:
        return Icon::Arm;
    case DeviceKind::Special:
        break;
    }
    return Icon::Special;
}

namespace {

// Parsed once and drawn into pictures that are kept: the same few icons are painted many times a second.
QPixmap rendered(Icon icon, int side, const QColor& colour)
{
    const QString key = QStringLiteral("liena-icon-%1-%2-%3").arg(int(icon)).arg(side).arg(colour.rgba(), 8, 16);
    QPixmap picture;
    if (QPixmapCache::find(key, &picture))
        return picture;
    QFile file(QStringLiteral(":/liena/icons/%1.svg").arg(fileName(icon)));
    if (!file.open(QIODevice::ReadOnly))
        return {};
    QByteArray drawing = file.readAll();
    drawing.replace("#ffffff", colour.name().toLatin1());
    picture = QPixmap(side, side);
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    QSvgRenderer(drawing).render(&painter, QRectF(0, 0, side, side));
    painter.end();
    QPixmapCache::insert(key, picture);
    return picture;
}

} // namespace

void draw(QPainter& painter, const QRectF& where, Icon icon, const QColor& colour)
{
    const QTransform& transform = painter.deviceTransform();
    const double zoom = std::hypot(transform.m11(), transform.m12());
    const double side = std::min(where.width(), where.height());
    const QPixmap picture = rendered(icon, std::max(1, int(std::lround(side * zoom))), colour);
    painter.drawPixmap(QRectF(where.center().x() - side / 2, where.center().y() - side / 2, side, side), picture, QRectF(picture.rect()));
}

} // namespace console::icons
