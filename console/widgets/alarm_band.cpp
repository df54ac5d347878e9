// What the alarm band offers to press, and what it is told to show.
#include "widgets/alarm_band.hpp"

#include "widgets/double_click.hpp"
#include "widgets/flash_clock.hpp"
#include "widgets/focus_return.hpp"
#include "widgets/self_test_block.hpp"
#include "widgets/theme.hpp"
#include "widgets/touch_button.hpp"

#include <QDateTime>
#include <QHBoxLayout>

#include <algorithm>

namespace console {

using theme::TextRole;

namespace {

constexpr std::chrono::seconds markedShown{2};

void makeCompact(QPushButton* button)
{
    theme::setTextRole(button, TextRole::Strong);
    button->setAutoDefault(false);
    button->setFocusPolicy(Qt::TabFocus); // a click leaves the keys with the hand
    button->setProperty("compact", true);
    button->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
}

/// So wide that each of `texts` fits, and what stands beside it stands still.
void keepRoom(QPushButton* button, std::initializer_list<QString> texts)
{
    int widest = 0;
    for (const QString& text : texts)
        widest = std::max(widest, button->fontMetrics().horizontalAdvance(text));
    const int room = widest + theme::px(button, 44);
    if (button->minimumWidth() != room)
        button->setFixedWidth(room);
}

} // namespace

AlarmBand::AlarmBand(QWidget* parent)
    : QFrame(parent),
      m_clock(new FlashClock(this)),
      m_row(new QHBoxLayout(this)),
      m_test(new SelfTestBlock(this)),
      m_pause(new TouchButton(this)),
      m_acknowledge(new TouchButton(tr("Acknowledge"), this)),
      m_mark(new TouchButton(tr("Incident"), this))
{
    setAccessibleName(tr("Alarms"));
    theme::setTextRole(this, TextRole::Alarm);
    for (QPushButton* button : {m_pause, m_acknowledge, m_mark})
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
    m_row->addWidget(m_mark);
    makeMark();
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

void AlarmBand::makeMark()
{
    m_mark->setAccessibleName(tr("Mark this moment in both logs as an incident"));
    m_mark->setToolTip(tr("Marks this moment in both logs, with permit, picture and force"));
    m_markedEnds.setSingleShot(true);
    m_markedEnds.setInterval(markedShown);
    connect(m_mark, &QPushButton::clicked, this, &AlarmBand::mark);
    connect(&m_markedEnds, &QTimer::timeout, this, [this] { m_mark->setText(tr("Incident")); });
}

void AlarmBand::mark()
{
    if (!isDoubleClick(m_marking))
        Q_EMIT markRequested();
}

void AlarmBand::showMarked()
{
    m_mark->setText(tr("Marked"));
    m_markedEnds.start();
}

const Alarm* AlarmBand::firstUnacknowledged() const
{
    const auto found = std::find_if(m_alarms.begin(), m_alarms.end(), [](const Alarm& alarm) { return !alarm.acknowledged; });
    return found == m_alarms.end() ? nullptr : &*found;
}

/// The words come first: where room lacks, it is the rest that is cut.
QString AlarmBand::textOf(const Alarm& alarm)
{
    if (alarm.present)
        return alarm.text;
    const auto ended = QDateTime::fromMSecsSinceEpoch(alarm.endedWallMs);
    const bool today = ended.date() == QDate::currentDate();
    return tr("ENDED %1 \u00B7 %2")
        .arg(ended.toString(today ? QStringLiteral("HH:mm:ss") : QStringLiteral("yyyy-MM-dd HH:mm:ss")), alarm.text);
}

QString AlarmBand::remedyOf(const Alarm& alarm) { return alarm.present ? alarm.remedy : tr("It has ended; acknowledge that you saw it."); }

void AlarmBand::setAlarms(const std::vector<Alarm>& alarms)
{
    m_alarms = alarms;
    m_test->setSoundWorks(std::none_of(alarms.begin(), alarms.end(),
                                       [](const Alarm& alarm) { return alarm.condition == AlarmCondition::SoundFailed && alarm.present; }));
    const Alarm* const first = firstUnacknowledged(); // of the highest priority
    const bool shown = first != nullptr && first == &m_alarms.front();
    const auto next = first != nullptr ? std::optional(*first) : std::nullopt; // its own: what follows moves the focus, and may come back
    m_test->setMayBegin(!next || next->priority != AlarmPriority::High);
    if (!next)
        returnFocus(m_acknowledge);
    m_acknowledge->setVisible(next.has_value());
    if (next) {
        constexpr qsizetype mostCharacters = 24;
        const bool whole = next->text.size() <= mostCharacters;
        const QString text = whole ? next->text : next->text.left(mostCharacters - 1) + QChar(0x2026);
        m_acknowledge->setText(shown           ? tr("Acknowledge")
                               : next->present ? tr("Acknowledge: %1").arg(text)
                                               : tr("Acknowledge ended: %1").arg(text));
        m_acknowledge->setToolTip(textOf(*next).toHtmlEscaped());
        m_acknowledge->setAccessibleDescription(textOf(*next));
    }
    QStringList lines;
    for (const Alarm& alarm : m_alarms)
        lines << word(alarm.priority) + QStringLiteral(": ") + textOf(alarm) + QStringLiteral(" ") + remedyOf(alarm);
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
    for (std::size_t i = 0; i < m_chips.size(); ++i) { // their time runs: they stay, so that a finger or the keys stay on them
        const QString& text = m_folded[i].second;
        m_chips[i]->setText(text);
        m_chips[i]->setAccessibleName(tr("Show again: %1").arg(text));
    }
}

/// What goes may be the one that was pressed, and who hears that the focus has moved may set other ones.
void AlarmBand::makeChips()
{
    while (!m_chips.empty())
        for (QPushButton* chip : std::exchange(m_chips, {})) {
            chip->deleteLater();
            returnFocus(chip);
            chip->hide();
        }
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

void AlarmBand::setSound(bool demanded, std::optional<Duration> pausedFor, std::optional<Duration> staysFor)
{
    const auto full = [](Duration left) { return std::chrono::ceil<std::chrono::seconds>(left).count(); };
    const QString text = pausedFor  ? tr("AUDIO PAUSED %1 s").arg(full(*pausedFor))
                         : staysFor ? tr("Sound stays on %1 s").arg(full(*staysFor))
                                    : tr("Pause sound (F9)");
    if (m_pause->text() != text)
        m_pause->setText(text);
    keepRoom(m_pause, {tr("AUDIO PAUSED %1 s").arg(60), tr("Sound stays on %1 s").arg(10)});
    keepRoom(m_mark, {tr("Incident"), tr("Marked")});
    const bool shown = demanded || pausedFor;
    if (!shown)
        returnFocus(m_pause);
    m_pause->setVisible(shown);
}

} // namespace console
