// A robot, an X-ray system and an arm in this process that do what a test says, lies included.
#pragma once

#include "test_system.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <random>
#include <set>
#include <vector>

namespace liena::test {

/// Arms, moves and holds as the reference robot does, until it is told to lie. Any thread.
class PuppetRobot {
public:
    /// The numbers of the robot's message set.
    enum class State : std::uint8_t { Off, Hold, Ready, Armed, Engaged, EmergencyStop, Fault };

    struct Claim {
        State state = State::Ready;
        std::uint32_t permitsAhead = 0; ///< of the true permit
        bool holdConfirmed = true;
    };

    explicit PuppetRobot(Settings settings);

    /// Its reports say that from now on, whatever it does; nothing: the truth again.
    void claim(std::optional<Claim> claim);
    void setSilent(bool silent);    ///< its reports end, its session stands
    void setTipSilent(bool silent); ///< only those of its tracker
    void setForce(double newtons);
    void setInjector(bool stuck); ///< an injection that begins while it is runs until it is not, or nothing is left
    void setContrast(double millilitres);

    /// Changes each report before it is sent: its own fields, or those of TipPose or of DriveStatus. Network thread; empty: nothing is
    /// changed.
    using Alter = std::function<void(Message&)>;
    void alterStatus(Alter alter);
    void alterTip(Alter alter);
    void alterDrives(Alter alter);

    /// One command that moved it.
    struct Movement {
        std::chrono::nanoseconds engagedFor; ///< since the first command of its engagement arrived
        double velocity = 0;                 ///< of the guidewire, mm/s
    };
    /// Of the newest engagement, and of its first seconds only.
    std::vector<Movement> newestMovements() const;
    double fastest() const; ///< mm/s, of the guidewire, either way: of all that were asked of it so far

    /// Its network thread does nothing for so long: no report, no heartbeat.
    void standStill(std::chrono::milliseconds time);

    int armRequests() const;                  ///< asked of it so far
    int movements() const;                    ///< commands that moved it
    std::vector<std::uint64_t> stops() const; ///< tokens of the emergency stops that it heard, repeats included
    int injections() const;                   ///< asked of it so far, each number once
    int engagedAtRest() const;                ///< accepted commands with the dead-man pressed and no velocity
    std::uint64_t turns() const;              ///< reports that were due so far: its clock, ten milliseconds each
    std::uint32_t permit() const;             ///< the true one

private:
    void build(DistributedSystem& system);
    void turn(DistributedSystem& system);
    void hold();
    void onPermit(const Message& message);
    void onMotion(const Message& message);
    void onInjection(DistributedSystem& system, const Message& message);
    void tellInjection(DistributedSystem& system);

    mutable std::mutex m_mutex;
    State m_state = State::Hold;
    std::uint32_t m_permit = 1000;
    std::uint32_t m_owner = 0; ///< who has armed it; 0 while nobody has
    std::uint64_t m_stop = 0;
    std::vector<std::uint64_t> m_stops; ///< heard so far
    std::uint64_t m_turns = 0;
    std::uint64_t m_heldSince = 0; ///< turn
    std::uint64_t m_commandedAt = 0;
    double m_position = 800;
    double m_force = 0;
    double m_contrast = 80;
    bool m_silent = false;
    bool m_tipSilent = false;
    bool m_injectorStuck = false;
    std::optional<std::uint32_t> m_injecting; ///< its number
    std::optional<Claim> m_claim;
    Alter m_alterStatus;
    Alter m_alterTip;
    Alter m_alterDrives;
    std::chrono::steady_clock::time_point m_engagedAt;
    std::vector<Movement> m_newest;
    double m_fastest = 0;
    int m_armRequests = 0;
    int m_movements = 0;
    std::set<std::uint32_t> m_injections;
    int m_engagedAtRest = 0;
    TestDevice m_device; ///< last: its thread uses all of the above
};

/// Fifteen pictures a second of noise while the pedal is down. Any thread.
class PuppetXray {
public:
    enum class Pictures : std::uint8_t {
        Good,
        None,     ///< beam on, and nothing comes
        Repeated, ///< new numbers and times, the same bytes
        Recorded,
        Old,     ///< taken a second before they are sent
        Filled,  ///< good, with contrast in a vessel across the middle
        Stamped, ///< good, with its number written into its pixels: StampStrip
    };

    /// Where a stamped picture bears the lowest bits of its number: upright bars of equal width from its left, white for 1, the lowest
    /// first.
    struct StampStrip {
        static constexpr int bits = 12;
        static constexpr double barWidth = 5.0 / 64; ///< of the picture's width
        static constexpr double middle = 22.0 / 64;  ///< of its height
    };

    explicit PuppetXray(Settings settings);

    void show(Pictures pictures);

    /// When a picture was taken; nothing for one that was not stamped.
    std::optional<std::chrono::steady_clock::time_point> takenAt(std::uint32_t frame) const;

    /// Changes each AcquisitionStatus, or each picture, before it is sent. Network thread; empty: nothing is changed.
    using Alter = std::function<void(Message&)>;
    void alterStatus(Alter alter);
    void alterFrame(Alter alter);

    void movePatient(unsigned columns); ///< from where the first pictures show the bones

    void setBeam(bool always); ///< on, whoever has its pedal

    int pedalsHeard() const;     ///< commands so far whose pedal is down
    std::uint64_t turns() const; ///< reports that were due so far: its clock, 50 ms each

    /// Its network thread does nothing for so long: no picture, no heartbeat.
    void standStill(std::chrono::milliseconds time);

private:
    void build(DistributedSystem& system);
    void sendPicture(DistributedSystem& system);
    void sendStatus(DistributedSystem& system);
    bool beamOn() const;

    mutable std::mutex m_mutex;
    Pictures m_pictures = Pictures::Good;
    Alter m_alterStatus;
    Alter m_alterFrame;
    unsigned m_patient = 0; ///< columns
    bool m_always = false;
    bool m_pedal = false;
    int m_pedalsHeard = 0;
    std::uint64_t m_turns = 0;
    std::chrono::steady_clock::time_point m_commandedAt;
    std::uint32_t m_press = 0;
    std::uint32_t m_frame = 0;
    std::map<std::uint32_t, std::chrono::steady_clock::time_point> m_taken; ///< stamped ones, by number
    std::mt19937 m_random{1};
    std::vector<std::byte> m_pixels;
    TestDevice m_device; ///< last
};

/// A robotic arm that stands and reports. Any thread.
class PuppetArm {
public:
    explicit PuppetArm(Settings settings);

    void setFault(bool fault) { m_fault = fault; }

private:
    std::atomic<bool> m_fault{false};
    TestDevice m_device; ///< last
};

} // namespace liena::test
