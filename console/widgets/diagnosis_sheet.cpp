// The sheet's order is the order in which a surgeon asks.
#include "widgets/diagnosis_sheet.hpp"

#include "widgets/action_rows.hpp"
#include "widgets/double_click.hpp"
#include "widgets/figures.hpp"
#include "widgets/labels.hpp"
#include "widgets/roll_call.hpp"
#include "widgets/sheet_button.hpp"
#include "widgets/touch_scrolling.hpp"

#include <QHBoxLayout>
#include <QScrollArea>
#include <QTimer>
#include <QVBoxLayout>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

DiagnosisSheet::DiagnosisSheet(QWidget* parent) : QFrame(parent)
{
    setObjectName(QStringLiteral("diagnosisSheet"));
    setAccessibleName(tr("Diagnosis of a lost link"));
    setAttribute(Qt::WA_StyledBackground);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(16, 10, 16, 10);
    column->setSpacing(6);
    column->addWidget(makeHead());
    column->addWidget(makeBody(), 1);
    m_actions = makeActions();
    m_giveUpRow = makeGiveUp();
    m_giveUpRow->hide();
    column->addWidget(m_actions);
    column->addWidget(m_giveUpRow);
    connectActions();
}

QWidget* DiagnosisSheet::makeHead()
{
    auto* head = new QWidget(this);
    auto* rows = new QVBoxLayout(head);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(6);
    auto* first = new QHBoxLayout;
    m_headline = plainLabel({}, TextRole::Alarm, head);
    setInk(m_headline, colour::bright);
    m_since = new FigureLabel(head);
    theme::setTextRole(m_since, TextRole::Strong);
    m_flaps = plainLabel({}, TextRole::Strong, head);
    m_fold = new SheetButton(tr("Fold"), SheetButton::Enter::Clicks, head);
    m_fold->setAccessibleName(tr("Fold this sheet to a chip in the alarm band"));
    m_fold->setProperty("compact", true);
    first->addWidget(m_headline);
    first->addSpacing(12);
    first->addWidget(m_since);
    first->addSpacing(12);
    first->addWidget(m_flaps, 1);
    first->addWidget(m_fold);
    m_directions = plainLabel({}, TextRole::Body, head);
    m_directions->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_directions->setWordWrap(true);
    m_silence = new SheetButton({}, SheetButton::Enter::Ignored, head);
    m_silence->setAccessibleName(tr("Pause the alarm sound: F9"));
    m_save = new SheetButton(tr("Save report"), SheetButton::Enter::Ignored, head);
    m_save->setAccessibleName(tr("Save what this sheet says as a file"));
    m_showDetails = new SheetButton(tr("Details"), SheetButton::Enter::Clicks, head);
    m_showDetails->setAccessibleName(tr("Show the details, for whoever has to find the cause"));
    m_showDetails->setCheckable(true);
    auto* second = new QHBoxLayout;
    second->setSpacing(8);
    second->addWidget(m_directions, 1);
    for (SheetButton* button : {m_silence, m_showDetails, m_save}) {
        button->setProperty("compact", true);
        second->addWidget(button);
    }
    m_note = plainLabel({}, TextRole::Caption, head);
    m_note->setWordWrap(true);
    m_note->hide();
    rows->addLayout(first);
    rows->addLayout(second);
    rows->addWidget(m_note);
    return head;
}

QLabel* DiagnosisSheet::addSection(QVBoxLayout* column, const QString& heading)
{
    if (column->count() > 0)
        column->addSpacing(8);
    column->addWidget(headingLabel(heading, this));
    QLabel* text = plainLabel({}, TextRole::Body, this);
    text->setWordWrap(true);
    column->addWidget(text);
    return text;
}

QWidget* DiagnosisSheet::makeBody()
{
    m_body = new QScrollArea(this);
    m_body->setAccessibleName(tr("Particulars"));
    m_body->setWidgetResizable(true);
    m_body->setFrameShape(QFrame::NoFrame);
    m_body->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scrollByTouch(*m_body);
    auto* body = new QWidget(m_body);
    auto* row = new QHBoxLayout(body);
    row->setContentsMargins(0, 0, 6, 0);
    row->setSpacing(28);
    row->addLayout(makePatientSide(body), 1);
    row->addLayout(makeFindings(body), 1);
    m_body->setWidget(body);
    return m_body;
}

