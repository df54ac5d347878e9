// Two texts, one below the other.
#include "widgets/closing_note.hpp"

#include "model/closing_bar.hpp"
#include "widgets/labels.hpp"

#include <QVBoxLayout>

namespace console {

using theme::TextRole;

ClosingNote::ClosingNote(const ConsoleModels& models, QWidget* parent)
    : QFrame(parent), m_models(models), m_why(plainLabel({}, TextRole::Title, this)), m_first(plainLabel({}, TextRole::Body, this))
{
    setObjectName(QStringLiteral("closingNote"));
    setAccessibleName(tr("The cockpit was not closed"));
    setAttribute(Qt::WA_StyledBackground);
    setInk(m_why, theme::colour::bright);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(16, 8, 16, 8);
    column->setSpacing(4);
    for (QLabel* label : {m_why, m_first}) {
        label->setWordWrap(true);
        column->addWidget(label);
    }
    column->addStretch(1);
    hide();
}

void ClosingNote::ask(Instant now)
{
    m_asked = now;
    refresh(now);
}

void ClosingNote::refresh(Instant now)
{
    if (!m_asked)
        return;
    const auto bar = now - *m_asked < shownFor ? closingBar(m_models, now) : std::nullopt;
    if (!bar) {
        m_asked.reset();
        return hide();
    }
    m_why->setText(tr("Not closed: %1.").arg(bar->why));
    m_first->setText(tr("%1 Then close the cockpit.").arg(bar->first));
    setAccessibleDescription(m_why->text() + QLatin1Char(' ') + m_first->text());
    show();
    raise();
}

} // namespace console
