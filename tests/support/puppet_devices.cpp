// A robot, an X-ray system and an arm that do what a test says.
#include "puppet_devices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <thread>

namespace liena::test {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds turnLength{10};
constexpr std::uint64_t leastHold = 20; ///< turns
constexpr std::uint64_t silence = 50;   ///< turns without a command; longer than the reference robot's, for sanitizers
constexpr double commandLength = 0.002; ///< s
constexpr double firstPlace = 800;      ///< mm
constexpr double lastPlace = 1500;
constexpr std::chrono::seconds movementsKept{5}; ///< of an engagement
constexpr milliseconds pedalLease{400};
constexpr std::uint16_t edge = 64;
constexpr int vesselRows = 3;
constexpr int stripRows = 9;

/// What the noise lies over, in squares of four pixels: the same in each picture, as long as nobody moves. From 0 to 63.
unsigned bone(std::size_t column, std::size_t row)
{
    constexpr std::size_t square = 4;
    static const auto bones = [] {
        std::array<unsigned, edge / square*(edge / square)> all{};
        std::generate(all.begin(), all.end(), [random = std::mt19937(7)]() mutable { return unsigned(random() & 63U); });
        return all;
    }();
    return bones[row / square * (edge / square) + column % edge / square];
}

void stamp(std::vector<std::byte>& pixels, std::uint32_t number)
{
    using Strip = PuppetXray::StampStrip;
    constexpr int width = int(Strip::barWidth * edge);
    constexpr int first = int(Strip::middle * edge) - stripRows / 2;
    for (int row = first; row < first + stripRows; ++row)
        for (int column = 0; column < Strip::bits * width; ++column)
            pixels[std::size_t(row * edge + column)] = std::byte((number >> unsigned(column / width) & 1U) != 0 ? 255 : 0);
}

void orThrow(const Result<void>& result)
{
    if (!result)
        throw std::runtime_error(result.error().what);
}

} // namespace

PuppetRobot::PuppetRobot(Settings settings) : m_device(std::move(settings), [this](DistributedSystem& system) { build(system); }) {}

void PuppetRobot::build(DistributedSystem& system)
{
    orThrow(system.subscribe("PermitRequest", [this](const Message& message) { onPermit(message); }));
    orThrow(system.subscribe("ContrastInjection", [this, &system](const Message& message) { onInjection(system, message); }));
    orThrow(system.subscribe("MotionCommand", [this](const Message& message) { onMotion(message); }));
    orThrow(system.subscribe("EmergencyStop", [this](const Message& message) {
        const std::lock_guard lock(m_mutex);
        hold();
        m_state = State::EmergencyStop;
        m_stop = message.get<std::uint64_t>("token");
        m_stops.push_back(m_stop);
    }));
    orThrow(system.subscribe("ResetEmergencyStop", [this](const Message& message) {
        const std::lock_guard lock(m_mutex);
        if (m_state == State::EmergencyStop && message.get<std::uint64_t>("token") == m_stop)
            hold();
    }));
    system.subscribe([this](const SessionEvent& event) {
        const std::lock_guard lock(m_mutex);
        const bool interrupted = event.kind == SessionEvent::Kind::Interrupted;
        if (interrupted || (event.kind == SessionEvent::Kind::StateChanged && !carriesMessages(event.to)))
            hold();
    });
    system.every(turnLength, [this, &system] { turn(system); });
}

/// Whatever it did: it stands still, and the permit is a new one.
void PuppetRobot::hold()
{
    m_state = State::Hold;
    m_owner = 0;
    m_stop = 0;
    ++m_permit;
    m_heldSince = m_turns;
}

void PuppetRobot::onPermit(const Message& message)
{
    const std::lock_guard lock(m_mutex);
    const bool present = message.get<std::uint32_t>("permit") == m_permit;
    if (message.get<std::string_view>("request") == "arm") {
        ++m_armRequests;
        if (present && m_state == State::Ready) {
            m_state = State::Armed;
            m_owner = message.origin().value();
            m_commandedAt = m_turns + 2 * silence; // its first command may take a while
        }
    } else if (present && (m_state == State::Armed || m_state == State::Engaged)) {
        hold();
    }
}

