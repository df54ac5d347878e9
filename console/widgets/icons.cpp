// Drawings are kept as white SVG lines and coloured when they are drawn.
#include "widgets/icons.hpp"

#include <QFile>
#include <QPainter>
#include <QSvgRenderer>

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

void draw(QPainter& painter, const QRectF& where, Icon icon, const QColor& colour)
{
    QFile file(QStringLiteral(":/liena/icons/%1.svg").arg(fileName(icon)));
    if (!file.open(QIODevice::ReadOnly))
        return;
    QByteArray drawing = file.readAll();
    drawing.replace("#ffffff", colour.name().toLatin1());
    QSvgRenderer renderer(drawing);
    const double side = std::min(where.width(), where.height());
    renderer.render(&painter, QRectF(where.center().x() - side / 2, where.center().y() - side / 2, side, side));
}

QPixmap pixmap(Icon icon, int size, const QColor& colour, double devicePixelRatio)
{
    QPixmap result(QSize(size, size) * devicePixelRatio);
    result.setDevicePixelRatio(devicePixelRatio);
    result.fill(Qt::transparent);
    QPainter painter(&result);
    draw(painter, QRectF(0, 0, size, size), icon, colour);
    return result;
}

} // namespace console::icons
