// One system of the lab in operation: implementation.
#include "runner/rig.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <stdexcept>

namespace liena::lab {

namespace {

constexpr Milliseconds startLimit{10'000};

std::string programPath(const std::string& name) { return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / name).string(); }

} // namespace

bool RigDevice::isOpenTo(const std::string& peer) const
{
    const auto& state = stateOf(peer);
    return state == "open" || state == "suspect";
}

const std::string& RigDevice::stateOf(const std::string& peer) const
{
    static const std::string closed = "closed";
    const auto found = states.find(peer);
    return found == states.end() ? closed : found->second;
}

const Record* RigDevice::first(std::int64_t from, const std::function<bool(const Record&)>& accept) const
{
    const auto found = std::find_if(records.begin(), records.end(), [&](const Record& r) { return r.at >= from && accept(r); });
    return found == records.end() ? nullptr : &*found;
}

void RigDevice::take(std::string_view bytes)
{
    m_unread.append(bytes);
    std::size_t start = 0;
    for (auto end = m_unread.find('\n'); end != std::string::npos; end = m_unread.find('\n', start)) {
        records.push_back(parseRecord(std::string_view(m_unread).substr(start, end - start)));
        learn(records.back());
        start = end + 1;
    }
    m_unread.erase(0, start);
}

void RigDevice::learn(const Record& record)
{
    const auto& kind = record.kind();
    if (kind == "applied")
        ++applied;
    else if (kind == "picture")
        ++pictures;
    else if (kind == "state")
        states[record.word(1)] = record.word(3);
    else if (kind == "moves" || kind == "still")
        moving = kind == "moves";
    else if (kind == "heard")
        heard[record.word(1)] = record.word(2);
    else if (kind == "heap")
        heap = heap == 0 ? record.number(1) : std::min(heap, record.number(1));
    else if (kind == "ready")
        ready = true;
    else if (kind == "robot") {
        robotState = record.word(1);
        robotPermit = record.number(2);
    }
}

Rig::Rig(SystemPlan plan, RigOptions options)
    : m_plan(std::move(plan)), m_options(options), m_files(m_plan), m_networks(m_plan.devices.size())
{
    if (options.keep)
        m_files.keep();
    for (std::size_t i = 0; i < m_plan.devices.size(); ++i) {
        m_devices.push_back(std::make_unique<RigDevice>());
        m_devices.back()->name = m_plan.devices[i].name;
        m_devices.back()->port = m_plan.portOf(i);
    }
    startWire(options.seed);
    m_networks.configure();
}

Rig::~Rig()
{
    if (m_options.keep)
        for (const auto& device : m_devices)
            saveLog(*device);
}

void Rig::startWire(std::uint64_t seed)
{
    ProcessPlan plan;
    plan.command = {programPath("lab_wire"), std::to_string(seed)};
    plan.urgency = m_options.ordinary ? 0 : wireUrgency;
    plan.inherited = m_networks.descriptors();
    for (const int descriptor : plan.inherited)
        plan.command.push_back(std::to_string(descriptor));
    m_wire = std::make_unique<Process>(plan);
    if (!until([&] { return !m_wireAnswers.empty(); }, startLimit))
        throw std::runtime_error("the wire did not start; what it said stands above");
}

void Rig::start(const std::string& name, const Start& how)
{
    RigDevice& device = (*this)[name];
    ProcessPlan plan;
    plan.command = {programPath("lab_device")};
    const auto arguments = m_files.argumentsOf(how.actsAs.value_or(name), how.registry);
    plan.command.insert(plan.command.end(), arguments.begin(), arguments.end());
    plan.command.insert(plan.command.end(), how.flags.begin(), how.flags.end());
    plan.network = m_networks.descriptors()[device.port];
    plan.processor = how.processor;
    plan.urgency = m_options.ordinary ? 0 : deviceUrgency;
    if (how.smallDisk)
        plan.smallDisk = m_files.storeOf(name).string();
    device.states.clear();
    device.heard.clear();
    device.robotState.clear();
    device.ready = device.moving = device.ended = false;
    device.applied = device.heap = 0;
    device.process = std::make_unique<Process>(plan);
    device.records.push_back({nowNs(), {"started"}});
    if (!until([&] { return device.ready || device.ended; }, startLimit) || !device.ready)
        throw std::runtime_error("device " + name +
                                 " did not start: " + (device.records.empty() ? std::string() : device.records.back().word(1)));
}

void Rig::startAll()
{
    for (const auto& device : m_plan.devices)
        start(device.name);
}

RigDevice& Rig::operator[](const std::string& name)
{
    const auto found = std::find_if(m_devices.begin(), m_devices.end(), [&](const auto& device) { return device->name == name; });
    if (found == m_devices.end())
        throw std::logic_error("the lab has no device " + name);
    return **found;
}

bool Rig::until(const std::function<bool()>& condition, Milliseconds limit)
{
    const auto end = nowNs() + std::chrono::nanoseconds(limit).count();
    while (!condition()) {
        const auto left = (end - nowNs()) / 1'000'000;
        if (left <= 0)
            return condition();
        pump(Milliseconds(left));
    }
    return true;
}

void Rig::settle(Milliseconds time)
{
    (void)until([] { return false; }, time);
}

std::int64_t Rig::wire(const std::string& order)
{
    m_wireAnswers.clear();
    m_wire->say(order);
    if (!until([&] { return !m_wireAnswers.empty(); }, startLimit))
        throw std::runtime_error("the wire does not answer");
    if (m_wireAnswers.front().kind() != "ok")
        throw std::logic_error("the wire refused `" + order + "`: " + m_wireAnswers.front().word(1) + " " + m_wireAnswers.front().word(2));
    return m_wireAnswers.front().at;
}

std::int64_t Rig::signal(const std::string& device, int number)
{
    const auto at = nowNs();
    (*this)[device].process->signal(number);
    return at;
}

void Rig::forget()
{
    for (const auto& device : m_devices) {
        if (m_options.keep)
            saveLog(*device);
        device->records.clear();
    }
}

void Rig::pump(Milliseconds wait)
{
    std::vector<pollfd> watched;
    watched.push_back({m_wire ? m_wire->output() : -1, POLLIN, 0});
    for (const auto& device : m_devices)
        watched.push_back({device->process && !device->ended ? device->process->output() : -1, POLLIN, 0});
    if (::poll(watched.data(), watched.size(), static_cast<int>(wait.count())) <= 0)
        return;
    if (watched[0].revents != 0)
        readWire();
    for (std::size_t i = 0; i < m_devices.size(); ++i)
        if (watched[i + 1].revents != 0)
            readDevice(*m_devices[i]);
}

void Rig::readWire()
{
    std::array<char, 4096> buffer{};
    const auto count = ::read(m_wire->output(), buffer.data(), buffer.size());
    if (count <= 0)
        throw std::runtime_error("the wire has ended; what it said stands above");
    m_wireUnread.append(buffer.data(), static_cast<std::size_t>(count));
    for (auto end = m_wireUnread.find('\n'); end != std::string::npos; end = m_wireUnread.find('\n')) {
        m_wireAnswers.push_back(parseRecord(std::string_view(m_wireUnread).substr(0, end)));
        m_wireUnread.erase(0, end + 1);
    }
}

void Rig::readDevice(RigDevice& device)
{
    std::array<char, 65536> buffer{};
    const auto count = ::read(device.process->output(), buffer.data(), buffer.size());
    if (count > 0)
        return device.take({buffer.data(), static_cast<std::size_t>(count)});
    device.ended = true;
    device.moving = false;
    device.records.push_back({nowNs(), {"ended", std::to_string(device.process->waitForEnd())}});
}

void Rig::saveLog(const RigDevice& device) const
{
    std::ofstream file(m_files.folder() / (device.name + ".log"), std::ios::app);
    for (const auto& record : device.records) {
        file << record.at;
        for (const auto& word : record.words)
            file << ' ' << word;
        file << '\n';
    }
}

} // namespace liena::lab
