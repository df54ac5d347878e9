// Operates the console as a person would, measures, and reports.
#pragma once

#include "app/command_line.hpp"
#include "link/system_link.hpp"
#include "model/console_models.hpp"
#include "model/measurements.hpp"

#include <QObject>
#include <QTimer>

class QAbstractButton;

namespace console {

class CockpitWindow;

/// By the same buttons and keys that a person has. Each step has its deadline; the first that is missed ends the run.
///
///   Show ──► Open ──► Image ──► Arm ──► Engage ──► Jog ──► done
///
/// The alarm self-test goes on beside the first three. It is confirmed though nobody saw or heard it, and the report says so.
class UnattendedRun : public QObject {
    Q_OBJECT
public:
    UnattendedRun(CockpitWindow& window, ConsoleModels& models, SystemLink& link, const UnattendedSettings& settings,
                  QObject* parent = nullptr);

    void start();

Q_SIGNALS:
    /// 0: all of it worked; 1: `failure` says what did not.
    void finished(int status, const QString& failure);

private:
    enum class Step { Show, Open, Image, Arm, Engage, Jog, Done };

    void proceed();
    void enter(Step step);
    void show();
    void open();
    void image();
    void arm();
    void engage();
    void jog();
    void finish(const QString& failure);
    void gather();
    QString save() const;

    bool clickOpenAll();
    void clickSelfTest();
    void sendKey(int key, bool press);
    Duration inStep() const;

    CockpitWindow& m_window;
    ConsoleModels& m_models;
    SystemLink& m_link;
    UnattendedSettings m_settings;
    Measurements m_measurements;
    QTimer m_timer;
    Step m_step = Step::Show;
    Instant m_entered;
    Instant m_lastClick;
    bool m_measuring = false;
    quint64 m_framesBefore = 0;
    quint64 m_commandsBefore = 0;
};

} // namespace console
