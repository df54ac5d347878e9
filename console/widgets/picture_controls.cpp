// The controls under the live picture.
#include "widgets/picture_controls.hpp"

#include "widgets/focus_return.hpp"
#include "widgets/labels.hpp"
#include "widgets/small_button.hpp"

#include <QHBoxLayout>

namespace console {

PictureControls::PictureControls(DisplayState& display, QWidget* parent)
    : QWidget(parent), m_display(display), m_rows(new QBoxLayout(QBoxLayout::LeftToRight, this))
{
    setAccessibleName(tr("Picture controls"));
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); // the picture decides on the width
    m_rows->setContentsMargins(4, 0, 4, 0);
    m_rows->setSpacing(1);
    QBoxLayout* looks = new QHBoxLayout;
    QBoxLayout* tools = new QHBoxLayout;
    for (QBoxLayout* row : {looks, tools}) {
        row->setSpacing(2);
        m_rows->addLayout(row, row == looks ? 1 : 0);
    }
    m_row = looks;
    buildWindowButtons();
    m_row->addStretch(1);
    buildSteppers();
    m_row->addStretch(1);
    m_row = tools;
    buildToolButtons();
    connect(&display, &DisplayState::changed, this, &PictureControls::showSettings);
    connect(&display, &DisplayState::measureModeChanged, this, &PictureControls::showMeasuring);
    connect(&display, &DisplayState::planeChanged, this, &PictureControls::showPlane);
    showMeasuring(display.measureMode());
    showPlane(display.plane());
    showSettings(display.settings());
    showZoom(1);
}