QVBoxLayout* DiagnosisSheet::makePatientSide(QWidget* body)
{
    auto* column = new QVBoxLayout;
    column->setSpacing(3);
    m_patient = addSection(column, tr("Is the patient safe?"));
    theme::setTextRole(m_patient, TextRole::Title);
    m_call = plainLabel({}, TextRole::Strong, body);
    m_call->setWordWrap(true);
    column->addWidget(m_call);
    m_rollCall = new RollCall(body);
    column->addWidget(m_rollCall);
    m_seen = addSection(column, tr("What you see"));
    column->addStretch(1);
    return column;
}

QVBoxLayout* DiagnosisSheet::makeFindings(QWidget* body)
{
    auto* column = new QVBoxLayout;
    column->setSpacing(3);
    m_cause = addSection(column, tr("Likely cause, and what to try"));
    m_lastTry = plainLabel({}, TextRole::Strong, body);
    m_lastTry->setWordWrap(true);
    column->addWidget(m_lastTry);
    m_evidence = addSection(column, tr("Evidence"));
    column->addWidget(makeDetails(body));
    column->addStretch(1);
    return column;
}

QWidget* DiagnosisSheet::makeDetails(QWidget* body)
{
    m_detailsPart = new QWidget(body);
    auto* column = new QVBoxLayout(m_detailsPart);
    column->setContentsMargins(0, 8, 0, 0);
    column->setSpacing(3);
    m_details = addSection(column, tr("Details"));
    m_detailsPart->hide();
    return m_detailsPart;
}

QWidget* DiagnosisSheet::makeActions()
{
    auto* actions = new ActionRows(this);
    m_reopen = new SheetButton(tr("Re-open channel"), SheetButton::Enter::Ignored, actions);
    m_reopen->setProperty("emphasis", true);
    m_reopenAll = new SheetButton(tr("Re-open all lost"), SheetButton::Enter::Ignored, actions);
    m_checks = new SheetButton(tr("Run checks"), SheetButton::Enter::Clicks, actions);
    m_showCall = new SheetButton(tr("Call patient side"), SheetButton::Enter::Clicks, actions);
    m_showCall->setAccessibleName(tr("Show large how to call the patient side"));
    m_showCall->setCheckable(true);
    m_giveUp = new SheetButton(tr("Give up link\u2026"), SheetButton::Enter::Ignored, actions);
    m_giveUp->setAccessibleName(tr("Give up this link, because the device will not return"));
    for (SheetButton* button : {m_reopen, m_reopenAll, m_checks})
        actions->first()->addWidget(button);
    actions->second()->addWidget(m_showCall);
    actions->second()->addStretch(1);
    actions->second()->addWidget(m_giveUp);
    return actions;
}

QWidget* DiagnosisSheet::makeGiveUp()
{
    auto* rowWidget = new QWidget(this);
    auto* row = new QHBoxLayout(rowWidget);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(12);
    QLabel* question = plainLabel(tr("The incident ends and the link stays closed. Give it up?"), TextRole::Strong, rowWidget);
    m_keep = new SheetButton(tr("Keep"), SheetButton::Enter::Clicks, rowWidget);
    m_reallyGiveUp = new SheetButton(tr("Give up link"), SheetButton::Enter::Ignored, rowWidget);
    row->addWidget(question, 1);
    row->addWidget(m_reallyGiveUp);
    row->addWidget(m_keep);
    return rowWidget;
}

void DiagnosisSheet::connectActions()
{
    connect(m_fold, &QPushButton::clicked, this, [this] { Q_EMIT foldRequested(m_incident); });
    connect(m_silence, &QPushButton::clicked, this, &DiagnosisSheet::silenceRequested);
    connect(m_save, &QPushButton::clicked, this, [this] {
        if (!isDoubleClick(m_saved))
            Q_EMIT reportRequested(m_report);
    });
    connect(m_reopen, &QPushButton::clicked, this, [this] { Q_EMIT reopenRequested(m_peer); });
    connect(m_reopenAll, &QPushButton::clicked, this, &DiagnosisSheet::reopenAllRequested);
    connect(m_checks, &QPushButton::clicked, this, [this] { Q_EMIT probeRequested(m_peer); });
    connectShown();
    const auto ask = [this](bool asking) {
        m_giveUpRow->setVisible(asking);
        m_actions->setVisible(!asking);
        (asking ? m_keep : m_checks)->setFocus();
    };
    connect(m_giveUp, &QPushButton::clicked, this, [ask] { ask(true); });
    connect(m_keep, &QPushButton::clicked, this, [ask] { ask(false); });
    connect(m_reallyGiveUp, &QPushButton::clicked, this, [this, ask] {
        ask(false);
        Q_EMIT dismissRequested(m_incident);
    });
}

