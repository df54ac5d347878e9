// A repeat is never shown without its age.
#include "widgets/dose_panel.hpp"

#include "widgets/contrast_bar.hpp"
#include "widgets/figures.hpp"
#include "widgets/labels.hpp"
#include "widgets/stale_mark.hpp"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QVBoxLayout>

#include <cmath>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

DosePanel::DosePanel(const InstrumentState& instrument, const XraySystemState& xray, QWidget* parent)
    : QFrame(parent), m_instrument(instrument), m_xray(xray)
{
    setAccessibleName(tr("Contrast and dose"));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(14, 4, 14, 6);
    column->setSpacing(2);
    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(18);
    grid->setVerticalSpacing(2);
    for (int c = 0; c < 3; ++c)
        grid->setColumnStretch(c, 1);
    m_contrast = addFigure(grid, 0, 0, tr("Contrast left"), QStringLiteral("000.0 mL"));
    m_injection = addFigure(grid, 0, 1, tr("Last injection"), QStringLiteral("00.0 mL"));
    m_fluoroscopy = addFigure(grid, 0, 2, tr("Fluoroscopy time"), QStringLiteral("00:00"));
    m_contrastBar = new ContrastBar(this);
    grid->removeWidget(m_contrast);
    auto* left = new QHBoxLayout;
    left->setSpacing(6);
    left->addWidget(m_contrast, 1);
    left->addWidget(m_contrastBar);
    grid->addLayout(left, 1, 0);
    m_kerma = addFigure(grid, 2, 0, tr("Air kerma"), QStringLiteral("0000.0 mGy"));
    m_kermaRate = addFigure(grid, 2, 1, tr("Kerma rate"), QStringLiteral("00.0 mGy/min"));
    m_product = addFigure(grid, 2, 2, tr("Dose-area product"), QStringLiteral("00.00 Gy·cm\u00B2"));
    m_contrastAge = new FigureLabel(this);
    m_xrayAge = new FigureLabel(this);
    for (FigureLabel* line : {m_contrastAge, m_xrayAge}) {
        theme::setTextRole(line, TextRole::Caption);
        setInk(line, colour::secondary);
    }
    m_contrastAge->reserve(tr("Contrast from the robot, never received"));
    m_contrastAge->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    auto* head = new QHBoxLayout;
    head->addWidget(headingLabel(tr("Contrast and dose"), this));
    head->addStretch(1);
    head->addWidget(m_contrastAge);
    column->addLayout(head);
    column->addLayout(grid, 1);
    column->addWidget(m_xrayAge);
}

FigureLabel* DosePanel::addFigure(QGridLayout* grid, int row, int column, const QString& caption, const QString& widest)
{
    QLabel* name = plainLabel(caption, TextRole::Caption, this);
    setInk(name, colour::secondary);
    auto* value = new FigureLabel(this);
    theme::setTextRole(value, TextRole::Title);
    value->reserve(widest);
    value->setAccessibleName(caption);
    grid->addWidget(name, row, column);
    grid->addWidget(value, row + 1, column);
    return value;
}

void DosePanel::refreshContrast(Instant now)
{
    const Aged<RobotStatus>& robot = m_instrument.robot();
    const Freshness freshness = robot.freshness(now, InstrumentState::statusLimit);
    const auto left = robot.known() ? std::optional<double>(robot.value.contrastRemaining) : std::nullopt;
    m_contrast->setText(figure(left, 1, tr("mL")));
    setInk(m_contrast, valueInk(freshness));
    m_contrastBar->setContrast(freshness == Freshness::Fresh ? left : std::nullopt, m_instrument.mostContrast());
    const auto& injections = m_instrument.injections();
    m_injection->setText(figure(injections.empty() ? std::nullopt : std::optional<double>(injections.back().delivered), 1, tr("mL")));
    setInk(m_injection, injections.empty() ? colour::secondary : colour::bright);
    m_contrastAge->setText(tr("Contrast from the robot, %1").arg(ageText(freshness, robot.age(now))));
}

void DosePanel::refresh(Instant now)
{
    refreshContrast(now);
    const Aged<AcquisitionStatus>& status = m_xray.status();
    const Freshness freshness = status.freshness(now, XraySystemState::statusLimit);
    const auto known = [&status](double value) { return status.known() ? std::optional<double>(value) : std::nullopt; };
    m_fluoroscopy->setText(status.known() ? clockDuration(fromMilliseconds(status.value.fluoroscopyTime * 1000))
                                          : QStringLiteral("\u2014"));
    m_kerma->setText(figure(known(status.value.airKerma), 1, tr("mGy")));
    m_kermaRate->setText(figure(known(status.value.airKermaRate), 1, tr("mGy/min")));
    m_product->setText(figure(known(status.value.doseAreaProduct), 2, tr("Gy·cm\u00B2")));
    for (FigureLabel* value : {m_fluoroscopy, m_kerma, m_kermaRate, m_product})
        setInk(value, valueInk(freshness));
    m_xrayAge->setText(tr("Repeat of the X-ray system, %1").arg(ageText(freshness, status.age(now))));
}

} // namespace console
