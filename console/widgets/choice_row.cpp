// Name and words on the left, buttons on the right, and beneath what the setting does.
#include "widgets/choice_row.hpp"

#include "widgets/labels.hpp"
#include "widgets/sheet_button.hpp"

#include <QGridLayout>
#include <QHBoxLayout>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

ChoiceRow::ChoiceRow(const QString& name, const QString& whatItDoes, const QStringList& choices, QWidget* parent)
    : QWidget(parent), m_words(plainLabel({}, TextRole::Body, this))
{
    setAccessibleName(name);
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setHorizontalSpacing(12);
    grid->setVerticalSpacing(1);
    grid->setColumnStretch(1, 1);
    m_words->setWordWrap(true); // the buttons are never cut
    QLabel* title = plainLabel(name, TextRole::Strong, this);
    setInk(title, colour::bright);
    QLabel* explanation = plainLabel(whatItDoes, TextRole::Caption, this);
    explanation->setWordWrap(true);
    setInk(explanation, colour::secondary);
    auto* row = new QHBoxLayout;
    row->setSpacing(6);
    for (int i = 0; i < choices.size(); ++i) {
        auto* button = new SheetButton(choices.at(i), SheetButton::Enter::Clicks, this);
        button->setAccessibleName(tr("%1: %2").arg(name, choices.at(i)));
        button->setCheckable(true);
        button->setProperty("compact", true);
        row->addWidget(button);
        m_buttons.push_back(button);
        connect(button, &QPushButton::clicked, this, [this, i] {
            setValue(m_value, m_words->text()); // a click alone changes nothing
            Q_EMIT chosen(i);
        });
    }
    grid->addWidget(title, 0, 0);
    grid->addWidget(m_words, 0, 1);
    grid->addLayout(row, 0, 2);
    grid->addWidget(explanation, 1, 0, 1, 3);
}

void ChoiceRow::setValue(int choice, const QString& words)
{
    m_value = choice;
    m_words->setText(words);
    setAccessibleDescription(words);
    for (std::size_t i = 0; i < m_buttons.size(); ++i)
        m_buttons[i]->setChecked(int(i) == choice);
}

void ChoiceRow::setReadOnly(bool readOnly)
{
    for (SheetButton* button : m_buttons)
        button->setEnabled(!readOnly);
}

} // namespace console