void PuppetRobot::onMotion(const Message& message)
{
    const std::lock_guard lock(m_mutex);
    const bool armed = m_state == State::Armed || m_state == State::Engaged;
    if (!armed || message.get<std::uint32_t>("permit") != m_permit)
        return;
    m_commandedAt = m_turns;
    const bool engaged = message.get<bool>("engaged");
    const bool anew = engaged && m_state == State::Armed;
    m_state = engaged ? State::Engaged : State::Armed;
    const double velocity = message.get<double>("guidewire_velocity");
    if (!engaged)
        return;
    if (anew) {
        m_engagedAt = message.arrival();
        m_newest.clear();
    }
    ++(velocity == 0 ? m_engagedAtRest : m_movements);
    if (velocity != 0 && message.arrival() - m_engagedAt < movementsKept)
        m_newest.push_back({message.arrival() - m_engagedAt, velocity});
    m_fastest = std::max(m_fastest, std::abs(velocity));
    m_position += velocity * commandLength;
    if (m_position > lastPlace || m_position < 0)
        m_position = firstPlace; // a report of a place that its set does not know would not be sent
}

void PuppetRobot::onInjection(DistributedSystem& system, const Message& message)
{
    Message report = system.report("InjectionReport").value();
    const auto number = message.get<std::uint32_t>("injection");
    {
        const std::lock_guard lock(m_mutex);
        const bool armed = m_state == State::Armed || m_state == State::Engaged;
        const bool permitted = armed && message.get<std::uint32_t>("permit") == m_permit;
        m_injections.insert(number);
        if (permitted && m_injectorStuck)
            m_injecting = number;
        report.set("injection", number).set("delivered", permitted && !m_injecting ? message.get<double>("volume") : 0.0);
        report.set("state", std::string_view(m_injecting ? "running" : permitted ? "done" : "refused"));
    }
    system.publish(report);
}

/// Of one that takes its time.
void PuppetRobot::tellInjection(DistributedSystem& system)
{
    Message report = system.report("InjectionReport").value();
    {
        const std::lock_guard lock(m_mutex);
        if (!m_injecting)
            return;
        const bool runs = m_injectorStuck && m_contrast > 0;
        report.set("injection", *m_injecting).set("state", std::string_view(runs ? "running" : "stopped"));
        if (!runs)
            m_injecting.reset();
    }
    system.publish(report);
}

void PuppetRobot::turn(DistributedSystem& system)
{
    tellInjection(system);
    Message status = system.report("RobotStatus").value();
    Message tip = system.report("TipPose").value();
    Message drives = system.report("DriveStatus").value();
    bool tracked = false;
    {
        const std::lock_guard lock(m_mutex);
        ++m_turns;
        const bool armed = m_state == State::Armed || m_state == State::Engaged;
        if (armed && m_turns > m_commandedAt + silence)
            hold();
        if (m_state == State::Hold && m_turns > m_heldSince + leastHold)
            m_state = State::Ready;
        if (m_silent)
            return;
        tracked = !m_tipSilent;
        const Claim told = m_claim.value_or(Claim{m_state, 0, !armed});
        status.set("state", told.state).set("permit", m_permit + told.permitsAhead).set("hold_confirmed", told.holdConfirmed);
        status.set("owner", m_owner);
        status.set("engaged", told.state == State::Engaged).set("emergency_stop_token", m_stop);
        status.set("guidewire_position", m_position).set("guidewire_force", m_force).set("contrast_remaining", m_contrast);
        tip.set("valid", true).set("position", std::vector<double>{0, 0, m_position}).set("quaternion", std::vector<double>{1, 0, 0, 0});
        drives.set("temperature", std::vector<double>(4, 30)).set("enabled", std::vector<double>(4, armed ? 1 : 0));
        if (m_alterStatus)
            m_alterStatus(status);
        if (m_alterTip)
            m_alterTip(tip);
        if (m_alterDrives)
            m_alterDrives(drives);
    }
    system.publish(status);
    if (tracked)
        system.publish(tip);
    system.publish(drives);
}

