// The notice, the facts, and the parts side by side with their licences.
#include "widgets/about_view.hpp"

#include "widgets/labels.hpp"
#include "widgets/sheet_button.hpp"

#include <QHBoxLayout>
#include <QVBoxLayout>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

AboutView::AboutView(const ConsoleModels& models, ProgramFacts program, QWidget* parent)
    : QFrame(parent),
      m_models(models),
      m_program(std::move(program)),
      m_leave(new SheetButton(tr("To the cockpit  F1"), SheetButton::Enter::Clicks, this)),
      m_facts(new FactList(tr("Facts"), this)),
      m_licences(new FactList(tr("Licences of the parts"), this))
{
    setAccessibleName(tr("About"));
    setAutoFillBackground(true);
    setFocusProxy(m_leave);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(20, 14, 20, 12);
    column->setSpacing(8);
    QLabel* title = plainLabel(tr("About LiENa"), TextRole::Title, this);
    setInk(title, colour::bright);
    QLabel* notice = plainLabel(researchNotice() + QLatin1Char(' ') +
                                    tr("It comes without any warranty. Where its words sound like those of a standard it follows the "
                                       "conventions of that standard and claims no more."),
                                TextRole::Strong, this);
    notice->setWordWrap(true);
    column->addWidget(title);
    column->addWidget(notice);
    column->addWidget(m_facts, 3);
    column->addWidget(headingLabel(tr("Parts used, and their licences as named by Debian 12"), this));
    m_licences->setFacts(licenceFacts());
    column->addWidget(m_licences, 4);
    auto* foot = new QHBoxLayout;
    m_leave->setAccessibleName(tr("Leave About"));
    foot->addStretch(1);
    foot->addWidget(m_leave);
    column->addLayout(foot);
    connect(m_leave, &QPushButton::clicked, this, &AboutView::leaveRequested);
}

void AboutView::showEvent(QShowEvent* event)
{
    QFrame::showEvent(event);
    m_facts->setFacts(presentFacts(m_models, m_program));
}

} // namespace console
