// The controls under the reference picture.
#include "widgets/review_controls.hpp"

#include "widgets/small_button.hpp"

#include <QHBoxLayout>

namespace console {

ReviewControls::ReviewControls(QWidget* parent) : QWidget(parent)
{
    setAccessibleName(tr("Reference picture controls"));
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(4, 2, 4, 2);
    row->setSpacing(2);
    m_hold = addButton(tr("Hold"), tr("Last image hold"), tr("The last picture of the run"));
    m_review = addButton(tr("Review"), tr("Review"), tr("The last minute"));
    row->addStretch(1);
    m_oldest = addButton(QStringLiteral("|\u25C0"), tr("Oldest picture"), tr("To the oldest picture"));
    m_back = addButton(QStringLiteral("\u25C0"), tr("One picture back"), tr("One picture back"));
    m_play = addButton(tr("Play"), tr("Play"), tr("As a film, in the time in which it was taken"));
    m_on = addButton(QStringLiteral("\u25B6"), tr("One picture on"), tr("One picture on"));
    row->addStretch(1);
    SmallButton* save = addButton(tr("Save"), tr("Save reference picture"), tr("As PNG and as DICOM Secondary Capture"));
    connect(m_hold, &SmallButton::clicked, this, &ReviewControls::holdRequested);
    connect(m_review, &SmallButton::clicked, this, &ReviewControls::reviewRequested);
    connect(m_oldest, &SmallButton::clicked, this, &ReviewControls::oldestRequested);
    connect(m_back, &SmallButton::clicked, this, [this] { Q_EMIT stepRequested(-1); });
    connect(m_on, &SmallButton::clicked, this, [this] { Q_EMIT stepRequested(1); });
    connect(m_play, &SmallButton::clicked, this, [this] { Q_EMIT playRequested(!m_playing); });
    connect(save, &SmallButton::clicked, this, &ReviewControls::saveRequested);
    showReview(false, false);
}

SmallButton* ReviewControls::addButton(const QString& text, const QString& name, const QString& tip)
{
    auto* button = new SmallButton(text, name, tip, this);
    layout()->addWidget(button);
    return button;
}

void ReviewControls::showReview(bool open, bool playing)
{
    m_playing = playing;
    m_hold->setInForce(!open);
    m_review->setInForce(open);
    for (SmallButton* button : {m_oldest, m_back, m_play, m_on})
        button->setEnabled(open);
    m_play->setText(playing ? tr("Stop") : tr("Play"));
    m_play->setAccessibleName(playing ? tr("Stop the film") : tr("Play"));
}

} // namespace console
