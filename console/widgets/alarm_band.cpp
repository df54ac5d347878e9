// The band's colour says the priority from afar; its badge flashes, its text never does.
#include "widgets/alarm_band.hpp"

#include "widgets/alarm_colours.hpp"
#include "widgets/flash_clock.hpp"
#include "widgets/focus_return.hpp"
#include "widgets/self_test_block.hpp"
#include "widgets/theme.hpp"
#include "widgets/touch_button.hpp"

#include <QHBoxLayout>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

QString badgeWord(AlarmPriority priority) { return word(priority).toUpper(); }

void makeCompact(QPushButton* button)
{
    theme::setTextRole(button, TextRole::Strong);
    button->setAutoDefault(false);
    button->setFocusPolicy(Qt::TabFocus); // a click leaves the keys with the hand
    button->setProperty("compact", true);
    button->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
}

QString testText(AlarmPriority priority, bool brief)
{
    switch (priority) {
    case AlarmPriority::High:
        return brief ? AlarmBand::tr("SELF-TEST, no alarm: red, flashing fast, five pulses")
                     : AlarmBand::tr("SELF-TEST, no alarm: red, flashing fast, ten pulses");
    case AlarmPriority::Medium:
        return AlarmBand::tr("SELF-TEST, no alarm: yellow, flashing slowly, three pulses");
    case AlarmPriority::Low:
        break;
    }
    return AlarmBand::tr("SELF-TEST, no alarm: cyan, steady, two pulses");
}

} // namespace

