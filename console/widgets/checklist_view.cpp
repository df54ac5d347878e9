// Rows of mark and text, the summary above them, and the way out below.
#include "widgets/checklist_view.hpp"

#include "widgets/figures.hpp"
#include "widgets/guard_list.hpp"
#include "widgets/labels.hpp"
#include "widgets/sheet_button.hpp"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QPainter>
#include <QVBoxLayout>

#include <algorithm>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

constexpr int checklistColumns = 2;

QString markWord(GuardMark mark)
{
    switch (mark) {
    case GuardMark::Missing:
        return ChecklistPane::tr("missing");
    case GuardMark::Met:
        return ChecklistPane::tr("met");
    case GuardMark::NotAsked:
        return ChecklistPane::tr("not asked for while armed");
    }
    return {};
}

} // namespace

/// One condition; a text without the room for it is cut, and whole in the tool tip.
class GuardRow : public QWidget {
public:
    explicit GuardRow(QWidget* parent) : QWidget(parent)
    {
        theme::setTextRole(this, TextRole::Body);
        setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    }

    void setGuard(const ShownGuard& guard)
    {
        if (m_guard == guard)
            return;
        m_guard = guard;
        setAccessibleName(guard.text);
        setAccessibleDescription(markWord(guard.mark));
        setToolTip(QStringLiteral("<qt>%1</qt>").arg(guard.text.toHtmlEscaped()));
        update();
    }

    QSize sizeHint() const override { return {theme::px(this, 260), int(QFontMetricsF(font()).height() * 1.25)}; }
    QSize minimumSizeHint() const override { return {theme::px(this, 120), QFontMetrics(font()).height()}; }

protected:
    void paintEvent(QPaintEvent*) override
    {
        QPainter painter(this);
        painter.setRenderHint(QPainter::Antialiasing);
        const QFontMetricsF metrics(font());
        const double box = metrics.capHeight();
        drawGuardMark(painter, QRectF(2, (height() - box) / 2, box, box), m_guard.mark);
        const QRectF text(box + theme::px(this, 14), 0, width() - box - theme::px(this, 14), height());
        painter.setPen(m_guard.mark == GuardMark::Missing ? colour::bright : colour::secondary);
        drawFigures(painter, text, Qt::AlignLeft | Qt::AlignVCenter, metrics.elidedText(m_guard.text, Qt::ElideRight, text.width()));
    }

private:
    ShownGuard m_guard{GuardMark::NotAsked, {}};
};

ChecklistPane::ChecklistPane(const PermitModel& permit, QWidget* parent)
    : QFrame(parent), m_permit(permit), m_summary(plainLabel({}, TextRole::Title, this)), m_grid(new QGridLayout)
{
    setAccessibleName(tr("Conditions for motion"));
    setInk(m_summary, colour::bright);
    m_summary->setWordWrap(true);
    m_grid->setHorizontalSpacing(18);
    m_grid->setVerticalSpacing(3);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addWidget(m_summary);
    column->addLayout(m_grid);
    column->addStretch(1);
    const int down = (int(guardCount) + checklistColumns - 1) / checklistColumns;
    for (int i = 0; i < int(guardCount); ++i) {
        auto* row = new GuardRow(this);
        m_grid->addWidget(row, i % down, i / down);
        m_rows.push_back(row);
    }
    connect(&permit, &PermitModel::checklistChanged, this, &ChecklistPane::refresh);
    connect(&permit, &PermitModel::phaseChanged, this, &ChecklistPane::refresh);
    refresh();
}

void ChecklistPane::refresh()
{
    const auto shown = shownGuards(m_permit.checklist(), m_permit.state());
    const auto of = [&shown](GuardMark mark) {
        return int(std::count_if(shown.begin(), shown.end(), [mark](const ShownGuard& guard) { return guard.mark == mark; }));
    };
    for (std::size_t i = 0; i < std::min(shown.size(), m_rows.size()); ++i)
        m_rows[i]->setGuard(shown[i]);
    const int missing = of(GuardMark::Missing);
    const int asked = int(shown.size()) - of(GuardMark::NotAsked);
    m_summary->setText(missing == 0   ? tr("All %1 conditions are met").arg(asked)
                       : missing == 1 ? tr("1 of %1 conditions is missing").arg(asked)
                                      : tr("%1 of %2 conditions are missing").arg(missing).arg(asked));
}

ChecklistView::ChecklistView(const PermitModel& permit, QWidget* parent) : QFrame(parent)
{
    setAccessibleName(tr("Conditions for motion"));
    auto* leave = new SheetButton(tr("To the cockpit  F1"), SheetButton::Enter::Clicks, this);
    leave->setAccessibleName(tr("Leave the conditions"));
    setFocusProxy(leave);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(18, 12, 18, 10);
    column->setSpacing(8);
    column->addWidget(new ChecklistPane(permit, this), 1);
    auto* foot = new QHBoxLayout;
    foot->addStretch(1);
    foot->addWidget(leave);
    column->addLayout(foot);
    connect(leave, &QPushButton::clicked, this, &ChecklistView::leaveRequested);
}

} // namespace console
