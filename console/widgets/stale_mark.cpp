// Grey, mark and words for values that are old or were never there.
#include "widgets/stale_mark.hpp"

#include "widgets/figures.hpp"
#include "widgets/theme.hpp"

#include <QCoreApplication>
#include <QPainter>

namespace console {

namespace colour = theme::colour;

QColor valueInk(Freshness freshness)
{
    return freshness == Freshness::Fresh ? colour::bright : freshness == Freshness::Stale ? colour::stale : colour::secondary;
}

QString ageText(Freshness freshness, Duration age)
{
    switch (freshness) {
    case Freshness::Fresh:
        return QCoreApplication::translate("console::StaleMark", "age %1").arg(spokenAge(age));
    case Freshness::Stale:
        return QCoreApplication::translate("console::StaleMark", "stale %1").arg(spokenAge(age));
    case Freshness::Unknown:
        break;
    }
    return QCoreApplication::translate("console::StaleMark", "never received");
}

void drawStaleMark(QPainter& painter, const QRectF& where, Freshness freshness)
{
    if (freshness == Freshness::Fresh)
        return;
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(colour::secondary, std::max(1.2, where.height() * 0.09)));
    painter.setBrush(Qt::NoBrush);
    const QRectF face = where.adjusted(1, 1, -1, -1);
    painter.drawEllipse(face);
    if (freshness == Freshness::Stale) {
        painter.drawLine(face.center(), QPointF(face.center().x(), face.top() + face.height() * 0.2));
        painter.drawLine(face.center(), QPointF(face.right() - face.width() * 0.22, face.center().y()));
    } else {
        painter.drawLine(QPointF(face.left() + face.width() * 0.15, face.bottom() - face.height() * 0.15),
                         QPointF(face.right() - face.width() * 0.15, face.top() + face.height() * 0.15));
    }
    painter.restore();
}

} // namespace console
