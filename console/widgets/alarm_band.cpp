// The band's colour says the priority from afar; its badge flashes, its text never does.
#include "widgets/alarm_band.hpp"

#include "widgets/theme.hpp"

#include <QHBoxLayout>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>

#include <algorithm>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

struct Colours {
    QColor surface, ink, badgeLit, badgeDim, badgeInkLit, badgeInkDim;
};

Colours coloursOf(AlarmPriority priority, bool acknowledged)
{
    switch (priority) {
    case AlarmPriority::High:
        return {acknowledged ? colour::highSurfaceDim : colour::highSurface,
                Qt::white,
                Qt::white,
                colour::highSurfaceDim,
                colour::highSurface,
                Qt::white};
    case AlarmPriority::Medium:
        return {acknowledged ? colour::mediumSurfaceDim : colour::medium,
                acknowledged ? QColor(Qt::white) : colour::onAlarm,
                colour::onAlarm,
                colour::mediumSurfaceDim,
                colour::medium,
                Qt::white};
    case AlarmPriority::Low:
        break;
    }
    return {acknowledged ? colour::raised : colour::low,
            acknowledged ? colour::low : colour::onAlarm,
            colour::onAlarm,
            colour::onAlarm,
            colour::low,
            colour::low};
}

QString badgeWord(AlarmPriority priority) { return word(priority).toUpper(); }

// Shape as well as colour: one bar for low, two for medium, three for high.
void drawBars(QPainter& painter, const QRectF& where, AlarmPriority priority)
{
    const int bars = priority == AlarmPriority::High ? 3 : priority == AlarmPriority::Medium ? 2 : 1;
    const double step = where.width() / 3;
    for (int i = 0; i < bars; ++i) {
        const double tall = where.height() * (0.45 + 0.275 * i);
        painter.fillRect(QRectF(where.left() + i * step, where.bottom() - tall, step * 0.6, tall), painter.pen().color());
    }
}

} // namespace

FlashClock::FlashClock(QObject* parent) : QObject(parent)
{
    m_high.setInterval(highHalfPeriodMs);
    m_medium.setInterval(mediumHalfPeriodMs);
    connect(&m_high, &QTimer::timeout, this, [this] {
        m_highLit = !m_highLit;
        Q_EMIT ticked();
    });
    connect(&m_medium, &QTimer::timeout, this, [this] {
        m_mediumLit = !m_mediumLit;
        Q_EMIT ticked();
    });
    m_high.start();
    m_medium.start();
}

bool FlashClock::isLit(AlarmPriority priority) const
{
    return priority == AlarmPriority::High ? m_highLit : priority == AlarmPriority::Medium ? m_mediumLit : true;
}

AlarmBand::AlarmBand(QWidget* parent)
    : QFrame(parent), m_row(new QHBoxLayout(this)), m_acknowledge(new QPushButton(tr("Acknowledge"), this))
{
    setAccessibleName(tr("Alarms"));
    theme::setTextRole(this, TextRole::Alarm);
    theme::setTextRole(m_acknowledge, TextRole::Strong);
    m_acknowledge->setAccessibleName(tr("Acknowledge the alarm shown"));
    m_acknowledge->setAutoDefault(false);
    m_acknowledge->setProperty("compact", true);
    m_acknowledge->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
    QSizePolicy kept = m_acknowledge->sizePolicy();
    kept.setRetainSizeWhenHidden(true);
    m_acknowledge->setSizePolicy(kept);
    m_acknowledge->hide();
    m_row->setContentsMargins(6, 5, 8, 5);
    m_row->setSpacing(8);
    m_row->addStretch(1);
    m_row->addWidget(m_acknowledge);
    connect(m_acknowledge, &QPushButton::clicked, this, [this] {
        if (const Alarm* alarm = firstUnacknowledged())
            Q_EMIT acknowledgeRequested(alarm->id);
    });
    connect(&m_clock, &FlashClock::ticked, this, [this] {
        if (!m_alarms.empty())
            update();
    });
}

const Alarm* AlarmBand::firstUnacknowledged() const
{
    const auto found = std::find_if(m_alarms.begin(), m_alarms.end(), [](const Alarm& alarm) { return !alarm.acknowledged; });
    return found == m_alarms.end() ? nullptr : &*found;
}

void AlarmBand::setAlarms(const std::vector<Alarm>& alarms)
{
    m_alarms = alarms;
    const Alarm* next = firstUnacknowledged();
    m_acknowledge->setVisible(next != nullptr);
    if (next)
        m_acknowledge->setAccessibleDescription(next->text);
    QStringList lines;
    for (const Alarm& alarm : m_alarms)
        lines << word(alarm.priority) + QStringLiteral(": ") + alarm.text + QStringLiteral(" ") + alarm.remedy;
    setAccessibleDescription(lines.isEmpty() ? tr("No alarms") : lines.join(QLatin1Char('\n')));
    setToolTip(lines.join(QLatin1Char('\n')).toHtmlEscaped());
    update();
}

void AlarmBand::setFoldedSheets(const std::vector<std::pair<quint64, QString>>& sheets)
{
    if (sheets == m_folded)
        return;
    m_folded = sheets;
    for (QPushButton* chip : m_chips)
        delete chip;
    m_chips.clear();
    for (const auto& [key, text] : sheets) {
        auto* chip = new QPushButton(text, this);
        theme::setTextRole(chip, TextRole::Strong);
        chip->setAccessibleName(tr("Show again: %1").arg(text));
        chip->setAutoDefault(false);
        chip->setProperty("compact", true);
        chip->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
        connect(chip, &QPushButton::clicked, this, [this, key = key] { Q_EMIT sheetRequested(key); });
        m_row->insertWidget(m_row->count() - 1, chip);
        chip->show();
        m_chips.push_back(chip);
    }
}

