// <timing>, of the whole topology or of one link.
#include "topology/topology_reader.hpp"

#include <fmt/format.h>

namespace liena {

namespace {

std::string shown(std::chrono::nanoseconds duration)
{
    using namespace std::chrono_literals;
    if (duration % 1s == 0ns)
        return fmt::format("{}s", duration / 1s);
    return duration % 1ms == 0ns ? fmt::format("{}ms", duration / 1ms) : fmt::format("{}us", duration / 1us);
}

class TimingCheck {
public:
    TimingCheck(const Element& element, const LinkTiming& timing) : m_element(element), m_timing(timing) {}

    void run() const
    {
        using namespace std::chrono_literals;
        constexpr int leastSuspect = 2;
        constexpr int leastLost = 3;
        // A session judges a few milliseconds before `lost`, and no timer of a loaded computer is better than that.
        atLeast("heartbeat", m_timing.heartbeat, 1ms);
        atLeast("lost", m_timing.lost, 10ms);
        atLeastHeartbeats("suspect", m_timing.suspect, leastSuspect);
        atLeastHeartbeats("lost", m_timing.lost, leastLost);
        inOrder("suspect", m_timing.suspect, "lost", m_timing.lost);
        inOrder("lost", m_timing.lost, "reconnect", m_timing.reconnect);
    }

private:
    /// At the first of the attributes that stands here: the others came from the topology or from the defaults.
    void report(std::initializer_list<std::string_view> attributes, std::string text, std::string remedy) const
    {
        for (const auto attribute : attributes)
            if (const auto present = m_element.find(attribute))
                return present->reject(std::move(text), std::move(remedy));
    }

    void atLeast(std::string_view name, std::chrono::nanoseconds value, std::chrono::nanoseconds least) const
    {
        if (value < least)
            report({name}, fmt::format("{} {} is less than {}, with which no session can live", name, shown(value), shown(least)),
                   fmt::format("write {}=\"{}\" or more", name, shown(least)));
    }

    void atLeastHeartbeats(std::string_view name, std::chrono::nanoseconds value, int least) const
    {
        // Division, because a product of two large durations could overflow.
        if (value / least < m_timing.heartbeat)
            report({name, "heartbeat"},
                   fmt::format("{} {} is less than {} heartbeats of {}", name, shown(value), least, shown(m_timing.heartbeat)),
                   fmt::format("raise {} or shorten the heartbeat", name));
    }

    void inOrder(std::string_view shorter, std::chrono::nanoseconds a, std::string_view longer, std::chrono::nanoseconds b) const
    {
        if (a >= b)
            report({shorter, longer}, fmt::format("{} {} is not shorter than {} {}", shorter, shown(a), longer, shown(b)),
                   "the order is suspect < lost < reconnect");
    }

    const Element& m_element;
    const LinkTiming& m_timing;
};

} // namespace

LinkTiming readTiming(const Element& element, const LinkTiming& base)
{
    element.expectAttributes({"heartbeat", "suspect", "lost", "reconnect"});
    element.children({});
    const auto heartbeat = durationFrom(element.find("heartbeat"));
    const auto suspect = durationFrom(element.find("suspect"));
    const auto lost = durationFrom(element.find("lost"));
    const auto reconnect = durationFrom(element.find("reconnect"));
    const LinkTiming timing{heartbeat.value_or(base.heartbeat), suspect.value_or(base.suspect), lost.value_or(base.lost),
                            reconnect.value_or(base.reconnect)};
    const bool readable = (heartbeat || !element.find("heartbeat")) && (suspect || !element.find("suspect")) &&
                          (lost || !element.find("lost")) && (reconnect || !element.find("reconnect"));
    if (readable)
        TimingCheck(element, timing).run();
    return timing;
}

} // namespace liena
