// The name and the notice above, the facts, the way to begin, and two buttons.
#include "widgets/start_view.hpp"

#include "widgets/labels.hpp"
#include "widgets/sheet_button.hpp"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QTimer>
#include <QVBoxLayout>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

constexpr int clockMs = 500;

} // namespace

StartView::StartView(const ConsoleModels& models, ProgramFacts program, QWidget* parent)
    : QFrame(parent),
      m_models(models),
      m_program(std::move(program)),
      m_leave(new SheetButton(tr("To the cockpit  F1"), SheetButton::Enter::Clicks, this)),
      m_about(new SheetButton(tr("About"), SheetButton::Enter::Clicks, this)),
      m_facts(new FactList(tr("How it stands"), this)),
      m_clock(new QTimer(this))
{
    setAccessibleName(tr("Start page"));
    setAutoFillBackground(true);
    setFocusProxy(m_leave);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(20, 14, 20, 12);
    column->setSpacing(8);
    QLabel* title = plainLabel(tr("LiENa: a surgeon's console for remote vascular intervention"), TextRole::Alarm, this);
    title->setWordWrap(true);
    setInk(title, colour::bright);
    QLabel* notice = plainLabel(researchNotice(), TextRole::Title, this);
    notice->setWordWrap(true);
    column->addWidget(title);
    column->addWidget(notice);
    column->addWidget(makeSteps());
    column->addWidget(m_facts, 1);
    auto* foot = new QHBoxLayout;
    foot->setSpacing(10);
    m_leave->setAccessibleName(tr("Leave the start page"));
    m_about->setAccessibleName(tr("About this software and its parts"));
    foot->addStretch(1);
    foot->addWidget(m_about);
    foot->addWidget(m_leave);
    column->addLayout(foot);
    connect(m_leave, &QPushButton::clicked, this, &StartView::leaveRequested);
    connect(m_about, &QPushButton::clicked, this, &StartView::aboutRequested);
    connect(m_clock, &QTimer::timeout, this, &StartView::refresh);
    connect(&models.sessions, &SessionModel::linkStateChanged, this, [this](quint32, LinkState, LinkState to) {
        if (isVisible() && carriesMessages(to))
            Q_EMIT leaveRequested();
    });
}

QWidget* StartView::makeSteps()
{
    auto* box = new QWidget(this);
    box->setAccessibleName(tr("How to begin"));
    auto* grid = new QGridLayout(box);
    grid->setContentsMargins(0, 6, 0, 6);
    grid->setHorizontalSpacing(18);
    grid->setVerticalSpacing(9);
    grid->setColumnStretch(1, 1);
    const std::pair<QString, QString> steps[] = {
        {tr("F2"), tr("Topology, then \u201COpen all\u201D: opens the sessions with the devices. Nothing moves by it.")},
        {tr("F"), tr("Held: X-ray pictures. Then look at the list of conditions in the bar below.")},
        {tr("F8"), tr("Alarm self-test: three colours and three sounds; say whether they were there. Before each arming.")},
        {tr("R"), tr("Held for 1.5 s: arms, when every condition is met. Motion lasts only while the dead-man is held.")},
        {tr("F12"), tr("Hold: ends motion, from everywhere on this screen.")},
        {tr("Esc"), tr("Emergency stop, always, from everywhere on this screen.")},
    };
    int row = 0;
    for (const auto& [key, what] : steps) {
        QLabel* name = plainLabel(key, TextRole::Title, box);
        setInk(name, colour::bright);
        QLabel* text = plainLabel(what, TextRole::Title, box);
        text->setWordWrap(true);
        grid->addWidget(name, row, 0, Qt::AlignTop | Qt::AlignRight);
        grid->addWidget(text, row++, 1);
    }
    return box;
}

void StartView::refresh() { m_facts->setFacts(presentFacts(m_models, m_program)); }

void StartView::showEvent(QShowEvent* event)
{
    QFrame::showEvent(event);
    refresh();
    m_clock->start(clockMs);
}

void StartView::hideEvent(QHideEvent* event)
{
    QFrame::hideEvent(event);
    m_clock->stop();
}

} // namespace console
