// Which log above, its filters below it, its lines, the chosen line in full, the way to its picture and the way into a file.
#include "widgets/log_view.hpp"

#include "widgets/labels.hpp"
#include "widgets/log_lines.hpp"
#include "widgets/log_review.hpp"
#include "widgets/sheet_button.hpp"
#include "widgets/touch_line.hpp"

#include <QDateTime>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QVBoxLayout>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

constexpr int mostWords = 200; // characters of a filter
constexpr std::array eventKinds{LogKind::Note, LogKind::Link, LogKind::Permit, LogKind::Alarm, LogKind::Operator, LogKind::Trouble};
constexpr std::array alarmKinds{AlarmPriority::High, AlarmPriority::Medium, AlarmPriority::Low};

} // namespace

LogView::LogView(EventLog& events, AlarmLogModel& alarms, QWidget* parent)
    : QFrame(parent),
      m_events(events),
      m_alarms(alarms),
      m_count(plainLabel({}, TextRole::Caption, this)),
      m_lines(new LogLines(this)),
      m_whole(plainLabel({}, TextRole::Body, this)),
      m_outcome(plainLabel({}, TextRole::Body, this))
{
    setAccessibleName(tr("Log view"));
    setAutoFillBackground(true);
    setFocusProxy(m_lines);
    setInk(m_count, colour::secondary);
    for (QLabel* label : {m_whole, m_outcome}) {
        label->setWordWrap(true);
        label->setMinimumHeight(QFontMetrics(label->font()).height());
    }
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(14, 10, 14, 10);
    column->setSpacing(6);
    column->addLayout(makeHead());
    column->addLayout(makeFilters());
    m_middle = new QHBoxLayout;
    m_middle->setSpacing(10);
    m_middle->addWidget(m_lines, 3);
    column->addLayout(m_middle, 1);
    column->addWidget(m_whole);
    column->addWidget(m_review = new LogReview(this));
    m_review->hide();
    column->addLayout(makeSaving());
    column->addWidget(m_outcome);
    connectLines();
    showLog(Log::Events);
}

void LogView::connectLines()
{
    const auto follow = [this] {
        refreshCount();
        markLine();
    };
    for (const auto signal : {&QAbstractItemModel::rowsInserted, &QAbstractItemModel::rowsRemoved})
        connect(&m_filter, signal, this, follow);
    connect(&m_filter, &QAbstractItemModel::modelReset, this, follow);
    connect(m_lines, &QAbstractItemView::clicked, this, &LogView::showWhole);
    connect(m_lines, &LogLines::chosen, this, &LogView::reviewLine);
    connect(m_review, &LogReview::reviewRequested, this, [this] { reviewLine(m_lines->currentIndex()); });
    connect(m_review, &LogReview::stepRequested, this, &LogView::reviewStepRequested);
    connect(m_review, &LogReview::playRequested, this, &LogView::reviewPlayRequested);
    connect(m_review, &LogReview::focusLeaving, m_lines, [this] { m_lines->setFocus(); });
}

QPushButton* LogView::addToggle(QHBoxLayout* row, const QString& text, const QString& accessibleName)
{
    auto* button = new SheetButton(text, SheetButton::Enter::Clicks, this);
    button->setAccessibleName(accessibleName);
    button->setCheckable(true);
    button->setProperty("compact", true);
    row->addWidget(button);
    return button;
}

QHBoxLayout* LogView::makeHead()
{
    auto* row = new QHBoxLayout;
    row->setSpacing(8);
    row->addWidget(plainLabel(tr("Log"), TextRole::Title, this));
    row->addSpacing(18);
    m_logs[0] = addToggle(row, tr("Events"), tr("Show the event log of this run"));
    m_logs[1] = addToggle(row, tr("Alarms"), tr("Show the alarm log, with what was kept of earlier runs"));
    row->addStretch(1);
    row->addWidget(m_count);
    auto* leave = new SheetButton(tr("To the cockpit  F1"), SheetButton::Enter::Clicks, this);
    leave->setAccessibleName(tr("Leave the log"));
    leave->setProperty("compact", true);
    row->addSpacing(18);
    row->addWidget(leave);
    connect(leave, &QPushButton::clicked, this, &LogView::leaveRequested);
    connect(m_logs[0], &QPushButton::clicked, this, [this] { showLog(Log::Events); });
    connect(m_logs[1], &QPushButton::clicked, this, [this] { showLog(Log::Alarms); });
    return row;
}

QHBoxLayout* LogView::makeFilters()
{
    auto* row = new QHBoxLayout;
    row->setSpacing(8);
    QLabel* only = plainLabel(tr("Only"), TextRole::Body, this);
    setInk(only, colour::secondary);
    row->addWidget(only);
    m_kindRow = new QHBoxLayout;
    m_kindRow->setSpacing(6);
    row->addLayout(m_kindRow);
    row->addSpacing(12);
    m_words = new TouchLine(tr("Only lines with these words"), tr("with these words"), this);
    m_words->setMaxLength(mostWords);
    m_words->setClearButtonEnabled(true);
    row->addWidget(m_words, 1);
    connect(m_words, &QLineEdit::textChanged, this, [this](const QString& words) {
        m_filter.setWords(words);
        refreshCount();
    });
    return row;
}

QHBoxLayout* LogView::makeSaving()
{
    auto* row = new QHBoxLayout;
    row->setSpacing(8);
    QLabel* into = plainLabel(tr("Into the file"), TextRole::Body, this);
    setInk(into, colour::secondary);
    row->addWidget(into);
    m_path = new TouchLine(tr("File that the lines shown are written into"), {}, this);
    row->addWidget(m_path, 1);
    m_save = new SheetButton(tr("Save lines shown"), SheetButton::Enter::Clicks, this);
    m_save->setAccessibleName(tr("Write the lines shown into the file"));
    m_save->setProperty("compact", true);
    row->addWidget(m_save);
    connect(m_save, &QPushButton::clicked, this, &LogView::save);
    connect(m_path, &QLineEdit::returnPressed, this, &LogView::save);
    return row;
}

