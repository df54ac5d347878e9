// The lines of the account, one below the other; what changed, or is not known, is the brightest.
#include "widgets/interruption_card.hpp"

#include "widgets/focus_return.hpp"
#include "widgets/labels.hpp"
#include "widgets/sheet_button.hpp"
#include "widgets/touch_scrolling.hpp"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QVBoxLayout>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

InterruptionCard::InterruptionCard(const InterruptionAccount& account, QWidget* parent)
    : QFrame(parent),
      m_account(account),
      m_headline(plainLabel({}, TextRole::Strong, this)),
      m_notice(
          plainLabel(tr("Two reports are compared: the last before the loss, and the newest now. What was done and undone between them "
                        "is not known here: ask the patient side."),
                     TextRole::Caption, this)),
      m_read(new SheetButton(tr("I have read this"), SheetButton::Enter::Ignored, this))
{
    setObjectName(QStringLiteral("interruptionCard"));
    setAccessibleName(tr("While you were away"));
    setAttribute(Qt::WA_StyledBackground);
    setInk(m_notice, colour::secondary);
    m_headline->setWordWrap(true);
    m_notice->setWordWrap(true);
    m_read->setAccessibleName(tr("I have read what happened while I was away"));
    m_read->setProperty("emphasis", true);
    QLabel* title = plainLabel(tr("While you were away"), TextRole::Alarm, this);
    setInk(title, colour::bright);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(16, 10, 16, 10);
    column->setSpacing(6);
    column->addWidget(title);
    column->addWidget(m_headline);
    column->addWidget(makeBody(), 1);
    auto* foot = new QHBoxLayout;
    foot->setSpacing(18);
    foot->addWidget(m_notice, 1);
    foot->addWidget(m_read);
    column->addLayout(foot);
    connect(m_read, &QPushButton::clicked, this, &InterruptionCard::readRequested);
    hide();
}

QWidget* InterruptionCard::readButton() const { return m_read; }

QWidget* InterruptionCard::makeBody()
{
    auto* area = new QScrollArea(this);
    area->setAccessibleName(tr("What changed"));
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scrollByTouch(*area);
    auto* body = new QWidget(area);
    auto* column = new QVBoxLayout(body);
    column->setContentsMargins(0, 0, 6, 0);
    m_grid = new QGridLayout;
    m_grid->setHorizontalSpacing(24);
    m_grid->setVerticalSpacing(6);
    m_grid->setColumnStretch(1, 1);
    column->addLayout(m_grid);
    column->addStretch(1);
    area->setWidget(body);
    return area;
}

void InterruptionCard::setLines(const QString& headline, const std::vector<AccountLine>& lines)
{
    if (m_headline->text() == headline && m_shown == lines)
        return;
    m_headline->setText(headline);
    m_shown = lines;
    while (m_rows.size() < lines.size()) {
        const int row = int(m_rows.size());
        QLabel* name = headingLabel({}, this);
        QLabel* text = plainLabel({}, TextRole::Body, this);
        text->setWordWrap(true);
        m_grid->addWidget(name, row, 0, Qt::AlignTop);
        m_grid->addWidget(text, row, 1);
        theme::setTextRole(name, TextRole::Strong);
        m_rows.emplace_back(name, text);
    }
    QStringList words{headline};
    for (std::size_t i = 0; i < lines.size(); ++i) {
        m_rows[i].first->setText(lines[i].name);
        m_rows[i].second->setText(lines[i].text);
        setInk(m_rows[i].second, lines[i].changed ? colour::bright : colour::text);
        words << lines[i].name + QStringLiteral(": ") + lines[i].text;
    }
    setAccessibleDescription(words.join(QStringLiteral(". ")));
}

void InterruptionCard::refresh(Instant now)
{
    const bool unread = m_account.stage() == InterruptionAccount::Stage::Unread;
    const bool readable = m_account.readable(now);
    if (!readable)
        returnFocus(m_read);
    m_read->setEnabled(readable);
    if (unread)
        setLines(accountHeadline(m_account), accountLines(m_account));
    if (isVisibleTo(parentWidget()) == unread)
        return;
    if (!unread)
        returnFocus(this);
    setVisible(unread);
}

} // namespace console
