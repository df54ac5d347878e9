// F4: the event log and the alarm log, filtered by kind and by words, written into a file, and beside the pictures of their moments.
#pragma once

#include "model/alarm_log_model.hpp"
#include "model/event_log.hpp"
#include "model/log_filter.hpp"
#include "model/log_moments.hpp"

#include <QFrame>

#include <array>
#include <functional>
#include <optional>
#include <vector>

class QHBoxLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace console {

class LogLines;
class LogReview;
class SheetButton;

/// Nothing in it opens a window of its own: a list that drops down would have the keyboard for itself. Both logs must outlive it.
class LogView : public QFrame {
    Q_OBJECT
public:
    enum class Log { Events, Alarms };

    LogView(EventLog& events, AlarmLogModel& alarms, QWidget* parent = nullptr);

    void showLog(Log log);
    Log log() const { return m_log; }

    /// Names a file for a log, `events` or `alarms`, that is written now.
    void setPathSuggestion(std::function<QString(const QString& log)> suggest);

    /// Lets a person go from a line to its picture; without it there is no button for that. `keeps` says what is kept of a moment,
    /// `kept` of how long a time; `picture` is the view's from now on, stands beside the lines while there is a review, and is to show
    /// that.
    void setReview(std::function<MomentPicture(Instant)> keeps, std::function<Duration()> kept, QWidget* picture);

    /// Until when the picture in review was the newest, for the mark before the last line until then; nothing: there is no review, and no
    /// mark.
    void showReview(std::optional<Instant> moment, bool playing);

    /// Other pictures are kept than before.
    void refreshReview();

    /// How the writing ended, for a person; it stays until the next one.
    void showSaved(const QString& path);
    void showFailure(const QString& reason);

    const LogFilter& filter() const { return m_filter; }

Q_SIGNALS:
    void saveRequested(const QByteArray& text, const QString& path);
    void reviewRequested(console::Instant moment);
    void reviewStepRequested(int frames);
    void reviewPlayRequested(bool play);
    void leaveRequested();

protected:
    void showEvent(QShowEvent* event) override;

private:
    QPushButton* addToggle(QHBoxLayout* row, const QString& text, const QString& accessibleName);
    QHBoxLayout* makeHead();
    QHBoxLayout* makeFilters();
    QHBoxLayout* makeSaving();
    void connectLines();
    void buildKinds();
    void chooseKinds();
    void refreshCount();
    void showWhole();
    void reviewLine(const QModelIndex& line);
    void markLine();
    void save();
    QString logName() const;

    EventLog& m_events;
    AlarmLogModel& m_alarms;
    LogFilter m_filter;
    Log m_log = Log::Events;
    std::function<QString(const QString&)> m_suggest;
    std::function<MomentPicture(Instant)> m_keeps;
    std::function<Duration()> m_kept;
    std::optional<Instant> m_reviewed;
    std::array<QPushButton*, 2> m_logs{};
    std::vector<QPushButton*> m_kinds;
    QHBoxLayout* m_kindRow = nullptr;
    QLineEdit* m_words = nullptr;
    QLabel* m_count;
    LogLines* m_lines;
    QHBoxLayout* m_middle = nullptr; ///< the lines, and the picture beside them
    QWidget* m_picture = nullptr;
    LogReview* m_review = nullptr;
    QLabel* m_whole;
    QLineEdit* m_path = nullptr;
    SheetButton* m_save = nullptr;
    QLabel* m_outcome;
};

} // namespace console