void PictureControls::resizeEvent(QResizeEvent*)
{
    int needed = m_rows->contentsMargins().left() + m_rows->contentsMargins().right() + m_rows->spacing();
    for (int i = 0; i < m_rows->count(); ++i)
        needed += m_rows->itemAt(i)->sizeHint().width();
    m_rows->setDirection(width() < needed ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
}

SmallButton* PictureControls::addButton(const QString& text, const QString& name, const QString& tip)
{
    auto* button = new SmallButton(text, name, tip, this);
    m_row->addWidget(button);
    return button;
}

/// Gives way where even two rows are too narrow for it.
void PictureControls::addGap(int width) { m_row->addSpacerItem(new QSpacerItem(width, 0, QSizePolicy::Maximum)); }

QLabel* PictureControls::addStepper(const QString& name, const std::function<void(int)>& step)
{
    constexpr int besideValue = 6;
    SmallButton* less = addButton(QStringLiteral("\u2212"), tr("Less %1").arg(name), tr("Less %1").arg(name));
    QLabel* label = plainLabel({}, theme::TextRole::Caption, this);
    label->setAlignment(Qt::AlignCenter);
    addGap(besideValue);
    m_row->addWidget(label);
    addGap(besideValue);
    SmallButton* more = addButton(QStringLiteral("+"), tr("More %1").arg(name), tr("More %1").arg(name));
    connect(less, &QPushButton::clicked, this, [step] { step(-1); });
    connect(more, &QPushButton::clicked, this, [step] { step(1); });
    return label;
}

void PictureControls::buildWindowButtons()
{
    m_automatic = addButton(tr("AUTO"), tr("Automatic window"), tr("Window from the 1st to the 99th percentile (A)"));
    m_window = addButton(tr("Window"), tr("Next window"), tr("As sent, full range, half width, twice the width (P)"));
    m_invert = addButton(tr("Invert"), tr("Invert"), tr("Black and white changed over (N)"));
    connect(m_automatic, &QPushButton::clicked, &m_display, &DisplayState::setAutomatic);
    connect(m_window, &QPushButton::clicked, &m_display, &DisplayState::nextWindow);
    connect(m_invert, &QPushButton::clicked, &m_display, &DisplayState::toggleInverted);
}

void PictureControls::buildSteppers()
{
    constexpr int between = 8; // a plus and the next minus are not one button
    m_zoom = addStepper(tr("zoom"), [this](int steps) { Q_EMIT zoomRequested(steps); });
    addGap(between);
    m_noise = addStepper(tr("noise reduction"), [this](int steps) { m_display.stepNoiseReduction(steps); });
    addGap(between);
    m_edge = addStepper(tr("edge enhancement"), [this](int steps) { m_display.stepEdge(steps); });
}

void PictureControls::buildToolButtons()
{
    SmallButton* whole = addButton(tr("Reset"), tr("Reset picture"), tr("Whole picture, window as sent, no filters"));
    m_shutter = addButton(tr("Shutter"), tr("Shutter"), tr("None, round, square (H)"));
    m_measure = addButton(tr("Measure"), tr("Measure"), tr("Distance, angle, off (M)"));
    buildMeasuringButtons();
    SmallButton* save = addButton(tr("Save"), tr("Save picture"), tr("As PNG and as DICOM Secondary Capture"));
    connect(whole, &QPushButton::clicked, this, [this] {
        m_display.reset();
        Q_EMIT wholeRequested();
    });
    connect(m_shutter, &QPushButton::clicked, &m_display, &DisplayState::nextShutter);
    connect(m_measure, &QPushButton::clicked, &m_display, &DisplayState::nextMeasureMode);
    connect(save, &QPushButton::clicked, this, &PictureControls::saveRequested);
}

/// Their places are kept for them while nothing is measured: nothing moves under the finger that pressed *Measure*.
void PictureControls::buildMeasuringButtons()
{
    m_catheter = addButton(tr("Catheter"), tr("Width of a catheter"), tr("The distance is the width of a catheter: 4 F to 8 F, none (B)"));
    m_plane = addButton(tr("Plane"), tr("Plane of lengths"), tr("Lengths at the isocentre, or in a plane above the table (O)"));
    for (SmallButton* button : {m_catheter, m_plane}) {
        QSizePolicy kept = button->sizePolicy();
        kept.setRetainSizeWhenHidden(true);
        button->setSizePolicy(kept);
    }
    connect(m_catheter, &QPushButton::clicked, this, &PictureControls::catheterRequested);
    connect(m_plane, &QPushButton::clicked, this, &PictureControls::planeRequested);
}

void PictureControls::showMeasuring(MeasureMode mode)
{
    m_measure->setText(mode == MeasureMode::Off ? tr("Measure") : mode == MeasureMode::Distance ? tr("Distance") : tr("Angle"));
    m_measure->setAccessibleDescription(word(mode));
    m_measure->setInForce(mode != MeasureMode::Off);
    for (SmallButton* button : {m_catheter, m_plane}) {
        if (mode != MeasureMode::Distance)
            returnFocus(button);
        button->setVisible(mode == MeasureMode::Distance);
    }
}

void PictureControls::showPlane(const MeasurePlane& plane)
{
    m_plane->setInForce(plane.object.has_value());
    m_plane->setAccessibleDescription(plane.object ? tr("%1 cm above the table").arg(*plane.object / 10.0, 0, 'f', 1)
                                                   : tr("at the isocentre"));
}

void PictureControls::showZoom(double zoom) { m_zoom->setText(tr("%1\u00D7").arg(zoom, 0, 'f', 1)); }

void PictureControls::showSettings(const DisplaySettings& settings)
{
    const bool automatic = settings.window == WindowChoice::Automatic;
    m_automatic->setInForce(automatic);
    m_window->setInForce(!automatic && settings.window != WindowChoice::AsSent);
    m_invert->setInForce(settings.inverted);
    m_shutter->setInForce(settings.shutter != ShutterShape::None);
    m_window->setAccessibleDescription(word(settings.window));
    m_shutter->setAccessibleDescription(word(settings.shutter));
    m_noise->setText(tr("noise %1").arg(settings.noiseReduction));
    m_edge->setText(tr("edge %1").arg(settings.edge));
}

} // namespace console