void PuppetRobot::claim(std::optional<Claim> claim)
{
    const std::lock_guard lock(m_mutex);
    m_claim = claim;
}

void PuppetRobot::setSilent(bool silent)
{
    const std::lock_guard lock(m_mutex);
    m_silent = silent;
}

void PuppetRobot::setTipSilent(bool silent)
{
    const std::lock_guard lock(m_mutex);
    m_tipSilent = silent;
}

void PuppetRobot::setForce(double newtons)
{
    const std::lock_guard lock(m_mutex);
    m_force = newtons;
}

void PuppetRobot::setInjector(bool stuck)
{
    const std::lock_guard lock(m_mutex);
    m_injectorStuck = stuck;
}

void PuppetRobot::setContrast(double millilitres)
{
    const std::lock_guard lock(m_mutex);
    m_contrast = millilitres;
}

void PuppetRobot::alterStatus(Alter alter)
{
    const std::lock_guard lock(m_mutex);
    m_alterStatus = std::move(alter);
}

void PuppetRobot::alterTip(Alter alter)
{
    const std::lock_guard lock(m_mutex);
    m_alterTip = std::move(alter);
}

void PuppetRobot::alterDrives(Alter alter)
{
    const std::lock_guard lock(m_mutex);
    m_alterDrives = std::move(alter);
}

std::vector<PuppetRobot::Movement> PuppetRobot::newestMovements() const
{
    const std::lock_guard lock(m_mutex);
    return m_newest;
}

double PuppetRobot::fastest() const
{
    const std::lock_guard lock(m_mutex);
    return m_fastest;
}

void PuppetRobot::standStill(std::chrono::milliseconds time)
{
    m_device->post([time] { std::this_thread::sleep_for(time); });
}

int PuppetRobot::armRequests() const
{
    const std::lock_guard lock(m_mutex);
    return m_armRequests;
}

std::vector<std::uint64_t> PuppetRobot::stops() const
{
    const std::lock_guard lock(m_mutex);
    return m_stops;
}

int PuppetRobot::injections() const
{
    const std::lock_guard lock(m_mutex);
    return static_cast<int>(m_injections.size());
}

int PuppetRobot::movements() const
{
    const std::lock_guard lock(m_mutex);
    return m_movements;
}

int PuppetRobot::engagedAtRest() const
{
    const std::lock_guard lock(m_mutex);
    return m_engagedAtRest;
}

std::uint64_t PuppetRobot::turns() const
{
    const std::lock_guard lock(m_mutex);
    return m_turns;
}

std::uint32_t PuppetRobot::permit() const
{
    const std::lock_guard lock(m_mutex);
    return m_permit;
}

PuppetXray::PuppetXray(Settings settings) : m_device(std::move(settings), [this](DistributedSystem& system) { build(system); }) {}

void PuppetXray::build(DistributedSystem& system)
{
    orThrow(system.subscribe("AcquisitionCommand", [this](const Message& message) {
        const std::lock_guard lock(m_mutex);
        m_pedal = message.get<bool>("pedal");
        m_pedalsHeard += m_pedal ? 1 : 0;
        m_press = message.get<std::uint32_t>("press");
        m_commandedAt = message.arrival();
    }));
    system.every(milliseconds(66), [this, &system] { sendPicture(system); });
    system.every(milliseconds(50), [this, &system] { sendStatus(system); });
}

bool PuppetXray::beamOn() const { return m_always || (m_pedal && std::chrono::steady_clock::now() - m_commandedAt <= pedalLease); }

