// One system of the lab in operation: its networks, the wire, the devices, and what they have told so far.
#pragma once

#include "runner/network.hpp"
#include "runner/process.hpp"
#include "runner/record.hpp"
#include "runner/system_files.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace liena::lab {

using Milliseconds = std::chrono::milliseconds;

/// A device's process, and what its log says it is doing.
class RigDevice {
public:
    std::string name;
    std::size_t port = 0;
    std::unique_ptr<Process> process;
    std::vector<Record> records;               ///< since the last Rig::forget()
    std::map<std::string, std::string> states; ///< of the sessions, by peer
    std::string robotState;                    ///< a robot's own
    std::uint64_t robotPermit = 0;
    std::map<std::string, std::string> heard; ///< a cockpit's: each robot's state as reported
    bool ready = false;
    bool moving = false;
    std::uint64_t applied = 0;  ///< commands, since it started
    std::uint64_t pictures = 0; ///< received
    std::uint64_t heap = 0;     ///< bytes in use: the least since takeHeap(), 0 when none was told
    bool ended = false;         ///< its output has ended

    bool isOpenTo(const std::string& peer) const;
    const std::string& stateOf(const std::string& peer) const;
    std::uint64_t takeHeap() { return std::exchange(heap, 0); }
    const Record* first(std::int64_t from, const std::function<bool(const Record&)>& accept) const;

private:
    friend class Rig;
    void take(std::string_view bytes);
    void learn(const Record& record);

    std::string m_unread;
};

// Real-time priorities. The wire is the lab's equipment and adds no stalls of its own if it can help it; the runner acts in time.
inline constexpr int wireUrgency = 22;
inline constexpr int runnerUrgency = 21;
inline constexpr int deviceUrgency = 20;

struct RigOptions {
    std::uint64_t seed = 1;
    bool ordinary = false; ///< devices and wire compete with everybody's programs
    bool keep = false;
};

/// Everything happens on the main thread, in until() and settle(): they read what the devices tell.
class Rig {
public:
    Rig(SystemPlan plan, RigOptions options);
    ~Rig();
    Rig(const Rig&) = delete;
    Rig& operator=(const Rig&) = delete;

    /// What may differ from the usual when a device is started.
    struct Start {
        std::optional<std::filesystem::path> registry;
        std::optional<std::string> actsAs; ///< with the name and files of this device, at another's port
        bool smallDisk = false;
        std::optional<int> processor;
        std::vector<std::string> flags;
    };

    /// Starts a device and waits until it runs; throws when it does not.
    void start(const std::string& name) { start(name, Start()); }
    void start(const std::string& name, const Start& how);
    void startAll();

    /// Reads until the condition holds; false when it does not within `limit`.
    bool until(const std::function<bool()>& condition, Milliseconds limit);
    void settle(Milliseconds time);

    /// Gives the wire an order and returns the moment since which it is in force.
    std::int64_t wire(const std::string& order);

    void say(const std::string& device, const std::string& line) { (*this)[device].process->say(line); }
    std::int64_t signal(const std::string& device, int number);

    RigDevice& operator[](const std::string& name);
    const std::vector<std::unique_ptr<RigDevice>>& devices() const { return m_devices; }
    const SystemPlan& plan() const { return m_plan; }
    Networks& networks() { return m_networks; }
    const SystemFiles& files() const { return m_files; }

    /// Throws the records away; the states stay.
    void forget();

private:
    void startWire(std::uint64_t seed);
    void pump(Milliseconds wait);
    void readWire();
    void readDevice(RigDevice& device);
    void saveLog(const RigDevice& device) const;

    SystemPlan m_plan;
    RigOptions m_options;
    SystemFiles m_files;
    Networks m_networks;
    std::unique_ptr<Process> m_wire;
    std::string m_wireUnread;
    std::vector<Record> m_wireAnswers;
    std::vector<std::unique_ptr<RigDevice>> m_devices;
};

} // namespace liena::lab
