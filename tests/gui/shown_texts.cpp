// Painting into an engine that only listens.
#include "shown_texts.hpp"

#include "widgets/alarm_band.hpp"
#include "widgets/guard_list.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/log_lines.hpp"
#include "widgets/permit_block.hpp"
#include "widgets/stop_button.hpp"

#include <QAbstractButton>
#include <QAbstractScrollArea>
#include <QGraphicsView>
#include <QLabel>
#include <QLineEdit>
#include <QPaintDevice>
#include <QPaintEngine>
#include <QPainter>
#include <QRegularExpression>

namespace console::test {

namespace {

constexpr double slack = 1.5; // px: half a pixel each way, and rounding

class Listener : public QPaintEngine {
public:
    Listener() : QPaintEngine(AllFeatures) {}

    bool begin(QPaintDevice*) override { return true; }
    bool end() override { return true; }
    Type type() const override { return User; }
    void updateState(const QPaintEngineState&) override {}
    void drawPixmap(const QRectF&, const QPixmap&, const QRectF&) override {}
    void drawImage(const QRectF&, const QImage&, const QRectF&, Qt::ImageConversionFlags) override {}
    void drawPath(const QPainterPath&) override {}
    void drawPolygon(const QPointF*, int, PolygonDrawMode) override {}
    void drawTiledPixmap(const QRectF&, const QPixmap&, const QPointF&) override {}

    void drawTextItem(const QPointF& at, const QTextItem& item) override
    {
        const QFontMetricsF metrics(item.font());
        const QRectF ink(at.x(), at.y() - metrics.capHeight(), item.width(), metrics.capHeight());
        const QTransform way = painter()->combinedTransform();
        const QRectF room = painter()->hasClipping() ? way.mapRect(painter()->clipBoundingRect()) : QRectF();
        texts.push_back({item.text(), way.mapRect(ink), room});
    }

    std::vector<ShownText> texts;
};

class ListeningDevice : public QPaintDevice {
public:
    explicit ListeningDevice(const QWidget& widget) : m_widget(widget) {}

    QPaintEngine* paintEngine() const override { return &m_listener; }
    std::vector<ShownText> texts() const { return m_listener.texts; }

protected:
    int metric(PaintDeviceMetric metric) const override
    {
        switch (metric) {
        case PdmWidth:
            return m_widget.width();
        case PdmHeight:
            return m_widget.height();
        case PdmDpiX:
        case PdmPhysicalDpiX:
            return m_widget.logicalDpiX();
        case PdmDpiY:
        case PdmPhysicalDpiY:
            return m_widget.logicalDpiY();
        case PdmDepth:
            return 32;
        case PdmNumColors:
            return 1 << 24;
        case PdmDevicePixelRatio:
            return 1;
        case PdmDevicePixelRatioScaled:
            return int(QPaintDevice::devicePixelRatioFScale());
        default:
            return 0;
        }
    }

private:
    const QWidget& m_widget;
    mutable Listener m_listener;
};

QString place(const QRectF& where)
{
    return QStringLiteral("%1,%2 %3x%4").arg(int(where.x())).arg(int(where.y())).arg(int(where.width())).arg(int(where.height()));
}

/// Whoever acts on these must see the whole, and at once.
bool isSafety(const QWidget& widget)
{
    return qobject_cast<const AlarmBand*>(&widget) || qobject_cast<const PermitBlock*>(&widget) ||
           qobject_cast<const GuardList*>(&widget) || qobject_cast<const HoldButton*>(&widget) || qobject_cast<const StopButton*>(&widget);
}

/// The whole is one gesture away: on a line of a log by choosing it, elsewhere by the tool tip.
bool mayBeCut(const QWidget& widget)
{
    const auto* lines = qobject_cast<const LogLines*>(widget.parentWidget());
    return (lines && lines->viewport() == &widget) || (!isSafety(widget) && !widget.toolTip().isEmpty());
}

bool holds(const QRectF& room, const QRectF& ink) { return room.adjusted(-slack, -slack, slack, slack).contains(ink); }

void judgePainted(QWidget& widget, QStringList& wrong)
{
    const auto name = QStringLiteral("%1 \"%2\"").arg(QString::fromLatin1(widget.metaObject()->className()), widget.accessibleName());
    const auto texts = textsPaintedBy(widget);
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const ShownText& shown = texts[i];
        if (shown.text.trimmed().isEmpty())
            continue;
        const bool clipped = !holds(QRectF(widget.rect()), shown.ink) || (!shown.room.isNull() && !holds(shown.room, shown.ink));
        if (clipped && !mayBeCut(widget))
            wrong << QStringLiteral("%1 clips \"%2\" at %3; it is %4x%5, the painter lets through %6")
                         .arg(name, shown.text, place(shown.ink))
                         .arg(widget.width())
                         .arg(widget.height())
                         .arg(place(shown.room));
        for (std::size_t j = 0; j < i; ++j) {
            const QRectF both = texts[j].ink & shown.ink;
            if (!texts[j].text.trimmed().isEmpty() && both.width() > 2 * slack && both.height() > slack)
                wrong << QStringLiteral("%1 paints \"%2\" over \"%3\"").arg(name, shown.text, texts[j].text);
        }
        if (shown.text.size() > 1 && shown.text.contains(QChar(0x2026)) &&
            !shown.text.contains(QRegularExpression(QStringLiteral("(link|Checking|Writing).*…"))) && !mayBeCut(widget))
            wrong << QStringLiteral("%1 cuts short \"%2\"").arg(name, shown.text);
    }
}

void judgeSize(const QWidget& widget, QStringList& wrong)
{
    const auto* label = qobject_cast<const QLabel*>(&widget);
    const auto* button = qobject_cast<const QAbstractButton*>(&widget);
    const QString text = label ? label->text() : button ? button->text() : QString();
    if (text.isEmpty())
        return;
    const QSize asked = widget.sizeHint();
    const bool fits = label && label->wordWrap() ? label->heightForWidth(label->width()) <= label->height()
                                                 : asked.width() <= widget.width() && asked.height() <= widget.height();
    if (!fits && !mayBeCut(widget))
        wrong << QStringLiteral("%1 \"%2\" is %3x%4 and needs %5x%6")
                     .arg(QString::fromLatin1(widget.metaObject()->className()), text)
                     .arg(widget.width())
                     .arg(widget.height())
                     .arg(asked.width())
                     .arg(asked.height());
}

} // namespace

std::vector<ShownText> textsPaintedBy(QWidget& widget)
{
    ListeningDevice device(widget);
    widget.render(&device, QPoint(), QRegion(), QWidget::RenderFlags());
    return device.texts();
}

QString wordsPaintedBy(QWidget& widget)
{
    QString all;
    for (const ShownText& shown : textsPaintedBy(widget))
        all += shown.text;
    return all;
}

QStringList unreadableTexts(QWidget& window)
{
    QStringList wrong;
    auto widgets = window.findChildren<QWidget*>();
    widgets.prepend(&window);
    for (QWidget* widget : widgets) {
        // A canvas is zoomed by whoever looks, and a line edit scrolls.
        if (!widget->isVisible() || widget->size().isEmpty() || qobject_cast<QLineEdit*>(widget) || qobject_cast<QGraphicsView*>(widget) ||
            qobject_cast<QGraphicsView*>(widget->parentWidget()))
            continue;
        judgeSize(*widget, wrong);
        judgePainted(*widget, wrong);
    }
    return wrong;
}

} // namespace console::test
