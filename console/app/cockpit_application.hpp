// Makes every object of the console and connects the rooms.
#pragma once

#include "app/alarm_service.hpp"
#include "app/cockpit_control.hpp"
#include "app/command_line.hpp"
#include "app/hand_desk.hpp"
#include "app/log_saver.hpp"
#include "app/picture_desk.hpp"
#include "app/preference_desk.hpp"
#include "app/screen_desk.hpp"
#include "app/unattended_run.hpp"
#include "app/view_desk.hpp"
#include "link/system_link.hpp"
#include "model/console_models.hpp"
#include "seat/seat_watch.hpp"

#include <QObject>
#include <QTimer>

#include <memory>

namespace console {

class CockpitWindow;
class SceneView;

class CockpitApplication : public QObject {
    Q_OBJECT
public:
    explicit CockpitApplication(const Options& options);
    ~CockpitApplication() override;

    /// Sounds in place of the loudspeaker, for measurements; before prepare(). It must outlive this object.
    void setVoice(AlarmVoice& voice) { m_voice = &voice; }

    /// Keys and mouse come from elsewhere by this way, whatever the session says of itself; empty: they are this computer's. For tests.
    void setInputOrigin(const QString& way) { m_models.remoteInput = way; }

    /// Who is asked whether somebody sees the screen, in place of this computer's session; before prepare(). For tests.
    void setSeat(const SeatBuses& seat) { m_seat = seat; }

    /// What the signals of an alarm self-test that runs take has passed: it asks whether they were seen and heard. For tests.
    void skipTestSignals();

    /// Reads the files and takes the port; false with one sentence in `error` when it cannot.
    bool prepare(QString* error);

    /// Takes part in the system and shows the window; the caller runs the event loop.
    void show();

    /// Shows the window and runs until it is closed, or the unattended run ends; the program's status.
    int run();

    CockpitWindow& window() { return *m_window; }
    const ConsoleModels& models() const { return m_models; }

private:
    bool rehearsesHere(QString* error) const;
    void buildAlarms();
    void buildWindow();
    void buildTopology();
    void buildLog();
    void connectIntents();
    void connectAlarms();
    void connectHand();
    void connectPictures();
    void connectSeat();
    void endWithTheCockpit();
    void refreshScene();
    void showWindow();

    // In the order in which they need one another: what stands below uses what stands above, and goes first.
    Options m_options;
    AlarmVoice* m_voice = nullptr;
    SeatBuses m_seat;
    ConsoleModels m_models;
    PictureDesk m_pictures;
    HandDesk m_hand;
    std::unique_ptr<SystemLink> m_link;
    std::unique_ptr<CockpitControl> m_control;
    std::unique_ptr<AlarmService> m_alarms;
    LogSaver m_logSaver;
    LogSaver m_reportSaver;
    ViewDesk m_views{m_options, m_models};
    PreferenceDesk m_preferences{m_options, m_models, m_pictures};
    std::unique_ptr<CockpitWindow> m_window;
    std::unique_ptr<ScreenDesk> m_screens;
    std::unique_ptr<SeatWatch> m_seatWatch;
    SceneView* m_scene = nullptr; ///< the window's
    QTimer m_sceneClock;
    std::unique_ptr<UnattendedRun> m_unattended;
};

} // namespace console
