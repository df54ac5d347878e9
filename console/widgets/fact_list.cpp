// Rows of name and text.
#include "widgets/fact_list.hpp"

#include "widgets/labels.hpp"
#include "widgets/touch_scrolling.hpp"

#include <QGridLayout>
#include <QVBoxLayout>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

FactList::FactList(const QString& accessibleName, QWidget* parent) : QScrollArea(parent), m_grid(new QGridLayout)
{
    setAccessibleName(accessibleName);
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setFocusPolicy(Qt::StrongFocus); // scrolled by the arrow keys
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scrollByTouch(*this);
    auto* body = new QWidget(this);
    auto* column = new QVBoxLayout(body);
    column->setContentsMargins(2, 0, 8, 0);
    m_grid->setHorizontalSpacing(24);
    m_grid->setVerticalSpacing(7);
    m_grid->setColumnStretch(1, 1);
    column->addLayout(m_grid);
    column->addStretch(1);
    setWidget(body);
}

void FactList::setFacts(const std::vector<Fact>& facts)
{
    if (facts == m_facts)
        return;
    m_facts = facts;
    while (m_rows.size() < facts.size()) {
        const int row = int(m_rows.size());
        QLabel* name = headingLabel({}, this);
        QLabel* text = plainLabel({}, TextRole::Body, this);
        text->setWordWrap(true);
        m_grid->addWidget(name, row, 0, Qt::AlignTop);
        m_grid->addWidget(text, row, 1);
        m_rows.emplace_back(name, text);
    }
    QStringList words;
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        const bool shown = i < facts.size();
        m_rows[i].first->setVisible(shown);
        m_rows[i].second->setVisible(shown);
        if (!shown)
            continue;
        m_rows[i].first->setText(facts[i].name);
        m_rows[i].second->setText(facts[i].text);
        setInk(m_rows[i].second, facts[i].known ? colour::text : colour::stale);
        words << facts[i].name + QStringLiteral(": ") + facts[i].text;
    }
    setAccessibleDescription(words.join(QStringLiteral(". ")));
}

} // namespace console
