// The contrast injector: delivers one injection at a time, each number once, and never resumes a stopped one.
#pragma once

#include "drive_gate.hpp"

#include "liena/device_id.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace liena::devices {

/// The numbers are those of `InjectionState` in the robot's message set.
enum class InjectionState : std::uint8_t { Accepted = 1, Running = 2, Done = 3, Stopped = 4, Refused = 5 };

struct InjectionRequest {
    DeviceId origin;
    std::uint32_t number = 0; ///< unique for its origin
    double volume = 0;        ///< ml
    double rate = 0;          ///< ml/s
};

struct InjectionAnswer {
    std::uint32_t number = 0;
    double delivered = 0; ///< ml
    InjectionState state = InjectionState::Refused;
    std::string reason;
};

/// Pure: time comes from the caller. Whether an injection is permitted at all is the robot machine's matter.
class ContrastInjector {
public:
    explicit ContrastInjector(double content = 100) : m_remaining(content) {}

    /// Starts it, or says why not. A repeat of a number is answered with what became of it and starts nothing.
    InjectionAnswer request(const InjectionRequest& request, SteadyTime now);

    /// What is known of a number; nothing for a new one.
    std::optional<InjectionAnswer> known(DeviceId origin, std::uint32_t number) const;

    /// Notes a refusal that others decided, so that a late repeat is refused as well: one among the last 256 refusals of its origin.
    InjectionAnswer refuse(const InjectionRequest& request, std::string reason);

    /// Ends the flow at once; the answer to report, if there was any flow.
    std::optional<InjectionAnswer> stop(std::string reason);

    /// Lets it flow until `now`; the answer to report when its state changed.
    std::optional<InjectionAnswer> advance(SteadyTime now);

    bool running() const { return m_running.has_value(); }
    double flow() const { return m_running ? m_records.at(*m_running).request.rate : 0; } ///< ml/s now
    double remaining() const { return m_remaining; }                                      ///< ml

private:
    using Key = std::pair<DeviceId, std::uint32_t>;
    struct Record {
        InjectionRequest request;
        InjectionAnswer answer;
    };

    std::map<Key, Record> m_records;                            ///< what was begun; bounded: a full memory refuses
    std::map<DeviceId, std::deque<InjectionAnswer>> m_refusals; ///< the newest of each origin: nobody's fill the memory of another
    std::optional<Key> m_running;
    SteadyTime m_last;
    double m_remaining;
};

} // namespace liena::devices
