// The strip's fields from left to right, and its two marks.
#include "widgets/status_strip.hpp"

#include "widgets/icons.hpp"
#include "widgets/labels.hpp"
#include "widgets/small_button.hpp"
#include "widgets/theme.hpp"

#include <QHBoxLayout>
#include <QPainter>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

Mode modeOf(PermitPhase phase)
{
    switch (phase) {
    case PermitPhase::Ready:
    case PermitPhase::Arming:
        return Mode::Ready;
    case PermitPhase::Armed:
        return Mode::Armed;
    case PermitPhase::Engaged:
        return Mode::Engaged;
    case PermitPhase::Hold:
    case PermitPhase::Incident: // not the calm STANDBY, which would also be read as a lost link's stand-by
    case PermitPhase::Verifying:
        return Mode::Hold;
    case PermitPhase::Off:
    case PermitPhase::Standby:
        break;
    }
    return Mode::Standby;
}

QString modeWord(Mode mode)
{
    switch (mode) {
    case Mode::Standby:
        return StatusStrip::tr("STANDBY");
    case Mode::Ready:
        return StatusStrip::tr("READY");
    case Mode::Armed:
        return StatusStrip::tr("ARMED");
    case Mode::Engaged:
        return StatusStrip::tr("ENGAGED");
    case Mode::Hold:
        return StatusStrip::tr("HOLD");
    }
    return {};
}

namespace {

constexpr double widestOfNames = 280; ///< px at the reference
constexpr double leastOfNames = 90;

} // namespace

void NameLabel::setParts(const QString& before, const QString& name, const QString& after)
{
    m_before = before;
    m_name = name;
    m_after = after;
    setText(before + name + after);
    setToolTip(name.isEmpty() ? QString() : QStringLiteral("<qt>%1</qt>").arg(text().toHtmlEscaped()));
}

double NameLabel::keptWidth() const { return figuresWidth(font(), m_before) + figuresWidth(font(), m_after); }

QSize NameLabel::sizeWith(double nameWidth) const
{
    const QSize asked = FigureLabel::sizeHint();
    if (m_name.isEmpty())
        return asked;
    const double name = std::min(figuresWidth(font(), m_name), nameWidth);
    return {int(std::ceil(keptWidth() + name)) + 1, asked.height()};
}

QSize NameLabel::sizeHint() const { return sizeWith(theme::px(this, widestOfNames)); }

QSize NameLabel::minimumSizeHint() const { return sizeWith(theme::px(this, leastOfNames)); }

void NameLabel::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setFont(font());
    painter.setPen(palette().color(foregroundRole()));
    const double room = contentsRect().width() - keptWidth();
    const QString name =
        figuresWidth(font(), m_name) <= room ? m_name : QFontMetricsF(font()).elidedText(m_name, Qt::ElideRight, room * 0.96);
    drawFigures(painter, contentsRect(), alignment(), m_before + name + m_after);
}

StripField::StripField(const QString& caption, const QString& widest, QWidget* parent) : QWidget(parent), m_value(new NameLabel(this))
{
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    QLabel* name = plainLabel(caption, TextRole::Caption, this);
    setInk(name, colour::secondary);
    theme::setTextRole(m_value, TextRole::Strong);
    m_value->reserve(widest);
    column->addStretch();
    column->addWidget(name);
    column->addWidget(m_value);
    column->addStretch();
    setAccessibleName(caption);
}

void StripField::setValue(const QString& before, const QString& name, const QString& after)
{
    const QString value = before + name + after;
    if (value == m_value->text())
        return;
    m_value->setParts(before, name, after);
    m_value->setAccessibleName(accessibleName() + QStringLiteral(": ") + value);
}

XrayMark::XrayMark(QWidget* parent) : QWidget(parent)
{
    theme::setTextRole(this, TextRole::Title);
    setAccessibleName(tr("X-ray beam"));
    setAccessibleDescription(words());
}

QString XrayMark::words() const
{
    switch (m_beam) {
    case Beam::On:
        return tr("X-RAY ON");
    case Beam::Off:
        return tr("X-ray off");
    case Beam::Unknown:
        return tr("X-ray unknown");
    }
    return {};
}

void XrayMark::setBeam(Beam beam)
{
    if (beam == m_beam)
        return;
    m_beam = beam;
    setAccessibleDescription(words());
    update();
}

QSize XrayMark::sizeHint() const
{
    const QFontMetrics metrics(font());
    const int words = std::max({metrics.horizontalAdvance(tr("X-RAY ON")), metrics.horizontalAdvance(tr("X-ray off")),
                                metrics.horizontalAdvance(tr("X-ray unknown"))});
    return {words + 2 * metrics.height() + theme::px(this, 20), metrics.height() * 2};
}

void XrayMark::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QFontMetricsF metrics(font());
    const QRectF box = QRectF(rect()).adjusted(1, height() * 0.14, -1, -height() * 0.14);
    const bool on = m_beam == Beam::On;
    painter.setPen(QPen(on ? colour::xray : colour::line, 1.2, m_beam == Beam::Unknown ? Qt::DashLine : Qt::SolidLine));
    painter.setBrush(on ? QBrush(colour::xray) : QBrush(Qt::NoBrush));
    painter.drawRoundedRect(box, 4, 4);
    const QColor ink = on ? colour::onAlarm : colour::secondary;
    const double side = metrics.height() * 1.1;
    const double gap = theme::px(this, 10);
    icons::draw(painter, QRectF(box.left() + gap, box.center().y() - side / 2, side, side), icons::Icon::Xray, ink);
    painter.setPen(ink);
    painter.drawText(box.adjusted(2 * gap + side - gap / 2, 0, -gap / 2, 0), Qt::AlignLeft | Qt::AlignVCenter, words());
}