void PuppetXray::sendPicture(DistributedSystem& system)
{
    Message frame = system.report("XrayFrame").value();
    {
        const std::lock_guard lock(m_mutex);
        if (!beamOn() || m_pictures == Pictures::None)
            return;
        if (m_pictures != Pictures::Repeated || m_pixels.empty()) {
            m_pixels.resize(std::size_t{edge} * edge);
            for (std::size_t at = 0; at < m_pixels.size(); ++at)
                m_pixels[at] = static_cast<std::byte>(80 + bone(at % edge + m_patient, at / edge) + (m_random() & 31U));
            if (m_pictures == Pictures::Filled)
                std::fill_n(m_pixels.begin() + std::ptrdiff_t{edge / 2} * edge, vesselRows * edge, std::byte{20});
        }
        const auto age = m_pictures == Pictures::Old ? milliseconds(1000) : milliseconds(5);
        frame.set("frame", ++m_frame).set("acquisition", m_press);
        if (m_pictures == Pictures::Stamped) {
            stamp(m_pixels, m_frame);
            m_taken[m_frame] = std::chrono::steady_clock::now() - age;
        }
        frame.set("capture_ns", Timestamp::now().ns - static_cast<std::uint64_t>(std::chrono::nanoseconds(age).count()));
        frame.set("source", std::string_view(m_pictures == Pictures::Recorded ? "recorded" : "simulated"));
        frame.set("rows", edge).set("columns", edge).set("bits_stored", 8).set("window_centre", 128.0).set("window_width", 256.0);
        frame.set("photometric", std::string_view("MONOCHROME2"));
        frame.set("pixels", std::span<const std::byte>(m_pixels));
        if (m_alterFrame)
            m_alterFrame(frame);
    }
    system.publish(frame);
}

void PuppetXray::sendStatus(DistributedSystem& system)
{
    Message status = system.report("AcquisitionStatus").value();
    {
        const std::lock_guard lock(m_mutex);
        ++m_turns;
        const bool on = beamOn();
        status.set("mode", std::string_view(on ? "fluoroscopy" : "stop")).set("beam_on", on).set("pulse_rate", on ? 15.0 : 0.0);
        if (m_alterStatus)
            m_alterStatus(status);
    }
    system.publish(status);
}

void PuppetXray::show(Pictures pictures)
{
    const std::lock_guard lock(m_mutex);
    m_pictures = pictures;
}

std::optional<std::chrono::steady_clock::time_point> PuppetXray::takenAt(std::uint32_t frame) const
{
    const std::lock_guard lock(m_mutex);
    const auto found = m_taken.find(frame);
    return found != m_taken.end() ? std::optional(found->second) : std::nullopt;
}

void PuppetXray::alterStatus(Alter alter)
{
    const std::lock_guard lock(m_mutex);
    m_alterStatus = std::move(alter);
}

void PuppetXray::alterFrame(Alter alter)
{
    const std::lock_guard lock(m_mutex);
    m_alterFrame = std::move(alter);
}

void PuppetXray::movePatient(unsigned columns)
{
    const std::lock_guard lock(m_mutex);
    m_patient = columns;
}

void PuppetXray::setBeam(bool always)
{
    const std::lock_guard lock(m_mutex);
    m_always = always;
}

int PuppetXray::pedalsHeard() const
{
    const std::lock_guard lock(m_mutex);
    return m_pedalsHeard;
}

std::uint64_t PuppetXray::turns() const
{
    const std::lock_guard lock(m_mutex);
    return m_turns;
}

void PuppetXray::standStill(std::chrono::milliseconds time)
{
    m_device->post([time] { std::this_thread::sleep_for(time); });
}

PuppetArm::PuppetArm(Settings settings)
    : m_device(std::move(settings), [this](DistributedSystem& system) {
          system.every(milliseconds(20), [this, &system] {
              Message status = system.report("ArmStatus").value();
              status.set("state", std::string_view(m_fault ? "Fault" : "Hold")).set("holding", true).set("brake", true);
              system.publish(status);
          });
      })
{}

} // namespace liena::test
