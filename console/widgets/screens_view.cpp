// Rows of choices, rows of layouts, and the line to save one.
#include "widgets/screens_view.hpp"

#include "widgets/choice_row.hpp"
#include "widgets/labels.hpp"
#include "widgets/row_area.hpp"
#include "widgets/sheet_button.hpp"
#include "widgets/touch_line.hpp"

#include <QApplication>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QVBoxLayout>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

constexpr int longestName = 40;

} // namespace

ScreensView::ScreensView(QWidget* parent)
    : QFrame(parent),
      m_leave(new SheetButton(tr("To the cockpit  F1"), SheetButton::Enter::Clicks, this)),
      m_save(new SheetButton(tr("Save layout"), SheetButton::Enter::Clicks, this)),
      m_name(new TouchLine(tr("Name for the present layout"), tr("name for the present layout"), this)),
      m_words(plainLabel({}, TextRole::Body, this)),
      m_area(new RowArea(tr("Screens, pictures and layouts"), this))
{
    setAccessibleName(tr("Screens and layouts"));
    setAutoFillBackground(true);
    setFocusProxy(m_leave);
    m_leave->setAccessibleName(tr("Leave screens and layouts"));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(18, 12, 14, 10);
    column->setSpacing(8);
    QLabel* title = plainLabel(tr("Screens and layouts"), TextRole::Title, this);
    setInk(title, colour::bright);
    m_words->setWordWrap(true);
    column->addWidget(title);
    column->addWidget(m_words);
    column->addWidget(m_area, 1);
    makeSaving(column);
    connect(m_leave, &QPushButton::clicked, this, &ScreensView::leaveRequested);
    rebuild();
}

void ScreensView::makeSaving(QVBoxLayout* column)
{
    m_name->setMaxLength(longestName);
    m_save->setAccessibleName(tr("Save the present layout under this name"));
    auto* foot = new QHBoxLayout;
    foot->setSpacing(10);
    foot->addWidget(m_name, 1);
    foot->addWidget(m_save);
    foot->addSpacing(20);
    foot->addWidget(m_leave);
    column->addLayout(foot);
    connect(m_save, &QPushButton::clicked, this, &ScreensView::save);
    connect(m_name, &QLineEdit::returnPressed, this, &ScreensView::save);
}

void ScreensView::save()
{
    if (m_state.fixed.isEmpty())
        Q_EMIT saveRequested(m_name->text());
}

void ScreensView::showState(const State& state)
{
    if (state == m_state)
        return;
    // That they may change again takes back nothing but that they may not.
    if (state.fixed != m_state.fixed && (!state.fixed.isEmpty() || m_words->text() == m_state.fixed))
        say(state.fixed);
    m_state = state;
    const QWidget* focus = QApplication::focusWidget();
    const bool within = focus != nullptr && m_body->isAncestorOf(focus);
    if (within)
        m_leave->setFocus(); // before what has it goes: the hand gets no key in between
    rebuild();
}

void ScreensView::say(const QString& words) { m_words->setText(words); }

void ScreensView::rebuild()
{
    if (QWidget* old = m_area->takeWidget()) {
        old->hide();
        old->deleteLater(); // the wish may have come from one of its buttons
    }
    m_body = new QWidget;
    auto* column = new QVBoxLayout(m_body);
    column->setContentsMargins(0, 4, 8, 4);
    column->setSpacing(12);
    QStringList arrangements;
    for (int i = 0; i < arrangementCount; ++i)
        arrangements << word(Arrangement(i));
    auto* pictures = new ChoiceRow(tr("Pictures"),
                                   tr("F10 changes the reference and the live picture over, F11 the scene. The live picture keeps its "
                                      "unbroken frame and is never smaller than another."),
                                   arrangements, m_body);
    pictures->setValue(int(m_state.arrangement), {});
    connect(pictures, &ChoiceRow::chosen, this, [this](int i) { Q_EMIT arrangementChosen(Arrangement(i)); });
    column->addWidget(pictures);
    addScreens(column);
    addLayouts(column);
    column->addStretch(1);
    m_area->setWidget(m_body);
    m_save->setEnabled(m_state.fixed.isEmpty());
    theme::applyScale(m_body, theme::scaleOf(this));
}

void ScreensView::addScreens(QVBoxLayout* column)
{
    QStringList choices{tr("none")};
    choices << m_state.further;
    auto* second = new ChoiceRow(
        tr("Second screen"), tr("Topology, conditions for motion, plots, trends and log. It moves nothing; the hand has no keys in it."),
        choices, m_body);
    second->setValue(int(m_state.further.indexOf(m_state.second)) + 1,
                     m_state.further.isEmpty() ? tr("no further screen is there") : QString());
    auto* third = new ChoiceRow(tr("Third screen"), tr("The reference picture, at most as large as the live one."), choices, m_body);
    third->setValue(int(m_state.further.indexOf(m_state.third)) + 1, {});
    for (ChoiceRow* row : {second, third}) {
        row->setReadOnly(!m_state.fixed.isEmpty());
        column->addWidget(row);
    }
    const auto screen = [this](int i) { return i == 0 ? QString() : m_state.further.value(i - 1); };
    connect(second, &ChoiceRow::chosen, this, [this, screen](int i) { Q_EMIT secondChosen(screen(i)); });
    connect(third, &ChoiceRow::chosen, this, [this, screen](int i) { Q_EMIT thirdChosen(screen(i)); });
}

void ScreensView::addLayouts(QVBoxLayout* column)
{
    column->addWidget(headingLabel(m_state.layouts.isEmpty() ? tr("No layout is saved yet") : tr("Layouts"), m_body));
    for (int i = 0; i < m_state.layouts.size(); ++i) {
        const QString& name = m_state.layouts.at(i);
        auto* row = new QHBoxLayout;
        row->setSpacing(8);
        row->addWidget(plainLabel(tr("Ctrl+%1  %2").arg(QString::number(i + 1), name), TextRole::Body, m_body), 1);
        auto* restore = new SheetButton(tr("Restore"), SheetButton::Enter::Clicks, m_body);
        restore->setAccessibleName(tr("Restore the layout %1").arg(name));
        auto* remove = new SheetButton(tr("Delete"), SheetButton::Enter::Ignored, m_body);
        remove->setAccessibleName(tr("Delete the layout %1").arg(name));
        for (SheetButton* button : {restore, remove}) {
            button->setProperty("compact", true);
            button->setEnabled(m_state.fixed.isEmpty());
            row->addWidget(button);
        }
        column->addLayout(row);
        connect(restore, &QPushButton::clicked, this, [this, i] { Q_EMIT restoreRequested(i); });
        connect(remove, &QPushButton::clicked, this, [this, i] { Q_EMIT deleteRequested(i); });
    }
}

} // namespace console
