// Region A: who, what, since when, with whom, and in which mode.
#pragma once

#include "model/motion_permit.hpp"
#include "widgets/figures.hpp"

#include <QFrame>

#include <chrono>
#include <optional>

namespace console {

/// The mode word of the strip; several phases of the motion permit share one.
enum class Mode { Standby, Ready, Armed, Engaged, Hold };

Mode modeOf(PermitPhase phase);
QString modeWord(Mode mode);

/// A name between what is never cut. The name has bounds, and gives way when the row is full; the whole is in the tool tip.
class NameLabel : public FigureLabel {
    Q_OBJECT
public:
    using FigureLabel::FigureLabel;

    void setParts(const QString& before, const QString& name, const QString& after);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    double keptWidth() const;
    QSize sizeWith(double nameWidth) const;

    QString m_before, m_name, m_after;
};

/// A caption above a value; the value is plain text.
class StripField : public QWidget {
    Q_OBJECT
public:
    StripField(const QString& caption, const QString& widest, QWidget* parent = nullptr);
    void setValue(const QString& value) { setValue({}, {}, value); }
    /// Of which `name` alone may be cut.
    void setValue(const QString& before, const QString& name, const QString& after);
    QString value() const { return m_value->text(); }

private:
    NameLabel* m_value;
};

/// What the strip says about the X-ray beam.
enum class Beam { Unknown, Off, On };

class XrayMark : public QWidget {
    Q_OBJECT
public:
    explicit XrayMark(QWidget* parent = nullptr);
    void setBeam(Beam beam);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QString words() const;
    Beam m_beam = Beam::Unknown;
};

class ModeMark : public QWidget {
    Q_OBJECT
public:
    explicit ModeMark(QWidget* parent = nullptr);
    void setMode(Mode mode);
    Mode mode() const { return m_mode; }
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    Mode m_mode = Mode::Standby;
};

class StatusStrip : public QFrame {
    Q_OBJECT
public:
    explicit StatusStrip(QWidget* parent = nullptr);

    void setTopology(const QString& name, const QString& hash);
    /// Two identifiers; the second is always whole. Empty: nobody is named.
    void setPatient(const QString& name, const QString& id);
    void setRole(const QString& user, OperatorRole role);
    /// What is written down of the procedure.
    void setRecorder(bool keeps);
    /// A recording stands for the live picture: said where the notice of a research system stands.
    void setRehearsal(bool rehearsal);
    /// `uncertainty`: by which the patient side's clock is known here; nothing: it is not.
    void setWallClock(const QString& time, std::optional<std::chrono::nanoseconds> uncertainty);
    /// Time since the first channel was opened; nothing before.
    void setProcedureTime(std::optional<std::chrono::nanoseconds> elapsed);
    void setBeam(Beam beam) { m_xray->setBeam(beam); }
    void setMode(Mode mode) { m_mode->setMode(mode); }
    Mode mode() const { return m_mode->mode(); }

Q_SIGNALS:
    void aboutRequested();

private:
    QLabel* m_notice;
    StripField* m_patient;
    StripField* m_procedure;
    StripField* m_topology;
    StripField* m_role;
    StripField* m_recorder;
    StripField* m_clock;
    XrayMark* m_xray;
    ModeMark* m_mode;
};

} // namespace console
