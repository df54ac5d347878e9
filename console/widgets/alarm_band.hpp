// Region B: the highest alarm over the whole band, the others as chips, and the sheets that were folded away.
#pragma once

#include "model/alarm_self_test.hpp"
#include "widgets/alarm_colours.hpp"
#include "widgets/theme.hpp"

#include <QElapsedTimer>
#include <QFrame>
#include <QTimer>

#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

class QHBoxLayout;
class QPushButton;

namespace console {

class FlashClock;
class SelfTestBlock;

/// Its room is fixed: alarms come and go and nothing else on the screen moves.
class AlarmBand : public QFrame {
    Q_OBJECT
public:
    explicit AlarmBand(QWidget* parent = nullptr);

    /// In the list's order: the highest first.
    void setAlarms(const std::vector<Alarm>& alarms);

    /// A chip that brings a folded sheet back; its incident is handed back in `sheetRequested`.
    void setFoldedSheets(const std::vector<std::pair<quint64, QString>>& sheets);

    /// While `signal` is shown it takes the band's place; the alarms that stand are then chips beside it.
    void setSelfTest(AlarmSelfTest::Step step, std::optional<AlarmPriority> signal, bool brief = false);

    /// What the button of the incident says for a moment: the logs have it.
    void showMarked();

    /// `demanded`: something sounds, or would but for the pause. `staysFor`: until a pause may begin; nothing when it may, or runs.
    void setSound(bool demanded, std::optional<Duration> pausedFor, std::optional<Duration> staysFor = {});

    FlashClock& flashClock() { return *m_clock; }

    /// The band's colour now, for what lies beneath the text.
    QColor surface() const;

Q_SIGNALS:
    void acknowledgeRequested(quint64 id);
    void sheetRequested(quint64 incident);
    void audioPauseRequested();
    void markRequested();
    void selfTestRequested();
    void selfTestAnswered(bool seenAndHeard);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void makeChips();
    void makeMark();
    void mark();
    std::optional<AlarmColours> colours() const;
    std::optional<AlarmPriority> testSignal() const { return m_testSignal; }
    double freeRight() const;
    static QString textOf(const Alarm& alarm);   ///< what is wrong; or that it has ended, and when
    static QString remedyOf(const Alarm& alarm); ///< of one that has ended, what is left to do
    int paintBadge(QPainter& painter, AlarmPriority priority, bool acknowledged) const;
    QFont fitting(const QString& text, double room, std::initializer_list<theme::TextRole> roles) const;
    double paintText(QPainter& painter, const QString& text, double left, double most) const;
    void paintRemedy(QPainter& painter, const QString& remedy, const QRectF& room) const;
    void paintChips(QPainter& painter, const QRectF& room, std::size_t first) const;
    void paintChip(QPainter& painter, const QRectF& chip, const Alarm& alarm) const;
    void paintEndedFrame(QPainter& painter, const QRectF& where) const;
    double textRoom(double room) const;
    double leastRemedyRoom(const QString& remedy) const;
    void paintQuiet(QPainter& painter, double right) const;
    void paintAlarms(QPainter& painter, double right) const;
    QColor ink() const;
    const Alarm* firstUnacknowledged() const;

    std::vector<Alarm> m_alarms;
    quint64 m_acknowledging = 0; ///< the alarm that the button went down for
    AlarmSelfTest::Step m_testStep = AlarmSelfTest::Step::NotDone;
    std::optional<AlarmPriority> m_testSignal;
    bool m_testBrief = false;
    FlashClock* m_clock;
    QHBoxLayout* m_row;
    SelfTestBlock* m_test;
    QPushButton* m_pause;
    QPushButton* m_acknowledge;
    QPushButton* m_mark;
    QElapsedTimer m_marking; ///< since it was asked for last
    QTimer m_markedEnds;
    std::vector<QPushButton*> m_chips;
    std::vector<std::pair<quint64, QString>> m_folded;
};

} // namespace console