void LogView::showLog(Log log)
{
    m_log = log;
    const bool events = log == Log::Events;
    m_logs[0]->setChecked(events);
    m_logs[1]->setChecked(!events);
    buildKinds();
    m_filter.setKinds({});
    m_filter.setSourceModel(events ? static_cast<QAbstractItemModel*>(&m_events) : &m_alarms);
    m_lines->setModel(&m_filter);
    m_lines->setAccessibleName(events ? tr("Event log, oldest first") : tr("Alarm log, oldest first"));
    connect(m_lines->selectionModel(), &QItemSelectionModel::currentChanged, this, &LogView::showWhole);
    if (m_suggest)
        m_path->setText(m_suggest(logName()));
    showWhole();
    refreshCount();
    markLine();
    m_lines->bringMarkIntoView();
}

/// A log has kinds of its own; what was chosen of the other's says nothing here.
void LogView::buildKinds()
{
    for (QPushButton* button : m_kinds)
        delete button;
    m_kinds.clear();
    const auto add = [this](const QString& kind, int number) {
        QPushButton* button = addToggle(m_kindRow, kind, tr("Only lines of the kind: %1").arg(kind));
        button->setProperty("kind", number);
        connect(button, &QPushButton::clicked, this, &LogView::chooseKinds);
        button->show();
        m_kinds.push_back(button);
    };
    if (m_log == Log::Events)
        for (const LogKind kind : eventKinds)
            add(word(kind), int(kind));
    else
        for (const AlarmPriority priority : alarmKinds)
            add(word(priority), int(priority));
    QWidget* before = m_logs[1];
    for (QPushButton* button : m_kinds) {
        setTabOrder(before, button);
        before = button;
    }
    setTabOrder(before, m_words);
}

void LogView::chooseKinds()
{
    QSet<int> kinds;
    for (const QPushButton* button : m_kinds)
        if (button->isChecked())
            kinds.insert(button->property("kind").toInt());
    m_filter.setKinds(kinds);
    refreshCount();
}

void LogView::refreshCount()
{
    const int all = m_filter.sourceModel()->rowCount();
    QString text = m_filter.rowCount() == all ? tr("%1 lines").arg(all) : tr("%1 of %2 lines").arg(m_filter.rowCount()).arg(all);
    if (m_log == Log::Events && m_events.lost() > 0)
        text += tr("; %1 older ones are gone").arg(m_events.lost());
    m_count->setText(text);
}

void LogView::showWhole()
{
    const auto line = m_lines->currentIndex();
    m_whole->setText(line.isValid() ? line.data().toString() : tr("Choose a line to read it whole."));
    setInk(m_whole, line.isValid() ? colour::text : colour::secondary);
    refreshReview();
}

void LogView::setReview(std::function<MomentPicture(Instant)> keeps, std::function<Duration()> kept, QWidget* picture)
{
    m_keeps = std::move(keeps);
    m_kept = std::move(kept);
    m_picture = picture;
    m_middle->insertWidget(0, m_picture, 2);
    m_picture->setVisible(m_reviewed.has_value());
    m_review->show();
    refreshReview();
}

void LogView::refreshReview()
{
    if (!m_keeps || !isVisible())
        return;
    const auto line = m_lines->currentIndex();
    if (!line.isValid())
        return m_review->showLine(std::nullopt, m_kept());
    const auto moment = momentOf(line);
    m_review->showLine(moment ? m_keeps(*moment) : MomentPicture::Gone, m_kept());
}

void LogView::reviewLine(const QModelIndex& line)
{
    refreshReview();
    const auto moment = momentOf(line);
    if (m_keeps && moment && m_keeps(*moment) == MomentPicture::Kept)
        Q_EMIT reviewRequested(*moment);
}

void LogView::showReview(std::optional<Instant> moment, bool playing)
{
    const bool moved = moment != m_reviewed;
    m_reviewed = moment;
    if (m_picture != nullptr)
        m_picture->setVisible(moment.has_value());
    m_review->showReview(moment.has_value(), playing);
    markLine();
    if (moved)
        m_lines->bringMarkIntoView();
}

void LogView::markLine() { m_lines->mark(m_reviewed ? newestLineUntil(m_filter, *m_reviewed) : QModelIndex()); }

QString LogView::logName() const { return m_log == Log::Events ? QStringLiteral("events") : QStringLiteral("alarms"); }

void LogView::setPathSuggestion(std::function<QString(const QString&)> suggest)
{
    m_suggest = std::move(suggest);
    m_path->setText(m_suggest(logName()));
}

void LogView::save()
{
    m_outcome->setText(tr("Writing\u2026"));
    setInk(m_outcome, colour::secondary);
    const QString name = m_log == Log::Events ? tr("event log of this run") : tr("alarm log");
    Q_EMIT saveRequested(logText(m_filter, name, QDateTime::currentMSecsSinceEpoch()), m_path->text().trimmed());
}

void LogView::showSaved(const QString& path)
{
    m_outcome->setText(tr("Saved: %1").arg(path));
    setInk(m_outcome, colour::text);
    if (m_suggest)
        m_path->setText(m_suggest(logName()));
}

void LogView::showFailure(const QString& reason)
{
    m_outcome->setText(reason);
    setInk(m_outcome, colour::bright);
}

void LogView::showEvent(QShowEvent* event)
{
    QFrame::showEvent(event);
    refreshCount();
    refreshReview();
}

} // namespace console