AlarmBand::AlarmBand(QWidget* parent)
    : QFrame(parent),
      m_clock(new FlashClock(this)),
      m_row(new QHBoxLayout(this)),
      m_test(new SelfTestBlock(this)),
      m_pause(new TouchButton(this)),
      m_acknowledge(new TouchButton(tr("Acknowledge"), this))
{
    setAccessibleName(tr("Alarms"));
    theme::setTextRole(this, TextRole::Alarm);
    for (QPushButton* button : {m_pause, m_acknowledge})
        makeCompact(button);
    m_acknowledge->setAccessibleName(tr("Acknowledge the alarm shown"));
    for (QPushButton* button : {m_pause, m_acknowledge}) {
        QSizePolicy kept = button->sizePolicy();
        kept.setRetainSizeWhenHidden(true);
        button->setSizePolicy(kept);
        button->hide();
    }
    m_pause->setAccessibleName(tr("Pause the alarm sound for a while, or end the pause"));
    m_row->setContentsMargins(6, 1, 8, 1); // what a finger must hit takes nearly all of the band
    m_row->setSpacing(8);
    m_row->addStretch(1);
    m_row->addWidget(m_test);
    m_row->addWidget(m_pause);
    m_row->addWidget(m_acknowledge);
    connect(m_pause, &QPushButton::clicked, this, &AlarmBand::audioPauseRequested);
    connect(m_test, &SelfTestBlock::beginRequested, this, &AlarmBand::selfTestRequested);
    connect(m_test, &SelfTestBlock::answered, this, &AlarmBand::selfTestAnswered);
    // What was shown when the button went down: an alarm that comes meanwhile was not seen.
    connect(m_acknowledge, &QPushButton::pressed, this, [this] {
        const Alarm* alarm = firstUnacknowledged();
        m_acknowledging = alarm != nullptr ? alarm->id : 0;
    });
    connect(m_acknowledge, &QPushButton::clicked, this, [this] {
        if (const Alarm* alarm = firstUnacknowledged(); alarm != nullptr && alarm->id == m_acknowledging)
            Q_EMIT acknowledgeRequested(alarm->id);
    });
    connect(m_clock, &FlashClock::ticked, this, [this] {
        if (!m_alarms.empty() || testSignal())
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
    m_test->setSoundWorks(std::none_of(alarms.begin(), alarms.end(),
                                       [](const Alarm& alarm) { return alarm.condition == AlarmCondition::SoundFailed && alarm.present; }));
    const Alarm* next = firstUnacknowledged(); // of the highest priority
    m_test->setMayBegin(next == nullptr || next->priority != AlarmPriority::High);
    if (!next)
        returnFocus(m_acknowledge);
    m_acknowledge->setVisible(next != nullptr);
    if (next) {
        constexpr qsizetype mostCharacters = 24;
        const bool shown = next == &m_alarms.front();
        const bool whole = next->text.size() <= mostCharacters;
        const QString text = whole ? next->text : next->text.left(mostCharacters - 1) + QChar(0x2026);
        m_acknowledge->setText(shown ? tr("Acknowledge") : tr("Acknowledge: %1").arg(text));
        m_acknowledge->setToolTip(next->text.toHtmlEscaped());
        m_acknowledge->setAccessibleDescription(next->text);
    }
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
    const bool same = std::ranges::equal(sheets, m_folded, {}, &std::pair<quint64, QString>::first, &std::pair<quint64, QString>::first);
    m_folded = sheets;
    if (!same)
        makeChips();
    for (std::size_t i = 0; i < sheets.size(); ++i) { // their time runs: they stay, so that a finger or the keys stay on them
        m_chips[i]->setText(sheets[i].second);
        m_chips[i]->setAccessibleName(tr("Show again: %1").arg(sheets[i].second));
    }
}

void AlarmBand::makeChips()
{
    for (QPushButton* chip : m_chips) {
        returnFocus(chip);
        delete chip;
    }
    m_chips.clear();
    for (const auto& [key, text] : m_folded) {
        auto* chip = new TouchButton(text, this);
        makeCompact(chip);
        connect(chip, &QPushButton::clicked, this, [this, key = key] { Q_EMIT sheetRequested(key); });
        m_row->insertWidget(1, chip);
        chip->show();
        m_chips.push_back(chip);
    }
}

void AlarmBand::setSelfTest(AlarmSelfTest::Step step, std::optional<AlarmPriority> signal, bool brief)
{
    m_testBrief = brief;
    m_testStep = step;
    m_testSignal = signal;
    m_test->setStep(step);
    update();
}

void AlarmBand::setSound(bool demanded, std::optional<Duration> pausedFor)
{
    const auto left = pausedFor ? std::chrono::ceil<std::chrono::seconds>(*pausedFor).count() : 0;
    const QString text = pausedFor ? tr("AUDIO PAUSED %1 s").arg(left) : tr("Pause sound (F9)");
    if (m_pause->text() != text)
        m_pause->setText(text);
    const int room = m_pause->fontMetrics().horizontalAdvance(tr("AUDIO PAUSED %1 s").arg(60)) + theme::px(this, 44);
    if (m_pause->minimumWidth() != room)
        m_pause->setFixedWidth(room);
    const bool shown = demanded || pausedFor;
    if (!shown)
        returnFocus(m_pause);
    m_pause->setVisible(shown);
}

std::optional<AlarmColours> AlarmBand::colours() const
{
    if (const auto test = testSignal())
        return alarmColours(*test, false);
    if (m_alarms.empty())
        return std::nullopt;
    return alarmColours(m_alarms.front().priority, m_alarms.front().acknowledged);
}

QColor AlarmBand::surface() const
{
    const auto shown = colours();
    return shown ? shown->surface : colour::panel;
}

QColor AlarmBand::ink() const
{
    const auto shown = colours();
    return shown ? shown->ink : colour::secondary;
}

int AlarmBand::paintBadge(QPainter& painter, AlarmPriority priority, bool acknowledged) const
{
    const AlarmColours colours = alarmColours(priority, acknowledged);
    const bool lit = !acknowledged && m_clock->isLit(priority);
    painter.setFont(theme::font(TextRole::Title, theme::scaleOf(this)));
    const QFontMetricsF metrics(painter.font());
    const double bars = metrics.height();
    const double width = metrics.horizontalAdvance(badgeWord(priority)) + bars + theme::px(this, 44);
    const QRectF badge(6, 5, width, height() - 10);
    QPainterPath path;
    path.addRoundedRect(badge, 4, 4);
    painter.fillPath(path, lit ? colours.badgeLit : colours.badgeDim);
    painter.setPen(lit ? colours.badgeInkLit : colours.badgeInkDim);
    const double pad = theme::px(this, 14);
    drawPriorityBars(painter, QRectF(badge.left() + pad, badge.center().y() - bars * 0.38, bars, bars * 0.76), priority);
    painter.drawText(badge.adjusted(pad + bars + pad / 2, 0, -pad / 2, 0), Qt::AlignLeft | Qt::AlignVCenter, badgeWord(priority));
    return int(badge.right()) + theme::px(this, 16);
}

void AlarmBand::paintChips(QPainter& painter, const QRectF& room, std::size_t first) const
{
    painter.setFont(theme::font(TextRole::Strong, theme::scaleOf(this)));
    const QFontMetricsF metrics(painter.font());
    const double pad = theme::px(this, 12);
    double x = room.left();
    for (std::size_t i = first; i < m_alarms.size(); ++i) {
        const QString more = tr("+%1 more").arg(m_alarms.size() - i);
        const double reserve = i + 1 < m_alarms.size() ? metrics.horizontalAdvance(more) + pad : 0;
        const double width = metrics.horizontalAdvance(m_alarms[i].text) + metrics.height() * 0.8 + 3 * pad;
        if (x + width + reserve > room.right()) {
            painter.setPen(ink());
            painter.drawText(QRectF(x, room.top(), room.right() - x, room.height()), Qt::AlignLeft | Qt::AlignVCenter, more);
            return;
        }
        paintChip(painter, QRectF(x, room.top() + room.height() * 0.16, width, room.height() * 0.68), m_alarms[i]);
        x += width + pad * 0.7;
    }
}

/// One that nobody acknowledged flashes, whatever stands before it in the band.
void AlarmBand::paintChip(QPainter& painter, const QRectF& chip, const Alarm& alarm) const
{
    const AlarmColours colours = alarmColours(alarm.priority, alarm.acknowledged);
    const bool lit = alarm.acknowledged || m_clock->isLit(alarm.priority);
    const double pad = theme::px(this, 12);
    const double bars = QFontMetricsF(painter.font()).height() * 0.8;
    QPainterPath path;
    path.addRoundedRect(chip, 4, 4);
    painter.fillPath(path, lit ? colours.surface : colours.badgeDim);
    painter.setPen(QPen(colour::background, 2));
    painter.drawPath(path);
    painter.setPen(lit ? colours.ink : colours.badgeInkDim);
    drawPriorityBars(painter, QRectF(chip.left() + pad, chip.center().y() - bars * 0.4, bars, bars * 0.8), alarm.priority);
    painter.drawText(chip.adjusted(pad * 1.5 + bars, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter, alarm.text);
}

/// What is left of the band for the highest alarm's text: the others' chips give way to it, down to how many they are.
double AlarmBand::textRoom(double room) const
{
    if (m_alarms.size() < 2)
        return room;
    const QFontMetricsF metrics(theme::font(TextRole::Strong, theme::scaleOf(this)));
    return room - metrics.horizontalAdvance(tr("+%1 more").arg(m_alarms.size() - 1)) - theme::px(this, 24 + 12);
}

void AlarmBand::paintQuiet(QPainter& painter, double right) const
{
    using Step = AlarmSelfTest::Step;
    painter.setPen(ink());
    QString text = tr("No alarms");
    if (m_testStep == Step::Asking)
        text = tr("Were all three colours seen, and all three sounds heard?");
    else if (m_testStep == Step::Failed)
        text = tr("No alarms. The alarm self-test was not confirmed: have screen and sound looked at");
    else if (m_testStep == Step::NotDone)
        text = tr("No alarms. The alarm self-test is to be done before arming");
    const double left = theme::px(this, 20);
    painter.setFont(fitting(text, right - left, {TextRole::Title, TextRole::Strong, TextRole::Body, TextRole::Caption}));
    const QString shown = QFontMetricsF(painter.font()).elidedText(text, Qt::ElideRight, right - left);
    painter.drawText(QRectF(left, 0, right - left, height()), Qt::AlignLeft | Qt::AlignVCenter, shown);
}

/// The first of `roles` in which `text` is whole: smaller letters are better than none.
QFont AlarmBand::fitting(const QString& text, double room, std::initializer_list<TextRole> roles) const
{
    QFont face = font();
    for (const TextRole role : roles) {
        face = theme::font(role, theme::scaleOf(this));
        if (QFontMetricsF(face).horizontalAdvance(text) <= room)
            break;
    }
    return face;
}

/// The text of the test or of the highest alarm; returns where it ends.
double AlarmBand::paintText(QPainter& painter, const QString& text, double left, double most) const
{
    painter.setFont(fitting(text, most, {TextRole::Alarm, TextRole::Title, TextRole::Strong}));
    const QFontMetricsF metrics(painter.font());
    const QString shown = metrics.elidedText(text, Qt::ElideRight, most);
    painter.setPen(ink());
    painter.drawText(QRectF(left, 0, most, height()), Qt::AlignLeft | Qt::AlignVCenter, shown);
    return left + metrics.horizontalAdvance(shown) + theme::px(this, 24);
}

void AlarmBand::paintAlarms(QPainter& painter, double right) const
{
    const Alarm& top = m_alarms.front();
    const int left = paintBadge(painter, top.priority, top.acknowledged);
    const double room = right - left;
    const double end = paintText(painter, top.text, left, textRoom(room));
    if (m_alarms.size() > 1)
        return paintChips(painter, QRectF(end, 0, right - end, height()), 1);
    paintRemedy(painter, top.remedy, QRectF(end, 0, right - end, height()));
}

/// One line, or two of smaller letters.
void AlarmBand::paintRemedy(QPainter& painter, const QString& remedy, const QRectF& room) const
{
    painter.setFont(fitting(remedy, room.width(), {TextRole::Body, TextRole::Caption}));
    painter.drawText(room, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextWordWrap, remedy);
}

double AlarmBand::freeRight() const
{
    double right = m_acknowledge->isVisible() ? m_acknowledge->x() : width() - 12;
    for (const QWidget* other : {static_cast<const QWidget*>(m_test), static_cast<const QWidget*>(m_pause)})
        if (other->isVisible())
            right = std::min(right, double(other->x()));
    for (const QPushButton* chip : m_chips)
        right = std::min(right, double(chip->x()));
    return right - theme::px(this, 16);
}

void AlarmBand::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillRect(rect(), surface());
    const double right = freeRight();
    if (const auto test = testSignal()) {
        const int left = paintBadge(painter, *test, false);
        const double end = paintText(painter, testText(*test, m_testBrief), left, right - left);
        paintChips(painter, QRectF(end, 0, right - end, height()), 0);
    } else if (m_alarms.empty()) {
        paintQuiet(painter, right);
    } else {
        paintAlarms(painter, right);
    }
}

} // namespace console
