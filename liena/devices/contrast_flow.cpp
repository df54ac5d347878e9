// How injected contrast travels with the blood: implementation.
#include "contrast_flow.hpp"

#include <algorithm>

namespace liena::devices {

namespace {

constexpr double memory = 12;       // s
constexpr double bloodSpeed = 220;  // mm/s
constexpr double bloodFlow = 4;     // ml/s in the carotid artery
constexpr double leastSmear = 0.08; // s
constexpr double smearing = 0.25;   // of the travel time

} // namespace

void ContrastFlow::observe(std::chrono::nanoseconds time, double flow)
{
    const double now = std::chrono::duration<double>(time).count();
    if (m_steps.empty()) {
        m_steps.push_back({now, flow, 0});
        return;
    }
    const Step& last = m_steps.back();
    const double later = std::max(now, last.time);
    m_steps.push_back({later, flow, last.amount + last.flow * (later - last.time)});
    while (m_steps.size() > 2 && m_steps[1].time < later - memory)
        m_steps.pop_front();
}

void ContrastFlow::observeAfterPause(std::chrono::nanoseconds time, double flow)
{
    if (!m_steps.empty())
        m_steps.back().flow = std::min(m_steps.back().flow, flow);
    observe(time, flow);
}

double ContrastFlow::amountAt(double time) const
{
    const auto after =
        std::upper_bound(m_steps.begin(), m_steps.end(), time, [](double value, const Step& step) { return value < step.time; });
    if (after == m_steps.begin())
        return m_steps.front().amount;
    const Step& step = *(after - 1);
    return step.amount + step.flow * (time - step.time);
}

double ContrastFlow::concentration(double distance) const
{
    if (m_steps.empty() || distance < 0)
        return 0;
    const double travel = distance / bloodSpeed;
    const double smear = leastSmear + smearing * travel;
    const double left = m_steps.back().time - travel;
    const double flow = (amountAt(std::min(left + smear / 2, m_steps.back().time)) - amountAt(left - smear / 2)) / smear;
    return std::max(0.0, flow / (flow + bloodFlow));
}

bool ContrastFlow::present() const
{
    return std::any_of(m_steps.begin(), m_steps.end(), [](const Step& step) { return step.flow > 0; });
}

} // namespace liena::devices