QColor AlarmBand::surface() const
{
    return m_alarms.empty() ? colour::panel : coloursOf(m_alarms.front().priority, m_alarms.front().acknowledged).surface;
}

QColor AlarmBand::ink() const
{
    return m_alarms.empty() ? colour::secondary : coloursOf(m_alarms.front().priority, m_alarms.front().acknowledged).ink;
}

int AlarmBand::paintBadge(QPainter& painter) const
{
    const Alarm& top = m_alarms.front();
    const Colours colours = coloursOf(top.priority, top.acknowledged);
    const bool lit = top.acknowledged ? false : m_clock.isLit(top.priority);
    painter.setFont(theme::font(TextRole::Title, theme::scaleOf(this)));
    const QFontMetricsF metrics(painter.font());
    const double bars = metrics.height();
    const double width = metrics.horizontalAdvance(badgeWord(top.priority)) + bars + theme::px(this, 44);
    const QRectF badge(6, 5, width, height() - 10);
    QPainterPath path;
    path.addRoundedRect(badge, 4, 4);
    painter.fillPath(path, lit ? colours.badgeLit : colours.badgeDim);
    painter.setPen(lit ? colours.badgeInkLit : colours.badgeInkDim);
    const double pad = theme::px(this, 14);
    drawBars(painter, QRectF(badge.left() + pad, badge.center().y() - bars * 0.38, bars, bars * 0.76), top.priority);
    painter.drawText(badge.adjusted(pad + bars + pad / 2, 0, -pad / 2, 0), Qt::AlignLeft | Qt::AlignVCenter, badgeWord(top.priority));
    return int(badge.right()) + theme::px(this, 16);
}

void AlarmBand::paintChips(QPainter& painter, const QRectF& room) const
{
    painter.setFont(theme::font(TextRole::Strong, theme::scaleOf(this)));
    const QFontMetricsF metrics(painter.font());
    const double pad = theme::px(this, 12);
    double x = room.left();
    for (std::size_t i = 1; i < m_alarms.size(); ++i) {
        const double bars = metrics.height() * 0.8;
        const QString more = tr("+%1 more").arg(m_alarms.size() - i);
        const double reserve = i + 1 < m_alarms.size() ? metrics.horizontalAdvance(more) + pad : 0;
        const double width = metrics.horizontalAdvance(m_alarms[i].text) + bars + 3 * pad;
        if (x + width + reserve > room.right()) {
            painter.setPen(ink());
            painter.drawText(QRectF(x, room.top(), room.right() - x, room.height()), Qt::AlignLeft | Qt::AlignVCenter, more);
            return;
        }
        const Colours colours = coloursOf(m_alarms[i].priority, m_alarms[i].acknowledged);
        const QRectF chip(x, room.top() + room.height() * 0.16, width, room.height() * 0.68);
        QPainterPath path;
        path.addRoundedRect(chip, 4, 4);
        painter.fillPath(path, colours.surface);
        painter.setPen(QPen(colour::background, 2));
        painter.drawPath(path);
        painter.setPen(colours.ink);
        drawBars(painter, QRectF(chip.left() + pad, chip.center().y() - bars * 0.4, bars, bars * 0.8), m_alarms[i].priority);
        painter.drawText(chip.adjusted(pad * 1.5 + bars, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter, m_alarms[i].text);
        x += width + pad * 0.7;
    }
}

void AlarmBand::paintQuiet(QPainter& painter, double right) const
{
    painter.setFont(theme::font(TextRole::Title, theme::scaleOf(this)));
    painter.setPen(ink());
    painter.drawText(QRectF(theme::px(this, 20), 0, right, height()), Qt::AlignLeft | Qt::AlignVCenter, tr("No alarms"));
    painter.setFont(theme::font(TextRole::Caption, theme::scaleOf(this)));
    painter.drawText(QRectF(0, 0, right, height()), Qt::AlignRight | Qt::AlignVCenter,
                     tr("Alarms are shown here; this version has no alarm sound"));
}

void AlarmBand::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillRect(rect(), surface());
    double right = m_acknowledge->isVisible() ? m_acknowledge->x() : width() - 12;
    for (const QPushButton* chip : m_chips)
        right = std::min(right, double(chip->x()));
    right -= theme::px(this, 16);
    if (m_alarms.empty()) {
        paintQuiet(painter, right);
        return;
    }
    const int left = paintBadge(painter);
    painter.setFont(font());
    const QFontMetricsF metrics(font());
    const double room = right - left;
    const double most = m_alarms.size() > 1 ? room * 0.62 : room;
    const QString text = metrics.elidedText(m_alarms.front().text, Qt::ElideRight, most);
    painter.setPen(ink());
    painter.drawText(QRectF(left, 0, most, height()), Qt::AlignLeft | Qt::AlignVCenter, text);
    double end = left + metrics.horizontalAdvance(text) + theme::px(this, 24);
    if (m_alarms.size() == 1 && !m_alarms.front().remedy.isEmpty()) {
        painter.setFont(theme::font(TextRole::Body, theme::scaleOf(this)));
        const QString remedy = QFontMetricsF(painter.font()).elidedText(m_alarms.front().remedy, Qt::ElideRight, right - end);
        painter.drawText(QRectF(end, 0, right - end, height()), Qt::AlignLeft | Qt::AlignVCenter, remedy);
    }
    if (m_alarms.size() > 1)
        paintChips(painter, QRectF(end, 0, right - end, height()));
}

} // namespace console