ModeMark::ModeMark(QWidget* parent) : QWidget(parent)
{
    theme::setTextRole(this, TextRole::Alarm);
    setAccessibleName(tr("Mode"));
    setAccessibleDescription(modeWord(m_mode));
}

void ModeMark::setMode(Mode mode)
{
    if (mode == m_mode)
        return;
    m_mode = mode;
    setAccessibleDescription(modeWord(mode));
    update();
}

QSize ModeMark::sizeHint() const
{
    const QFontMetrics metrics(font());
    int widest = 0;
    for (const Mode mode : {Mode::Standby, Mode::Ready, Mode::Armed, Mode::Engaged, Mode::Hold})
        widest = std::max(widest, metrics.horizontalAdvance(modeWord(mode)));
    return {widest + theme::px(this, 44), metrics.height()};
}

void ModeMark::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF box = QRectF(rect()).adjusted(1, height() * 0.1, -1, -height() * 0.1);
    const bool engaged = m_mode == Mode::Engaged;
    const bool armed = m_mode == Mode::Armed;
    painter.setPen(QPen(engaged || armed ? colour::armed : colour::strongLine, m_mode == Mode::Hold ? 3 : 1.6));
    painter.setBrush(engaged ? colour::armed : armed ? colour::armedSurface : colour::panel);
    painter.drawRoundedRect(box, 4, 4);
    painter.setFont(font());
    painter.setPen(engaged ? colour::onAlarm : armed ? colour::armed : colour::bright);
    painter.drawText(box, Qt::AlignCenter, modeWord(m_mode));
}

StatusStrip::StatusStrip(QWidget* parent)
    : QFrame(parent),
      m_patient(new StripField(tr("Patient"), {}, this)),
      m_procedure(new StripField(tr("Procedure"), QStringLiteral("00:00:00"), this)),
      m_topology(new StripField(tr("System"), {}, this)),
      m_role(new StripField(tr("Operator"), {}, this)),
      m_recorder(new StripField(tr("Recorder"), {}, this)),
      m_clock(new StripField(tr("Local time"), QStringLiteral("00:00:00"), this)),
      m_xray(new XrayMark(this)),
      m_mode(new ModeMark(this))
{
    setAccessibleName(tr("Status strip"));
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(12, 0, 8, 0);
    row->setSpacing(22);
    m_notice = plainLabel(tr("RESEARCH SYSTEM\nNOT A MEDICAL DEVICE"), TextRole::Caption, this);
    m_notice->setAccessibleName(tr("Research system, not a medical device"));
    setPatient({}, {});
    for (StripField* field : {m_patient, m_procedure, m_topology, m_role, m_recorder, m_clock})
        row->addWidget(field);
    row->addStretch(1);
    row->addWidget(m_notice);
    auto* about =
        new SmallButton(tr("About"), tr("About this software"), tr("What this is, its version, and the licences of its parts"), this);
    connect(about, &QPushButton::clicked, this, &StatusStrip::aboutRequested);
    row->addWidget(about);
    row->addWidget(m_xray);
    row->addWidget(m_mode);
    setProcedureTime(std::nullopt);
    setTopology({}, {});
    setRole({}, OperatorRole::Operator);
    setRecorder(false);
    setWallClock(QStringLiteral("--:--:--"), std::nullopt);
}

void StatusStrip::setTopology(const QString& name, const QString& hash)
{
    if (name.isEmpty())
        return m_topology->setValue(tr("None loaded"));
    m_topology->setValue({}, name, QStringLiteral("  ") + hash.left(6));
}

void StatusStrip::setPatient(const QString& name, const QString& id)
{
    if (name.isEmpty())
        return m_patient->setValue(tr("Not named"));
    m_patient->setValue(id + QStringLiteral(" \u00B7 "), name, {});
}

void StatusStrip::setRole(const QString& user, OperatorRole role)
{
    const QString as = QStringLiteral(" \u00B7 ") + word(role);
    if (user.isEmpty())
        return m_role->setValue(tr("Not signed in") + as);
    m_role->setValue({}, user, as);
}

void StatusStrip::setRecorder(bool keeps) { m_recorder->setValue(keeps ? tr("Alarm log") : tr("Stopped")); }

void StatusStrip::setRehearsal(bool rehearsal)
{
    m_notice->setText(rehearsal ? tr("REHEARSAL, RECORDED PICTURE\nNOT A MEDICAL DEVICE") : tr("RESEARCH SYSTEM\nNOT A MEDICAL DEVICE"));
    m_notice->setAccessibleName(rehearsal ? tr("Rehearsal with a recorded picture, not a medical device")
                                          : tr("Research system, not a medical device"));
}

void StatusStrip::setWallClock(const QString& time, std::optional<std::chrono::nanoseconds> uncertainty)
{
    const auto known = uncertainty ? QStringLiteral("\u00B1%1").arg(figure(milliseconds(*uncertainty), 1, tr("ms"))) : tr("not compared");
    m_clock->setValue(QStringLiteral("%1 %2").arg(time, known));
}

void StatusStrip::setProcedureTime(std::optional<std::chrono::nanoseconds> elapsed)
{
    m_procedure->setValue(elapsed ? clockDuration(*elapsed) : tr("Not started"));
}

} // namespace console
