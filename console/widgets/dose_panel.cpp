// A repeat is never shown without its age.
#include "widgets/dose_panel.hpp"

#include "model/injection_order.hpp"
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

namespace {

/// How many injections, and how fast each would go.
QString stockText(const QString& injections)
{
    return DosePanel::tr("\u2248 %1 injections \u00B7 %2 mL/s").arg(injections).arg(plannedInjectionRate, 0, 'f', 0);
}

bool hasEnded(const InjectionStatus& injection)
{
    return injection.progress != InjectionProgress::Accepted && injection.progress != InjectionProgress::Running;
}

} // namespace

DosePanel::DosePanel(const InstrumentState& instrument, const XraySystemState& xray, QWidget* parent)
    : QFrame(parent), m_instrument(instrument), m_xray(xray)
{
    setAccessibleName(tr("Contrast and dose"));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(14, 1, 14, 1);
    column->setSpacing(0);
    m_contrastAge = addNote(tr("Contrast from the robot, never received"));
    m_xrayAge = addNote({});
    m_contrastAge->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    auto* head = new QHBoxLayout;
    head->addWidget(headingLabel(tr("Contrast and dose"), this));
    head->addStretch(1);
    head->addWidget(m_contrastAge);
    column->addLayout(head);
    column->addLayout(makeGrid(), 1);
    column->addWidget(m_xrayAge);
}

// A caption stands close above its value, and the next pair apart from it.
QGridLayout* DosePanel::makeGrid()
{
    enum Row { AboveFirst, First, FirstNote = First + 2, Between, Second, Below = Second + 2 };
    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(12);
    grid->setVerticalSpacing(0);
    for (int c = 0; c < 3; ++c)
        grid->setColumnStretch(c, 1);
    grid->setRowStretch(AboveFirst, 1);
    grid->setRowStretch(Between, 2);
    grid->setRowStretch(Below, 1);
    m_contrast = addFigure(grid, First, 0, tr("Contrast left"), QStringLiteral("000.0 mL"));
    m_injection = addFigure(grid, First, 1, tr("Last injection"), QStringLiteral("00.0 mL"));
    m_fluoroscopy = addFigure(grid, First, 2, tr("Fluoroscopy time"), QStringLiteral("00:00"));
    m_contrastBar = new ContrastBar(this);
    grid->removeWidget(m_contrast);
    auto* left = new QHBoxLayout;
    left->setSpacing(6);
    left->addWidget(m_contrast);
    left->addWidget(m_contrastBar);
    left->addStretch(1);
    grid->addLayout(left, First + 1, 0);
    m_contrastNote = addNote(stockText(QStringLiteral("00")));
    m_injectionNote = addNote(tr("%1, %2 ago").arg(word(InjectionProgress::Stopped), QStringLiteral("00:00")));
    grid->addWidget(m_contrastNote, FirstNote, 0);
    grid->addWidget(m_injectionNote, FirstNote, 1);
    m_kerma = addFigure(grid, Second, 0, tr("Air kerma"), QStringLiteral("0000.0 mGy"));
    m_kermaRate = addFigure(grid, Second, 1, tr("Kerma rate"), QStringLiteral("00.0 mGy/min"));
    m_product = addFigure(grid, Second, 2, tr("Dose-area product"), QStringLiteral("00.00 Gy·cm\u00B2"));
    return grid;
}

FigureLabel* DosePanel::addNote(const QString& widest)
{
    auto* note = new FigureLabel(this);
    theme::setTextRole(note, TextRole::Caption);
    setInk(note, colour::secondary);
    note->reserve(widest);
    return note;
}

FigureLabel* DosePanel::addFigure(QGridLayout* grid, int row, int column, const QString& caption, const QString& widest)
{
    QLabel* name = plainLabel(caption, TextRole::Caption, this);
    setInk(name, colour::secondary);
    auto* value = new FigureLabel(this);
    theme::setTextRole(value, TextRole::Value);
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
    const bool counted = left && freshness == Freshness::Fresh;
    m_contrastNote->setText(stockText(counted ? QString::number(std::floor(*left / plannedInjection)) : QStringLiteral("\u2014")));
    refreshInjection(freshness, now);
    m_contrastAge->setText(tr("Contrast from the robot, %1").arg(ageText(freshness, robot.age(now))));
}

/// A stopped one must not look like one that was given whole.
void DosePanel::refreshInjection(Freshness freshness, Instant now)
{
    const auto& injections = m_instrument.injections();
    const auto& heard = m_instrument.injectionHeard();
    if (injections.empty() || !heard) {
        m_injection->setText(figure(std::nullopt, 1, tr("mL")));
        setInk(m_injection, colour::secondary);
        m_injectionNote->setText({});
        return;
    }
    const InjectionStatus& last = injections.back();
    m_injection->setText(figure(last.delivered, 1, tr("mL")));
    setInk(m_injection, valueInk(freshness));
    const QString age = clockDuration(now - *heard);
    m_injectionNote->setText(hasEnded(last) ? tr("%1, %2 ago").arg(word(last.progress), age) : word(last.progress));
    m_injectionNote->setToolTip(last.reason.isEmpty() ? QString() : QStringLiteral("<qt>%1</qt>").arg(last.reason.toHtmlEscaped()));
    setInk(m_injectionNote, last.progress == InjectionProgress::Done ? colour::secondary : colour::bright);
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
    m_xrayAge->setText(tr("Repeated from the X-ray system, %1").arg(ageText(freshness, status.age(now))));
}

} // namespace console
