// The row of a log's review, and why a line has none.
#include "widgets/log_review.hpp"

#include "widgets/labels.hpp"
#include "widgets/sheet_button.hpp"

#include <QHBoxLayout>
#include <QVBoxLayout>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

LogReview::LogReview(QWidget* parent) : QWidget(parent), m_note(plainLabel({}, TextRole::Caption, this))
{
    setAccessibleName(tr("Review from the log"));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    auto* row = new QHBoxLayout;
    row->setSpacing(8);
    column->addLayout(row);
    m_review = addButton(tr("Review this moment"), tr("Review the picture of the chosen line's moment"));
    m_back = addButton(QStringLiteral("\u25C0"), tr("One picture back"));
    m_play = addButton(tr("Play"), tr("Play"));
    m_on = addButton(QStringLiteral("\u25B6"), tr("One picture on"));
    for (SheetButton* button : {m_review, m_back, m_play, m_on})
        row->addWidget(button);
    row->addStretch(1);
    m_note->setWordWrap(true);
    m_note->setMinimumHeight(QFontMetrics(m_note->font()).height());
    setInk(m_note, colour::secondary);
    column->addWidget(m_note);
    connect(m_review, &QPushButton::clicked, this, &LogReview::reviewRequested);
    connect(m_back, &QPushButton::clicked, this, [this] { Q_EMIT stepRequested(-1); });
    connect(m_on, &QPushButton::clicked, this, [this] { Q_EMIT stepRequested(1); });
    connect(m_play, &QPushButton::clicked, this, [this] { Q_EMIT playRequested(!m_playing); });
    renew();
}

SheetButton* LogReview::addButton(const QString& text, const QString& accessibleName)
{
    auto* button = new SheetButton(text, SheetButton::Enter::Clicks, this);
    button->setAccessibleName(accessibleName);
    button->setProperty("compact", true);
    return button;
}

void LogReview::showLine(std::optional<MomentPicture> picture, Duration kept)
{
    const auto whole = std::chrono::floor<std::chrono::seconds>(kept); // never more than there is
    if (m_picture == picture && m_kept == whole)
        return;
    m_picture = picture;
    m_kept = whole;
    renew();
}

void LogReview::showReview(bool open, bool playing)
{
    m_open = open;
    m_playing = playing;
    renew();
}

void LogReview::renew()
{
    const bool inFilm = m_back->hasFocus() || m_play->hasFocus() || m_on->hasFocus();
    if ((!mayReview() && m_review->hasFocus()) || (!m_open && inFilm))
        Q_EMIT focusLeaving();
    m_review->setEnabled(mayReview());
    for (SheetButton* button : {m_back, m_play, m_on})
        button->setVisible(m_open);
    m_play->setText(m_playing ? tr("Stop") : tr("Play"));
    m_play->setAccessibleName(m_playing ? tr("Stop the film") : tr("Play"));
    const QString why = reason();
    m_review->setAccessibleDescription(why);
    m_note->setText(!why.isEmpty() ? why : m_open ? tr("\u25B6 is before the last line up to the picture in review.") : QString());
}

QString LogReview::reason() const
{
    if (!m_picture || mayReview())
        return {};
    if (*m_picture == MomentPicture::NotTaken)
        return tr("No picture came at this moment, nor shortly before it.");
    // How many seconds fit into the memory depends on the pictures.
    return m_kept.count() > 0 ? tr("No picture of this moment is kept: the last %1 s of pictures are.").arg(m_kept.count())
                              : tr("No picture of this moment is kept.");
}

} // namespace console