void DiagnosisSheet::connectShown()
{
    const auto bringIntoView = [this](QWidget* shown) {
        QTimer::singleShot(0, this, [this, shown] { m_body->ensureWidgetVisible(shown, 0, 0); }); // laid out by then
    };
    connect(m_showDetails, &QPushButton::toggled, this, [this, bringIntoView](bool shown) {
        m_detailsPart->setVisible(shown);
        if (shown)
            bringIntoView(m_detailsPart);
    });
    connect(m_showCall, &QPushButton::toggled, this, &DiagnosisSheet::showCall);
    connect(m_showCall, &QPushButton::clicked, this, [this, bringIntoView] {
        m_showCall->setChecked(true); // who calls twice still reads the number
        bringIntoView(m_call);
        bringIntoView(m_patient); // why they are called stands above it
        if (!isDoubleClick(m_called))
            Q_EMIT callRequested();
    });
}

/// To be read from where the telephone hangs.
void DiagnosisSheet::showCall(bool large)
{
    theme::setTextRole(m_call, large ? TextRole::Alarm : TextRole::Strong);
    setInk(m_call, large ? colour::bright : colour::text);
}

// Of a link between two others there is nothing to check from here; then it is what folds the sheet, and never what re-opens.
void DiagnosisSheet::focusChecks() { (m_checks->isVisibleTo(this) ? m_checks : m_fold)->setFocus(Qt::OtherFocusReason); }

void DiagnosisSheet::showNote(const QString& note)
{
    m_note->setText(note);
    m_note->setVisible(!note.isEmpty());
}

void DiagnosisSheet::setCall(const QString& call)
{
    m_call->setText(call);
    m_call->setVisible(!call.isEmpty());
    if (call.isEmpty() && window()->focusWidget() == m_showCall)
        focusChecks();
    m_showCall->setVisible(!call.isEmpty());
}

/// A second press while it runs would be told as a failure.
void DiagnosisSheet::setReopening(const PromptContent& content)
{
    if (content.reopening && window()->focusWidget() == m_reopen)
        focusChecks();
    m_reopen->setVisible(content.canReopen);
    m_reopen->setText(content.reopening ? tr("Re-opening\u2026") : tr("Re-open channel"));
    m_reopen->setAccessibleName(m_reopen->text());
    m_reopen->setEnabled(!content.reopening);
}

void DiagnosisSheet::setActions(const IncidentRecord& incident, const PromptContent& content)
{
    m_fold->setText(content.healed ? tr("Close") : tr("Fold"));
    m_fold->setAccessibleName(content.healed ? tr("Close this sheet") : tr("Fold this sheet to a chip in the alarm band"));
    m_actions->setVisible(content.decided && m_giveUpRow->isHidden());
    setReopening(content);
    m_reopenAll->setVisible(content.lostLinks > 1);
    m_reopenAll->setText(tr("Re-open all lost (%1)").arg(content.lostLinks));
    m_reopenAll->setAccessibleName(m_reopenAll->text());
    m_checks->setVisible(content.canReopen);
    m_checks->setText(incident.probing ? tr("Checking\u2026") : tr("Run checks"));
}

void DiagnosisSheet::setContent(const IncidentRecord& incident, const PromptContent& content)
{
    if (m_incident != incident.id) {
        m_giveUpRow->hide(); // the question was about another link
        showNote({});
        m_showCall->setChecked(false);
    }
    m_report = promptReport(content);
    m_incident = incident.id;
    m_peer = incident.peer;
    m_headline->setText(content.headline);
    m_since->setText(content.since);
    m_flaps->setText(content.flaps);
    m_directions->setText(content.directions);
    m_patient->setText(content.patient);
    setInk(m_patient, content.holdConfirmed ? colour::text : colour::bright);
    m_silence->setText(content.silence);
    setCall(content.call);
    m_rollCall->setLines(content.rollCall);
    m_seen->setText(content.picture + QLatin1Char('\n') + content.tip);
    m_cause->setText(content.tryFirst.isEmpty() ? content.likelyCause : content.likelyCause + QLatin1Char('\n') + content.tryFirst);
    m_lastTry->setText(content.lastTry);
    m_lastTry->setVisible(!content.lastTry.isEmpty());
    m_evidence->setText(content.evidence.join(QLatin1Char('\n')));
    m_details->setText(content.details.join(QLatin1Char('\n')));
    setActions(incident, content);
    setAccessibleDescription(content.headline + QStringLiteral(". ") + content.patient);
}

} // namespace console
