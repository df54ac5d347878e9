// The waterfall above, the table below.
#include "widgets/plots_view.hpp"

#include "widgets/figures.hpp"
#include "widgets/labels.hpp"
#include "widgets/sheet_button.hpp"
#include "widgets/theme.hpp"
#include "widgets/trends_pane.hpp"
#include "widgets/waterfall.hpp"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QVBoxLayout>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

constexpr std::chrono::milliseconds period{250};

} // namespace

PlotsView::PlotsView(const ConsoleModels& models, QWidget* parent)
    : QFrame(parent),
      m_models(models),
      m_waterfall(new Waterfall(this)),
      m_leave(new SheetButton(tr("To the cockpit  F1"), SheetButton::Enter::Clicks, this))
{
    setAccessibleName(tr("Plots"));
    setFocusProxy(m_leave);
    m_leave->setAccessibleName(tr("Leave the plots"));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(18, 12, 18, 10);
    column->setSpacing(8);
    column->addWidget(headingLabel(tr("Where the picture's age comes from: median and 99th percentile of the last minute"), this));
    column->addWidget(m_waterfall, 3);
    column->addSpacing(6);
    column->addWidget(headingLabel(tr("How the figures lay; over ten minutes the largest of each second"), this));
    column->addLayout(makeTable(), 2);
    auto* foot = new QHBoxLayout;
    foot->addStretch(1);
    foot->addWidget(m_leave);
    column->addLayout(foot);
    connect(m_leave, &QPushButton::clicked, this, &PlotsView::leaveRequested);
    m_clock.setInterval(period);
    connect(&m_clock, &QTimer::timeout, this, [this] { refresh(std::chrono::steady_clock::now()); });
}

QGridLayout* PlotsView::makeTable()
{
    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(18);
    grid->setVerticalSpacing(3);
    grid->setColumnStretch(0, 1);
    const QStringList heads{tr("60 s, median"), tr("60 s, 99 %"), tr("10 min, median"), tr("10 min, 99 %")};
    for (int i = 0; i < int(columns); ++i) {
        QLabel* head = plainLabel(heads.at(i), TextRole::Caption, this);
        setInk(head, colour::secondary);
        grid->addWidget(head, 0, i + 1, Qt::AlignRight);
    }
    for (std::size_t row = 0; row < trendFigures; ++row) {
        const auto shown = TrendsPane::describe(static_cast<TrendFigure>(row));
        grid->addWidget(plainLabel(shown.name, TextRole::Body, this), int(row) + 1, 0);
        for (std::size_t i = 0; i < columns; ++i) {
            auto* value = new FigureLabel(this);
            theme::setTextRole(value, TextRole::Body);
            value->reserve(QStringLiteral("0000.0 ms"));
            value->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
            value->setAccessibleName(shown.name + QStringLiteral(", ") + heads.at(int(i)));
            grid->addWidget(value, int(row) + 1, int(i) + 1);
            m_figures.at(row).at(i) = value;
        }
    }
    return grid;
}

void PlotsView::refresh(Instant now)
{
    m_waterfall->refresh(m_models.picture.stages(), milliseconds(m_models.picture.limit()), now);
    for (std::size_t row = 0; row < trendFigures; ++row) {
        const auto which = static_cast<TrendFigure>(row);
        const auto shown = TrendsPane::describe(which);
        std::size_t column = 0;
        for (const TrendSpan span : {TrendSpan::Minute, TrendSpan::TenMinutes}) {
            const auto summary = m_models.trends.summary(which, span);
            for (const auto& value :
                 {summary ? std::optional(summary->p50) : std::nullopt, summary ? std::optional(summary->p99) : std::nullopt}) {
                auto* label = m_figures.at(row).at(column++);
                label->setText(figure(value, shown.decimals, shown.unit));
                setInk(label, value ? colour::text : colour::secondary);
            }
        }
    }
}

void PlotsView::showEvent(QShowEvent* event)
{
    refresh(std::chrono::steady_clock::now());
    m_clock.start();
    QFrame::showEvent(event);
}

void PlotsView::hideEvent(QHideEvent* event)
{
    m_clock.stop();
    QFrame::hideEvent(event);
}

} // namespace console
