// The contrast injector: implementation.
#include "contrast_injector.hpp"

#include <algorithm>

namespace liena::devices {

namespace {

constexpr std::size_t mostRecords = 4096;
constexpr std::size_t mostRefusals = 256; // of one origin

std::string whyNot(const InjectionRequest& request, bool running, double remaining)
{
    if (running)
        return "another injection is running; wait until it is done";
    if (!(request.volume >= 0.1 && request.volume <= 30 && request.rate >= 0.1 && request.rate <= 10))
        return "the volume or the rate is outside its bounds";
    if (request.volume > remaining)
        return "not enough contrast is left; refill the injector";
    return {};
}

} // namespace

std::optional<InjectionAnswer> ContrastInjector::known(DeviceId origin, std::uint32_t number) const
{
    if (const auto begun = m_records.find({origin, number}); begun != m_records.end())
        return begun->second.answer;
    const auto refusals = m_refusals.find(origin);
    if (refusals == m_refusals.end())
        return std::nullopt;
    const auto& answers = refusals->second;
    const auto found = std::find_if(answers.begin(), answers.end(), [&](const InjectionAnswer& answer) { return answer.number == number; });
    return found == answers.end() ? std::nullopt : std::optional(*found);
}

InjectionAnswer ContrastInjector::refuse(const InjectionRequest& request, std::string reason)
{
    auto& answers = m_refusals[request.origin];
    if (answers.size() >= mostRefusals)
        answers.pop_front(); // nothing of it was injected
    answers.push_back({request.number, 0, InjectionState::Refused, std::move(reason)});
    return answers.back();
}

InjectionAnswer ContrastInjector::request(const InjectionRequest& request, SteadyTime now)
{
    if (const auto answer = known(request.origin, request.number))
        return *answer;
    if (m_records.size() >= mostRecords)
        return refuse(request, "the memory of injections is full; restart the robot's program");
    if (auto reason = whyNot(request, running(), m_remaining); !reason.empty())
        return refuse(request, std::move(reason));
    const Key key{request.origin, request.number};
    const InjectionAnswer answer{request.number, 0, InjectionState::Running, {}};
    m_records.emplace(key, Record{request, answer});
    m_running = key;
    m_last = now;
    return {request.number, 0, InjectionState::Accepted, {}};
}

std::optional<InjectionAnswer> ContrastInjector::stop(std::string reason)
{
    if (!m_running)
        return std::nullopt;
    auto& answer = m_records.at(*m_running).answer;
    answer.state = InjectionState::Stopped;
    answer.reason = std::move(reason);
    m_running.reset();
    return answer;
}

std::optional<InjectionAnswer> ContrastInjector::advance(SteadyTime now)
{
    if (!m_running)
        return std::nullopt;
    auto& [request, answer] = m_records.at(*m_running);
    const double seconds = std::max(0.0, std::chrono::duration<double>(now - m_last).count());
    const double amount = std::min(request.rate * seconds, request.volume - answer.delivered);
    const bool first = answer.delivered == 0 && amount > 0;
    answer.delivered += amount;
    m_remaining = std::max(0.0, m_remaining - amount);
    m_last = std::max(m_last, now);
    if (answer.delivered >= request.volume - 1e-9) {
        answer.delivered = request.volume;
        answer.state = InjectionState::Done;
        m_running.reset();
        return answer;
    }
    return first ? std::optional(answer) : std::nullopt;
}

} // namespace liena::devices
