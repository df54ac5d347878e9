// The controls under the reference picture.
#include "widgets/review_controls.hpp"

#include "widgets/small_button.hpp"

#include <QHBoxLayout>
#include <QSlider>

#include <initializer_list>

namespace console {

namespace {

constexpr int strengthStep = 10; ///< per cent
constexpr int leastSlider = 40;  ///< px: its handle, and a way for it

} // namespace

ReviewControls::ReviewControls(QWidget* parent) : QWidget(parent)
{
    setAccessibleName(tr("Reference picture controls"));
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(4, 2, 4, 2);
    row->setSpacing(2);
    m_hold = addButton(tr("Hold"), tr("Last image hold"), tr("The last picture of the run"));
    m_review = addButton(tr("Review"), tr("Review"), tr("The last minute"));
    m_roadmap = addButton(tr("Roadmap"), tr("Roadmap"), tr("The live picture under the vessels that the last run with contrast filled"));
    row->addStretch(1);
    addStrength(row);
    m_oldest = addButton(QStringLiteral("|\u25C0"), tr("Oldest picture"), tr("To the oldest picture"));
    m_back = addButton(QStringLiteral("\u25C0"), tr("One picture back"), tr("One picture back"));
    m_play = addButton(tr("Play"), tr("Play"), tr("As a film, in the time in which it was taken"));
    m_on = addButton(QStringLiteral("\u25B6"), tr("One picture on"), tr("One picture on"));
    row->addStretch(1);
    SmallButton* save = addButton(tr("Save"), tr("Save reference picture"), tr("As PNG and as DICOM Secondary Capture"));
    connect(m_hold, &SmallButton::clicked, this, &ReviewControls::holdRequested);
    connect(m_review, &SmallButton::clicked, this, &ReviewControls::reviewRequested);
    connect(m_roadmap, &SmallButton::clicked, this, &ReviewControls::roadmapRequested);
    connect(m_oldest, &SmallButton::clicked, this, &ReviewControls::oldestRequested);
    connect(m_back, &SmallButton::clicked, this, [this] { Q_EMIT stepRequested(-1); });
    connect(m_on, &SmallButton::clicked, this, [this] { Q_EMIT stepRequested(1); });
    connect(m_play, &SmallButton::clicked, this, [this] { Q_EMIT playRequested(!m_playing); });
    connect(save, &SmallButton::clicked, this, &ReviewControls::saveRequested);
    showReview(false, false);
}

/// The arrows and the page keys are the hand's: the buttons are the keyboard's way to it.
void ReviewControls::addStrength(QHBoxLayout* row)
{
    m_weaker = addButton(QStringLiteral("\u2212"), tr("Weaker vessels of the roadmap"), tr("Weaker vessels of the roadmap"));
    m_opacity = new QSlider(Qt::Horizontal, this);
    m_opacity->setAccessibleName(tr("Strength of the roadmap's vessels"));
    m_opacity->setToolTip(m_opacity->accessibleName());
    m_opacity->setFocusPolicy(Qt::TabFocus); // a click leaves the keys to the hand
    m_opacity->setMinimumWidth(leastSlider);
    m_opacity->setRange(0, 100);
    m_opacity->setValue(60);
    row->addWidget(m_opacity, 4);
    m_stronger = addButton(QStringLiteral("+"), tr("Stronger vessels of the roadmap"), tr("Stronger vessels of the roadmap"));
    connect(m_weaker, &SmallButton::clicked, this, [this] { m_opacity->setValue(m_opacity->value() - strengthStep); });
    connect(m_stronger, &SmallButton::clicked, this, [this] { m_opacity->setValue(m_opacity->value() + strengthStep); });
    connect(m_opacity, &QSlider::valueChanged, this, [this](int percent) { Q_EMIT opacityChanged(percent / 100.0); });
}

SmallButton* ReviewControls::addButton(const QString& text, const QString& name, const QString& tip)
{
    auto* button = new SmallButton(text, name, tip, this);
    layout()->addWidget(button);
    return button;
}

void ReviewControls::showReview(bool open, bool playing)
{
    m_reviewing = open;
    m_playing = playing;
    updateButtons();
}

void ReviewControls::showRoadmap(bool wanted)
{
    m_mapping = wanted;
    updateButtons();
}

void ReviewControls::updateButtons()
{
    m_hold->setInForce(!m_reviewing && !m_mapping);
    m_review->setInForce(m_reviewing);
    m_roadmap->setInForce(m_mapping);
    for (QWidget* strength : std::initializer_list<QWidget*>{m_weaker, m_opacity, m_stronger})
        strength->setVisible(m_mapping);
    for (SmallButton* button : {m_oldest, m_back, m_play, m_on}) {
        button->setEnabled(m_reviewing);
        button->setVisible(!m_mapping);
    }
    const bool playing = m_playing;
    m_play->setText(playing ? tr("Stop") : tr("Play"));
    m_play->setAccessibleName(playing ? tr("Stop the film") : tr("Play"));
}

} // namespace console
