// Files, processes and answers of a mesh.
#include "scale/mesh.hpp"

#include "runner/process_facts.hpp"
#include "scale/mesh_device.hpp"

#include <fmt/format.h>

#include <poll.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace liena::bench {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t devicesPerType = 7;
constexpr int answerLimit = 150'000; // ms; longer than a device tries to open

constexpr auto setText = R"(<message-set xmlns="urn:liena:message-set:1" name="{0}" version="1.0"
             class="special" manufacturer="1" type="62" device-version="{1}" vendor="LiENa" title="One of many equal devices">
  <message number="0x0100" name="Asked" role="command" priority="control" title="64 bytes to be answered">
{2}  </message>
  <message number="0x0200" name="Answered" role="report" priority="status" title="The same 64 bytes">
{2}  </message>
</message-set>
)";

std::string typeName(std::size_t type) { return fmt::format("scale-{}", type); }

std::string fieldsText()
{
    std::string text = "    <field name=\"number\" type=\"uint64\" min=\"0\" max=\"18446744073709551615\"/>\n"
                       "    <field name=\"sent\" type=\"int64\" unit=\"ns\" min=\"0\" max=\"9223372036854775807\"/>\n";
    for (const auto* name : {"x", "y", "z", "rx", "ry", "rz"})
        text += fmt::format("    <field name=\"{}\" type=\"float64\" min=\"-1000\" max=\"1000\" default=\"0\"/>\n", name);
    return text;
}

std::vector<test::DeviceSpec> devicesOf(std::size_t count)
{
    std::vector<test::DeviceSpec> devices;
    for (std::size_t i = 0; i < count; ++i) {
        const auto type = i / devicesPerType;
        const auto id = DeviceId::compose(DeviceClass::Special, 1, 62, static_cast<std::uint32_t>(type),
                                          static_cast<std::uint32_t>(i % devicesPerType));
        devices.push_back({meshDeviceName(i), id.toString(), typeName(type)});
    }
    return devices;
}

std::vector<std::string> linksOf(std::size_t count)
{
    std::vector<std::string> links;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j)
            links.push_back(meshDeviceName(i) + " " + meshDeviceName(j));
    return links;
}

void writeSets(const fs::path& folder, std::size_t devices)
{
    fs::create_directories(folder);
    for (std::size_t type = 0; type * devicesPerType < devices; ++type) {
        std::ofstream file(folder / (typeName(type) + ".xml"));
        file << fmt::format(setText, typeName(type), type, fieldsText());
        if (!file.flush())
            throw std::runtime_error("cannot write " + (folder / typeName(type)).string());
    }
}

double processorSecondsOf(pid_t process)
{
    clockid_t clock = 0;
    timespec used{};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &used) != 0)
        throw std::runtime_error("a device of the mesh has ended");
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

} // namespace

std::uint64_t raiseFileLimit()
{
    rlimit limit{};
    ::getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &limit);
    ::getrlimit(RLIMIT_NOFILE, &limit);
    return limit.rlim_cur;
}

std::string meshRefusal(std::size_t devices, std::uint64_t mostFiles)
{
    constexpr std::uint64_t besides = 64; // a device's own files, and connections that come and go while all open
    const std::uint64_t ofDevice = 2 * (devices - 1) + besides;
    const std::uint64_t ofRunner = 2 * devices + besides;
    const auto needed = std::max(ofDevice, ofRunner);
    if (needed > mostFiles)
        return fmt::format(
            "{} devices need {} open files in a process, and this user may have {}: raise it with `ulimit -n {}` or `nofile` in "
            "/etc/security/limits.d, or measure fewer devices",
            devices, needed, mostFiles, needed);
    std::uint64_t inUse = 0;
    std::uint64_t unused = 0;
    std::uint64_t most = 0;
    std::ifstream("/proc/sys/fs/file-nr") >> inUse >> unused >> most;
    if (inUse + devices * needed > most)
        return fmt::format("{} devices need {} open files together, and this computer has {} in use of {}: raise fs.file-max with sysctl",
                           devices, devices * needed, inUse, most);
    return {};
}

LoopbackTraffic loopbackTraffic()
{
    std::ifstream file("/proc/net/dev");
    for (std::string name; file >> name;)
        if (LoopbackTraffic traffic; name == "lo:" && file >> traffic.bytes >> traffic.packets)
            return traffic;
    return {};
}

Mesh::Mesh(const MeshPlan& plan) : m_plan(plan), m_files(devicesOf(plan.devices), linksOf(plan.devices), {"tls", plan.timing})
{
    writeSets(m_files.folder() / "sets", plan.devices);
    for (std::size_t i = 0; i < plan.devices; ++i) {
        const auto identity = m_files.identityOf(meshDeviceName(i));
        if (i == 0)
            fs::create_directory_symlink(identity.authority.parent_path(), m_files.folder() / "pki");
        lab::ProcessPlan process;
        process.command = {plan.program.string(),
                           "device",
                           "--folder",
                           m_files.folder().string(),
                           "--index",
                           std::to_string(i),
                           "--of",
                           std::to_string(plan.devices),
                           "--rate",
                           fmt::format("{}", plan.rate / static_cast<double>(plan.devices))};
        if (plan.plain)
            process.command.emplace_back("--plain");
        m_devices.push_back({std::make_unique<lab::Process>(process), {}});
    }
    for (auto& device : m_devices)
        nextLine(device);
}

std::string Mesh::nextLine(Device& device)
{
    for (;;) {
        if (const auto end = device.heard.find('\n'); end != std::string::npos) {
            auto line = device.heard.substr(0, end);
            device.heard.erase(0, end + 1);
            return line;
        }
        pollfd waiting{device.process->output(), POLLIN, 0};
        std::array<char, 65536> buffer{};
        const auto count = ::poll(&waiting, 1, answerLimit) > 0 ? ::read(waiting.fd, buffer.data(), buffer.size()) : -1;
        if (count <= 0)
            throw std::runtime_error("a device of the mesh ended, or does not answer");
        device.heard.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

std::vector<std::string> Mesh::everyone(const std::string& word)
{
    std::vector<std::string> answers;
    for (auto& device : m_devices)
        device.process->say(word);
    for (auto& device : m_devices)
        answers.push_back(nextLine(device));
    return answers;
}

MeshCounts Mesh::open() { return sumOf("open"); }

void Mesh::ask(bool on) { everyone(on ? "begin" : "end"); }

MeshCounts Mesh::counts() { return sumOf("counts"); }

MeshCounts Mesh::sumOf(const std::string& word)
{
    MeshCounts sum;
    for (const auto& answer : everyone(word)) {
        MeshCounts one;
        std::istringstream(answer) >> one;
        sum.at += one.at / static_cast<double>(m_plan.devices);
        sum.sessionEnds += one.sessionEnds;
        sum.heartbeats += one.heartbeats;
        sum.missed += one.missed;
        sum.troubles += one.troubles;
        sum.retries += one.retries;
        sum.asked += one.asked;
        sum.heard += one.heard;
        sum.answered += one.answered;
    }
    return sum;
}

MeshMemory Mesh::memory() const
{
    MeshMemory sum;
    for (const auto& device : m_devices) {
        const auto id = device.process->id();
        sum.allocatedKiB += lab::anonymousKiB(id);
        sum.residentKiB += lab::residentKiB(id);
        sum.descriptors += lab::countDescriptors(id);
    }
    return sum;
}

double Mesh::processorSeconds() const
{
    double sum = 0;
    for (const auto& device : m_devices)
        sum += processorSecondsOf(device.process->id());
    return sum;
}

std::vector<std::int64_t> Mesh::latencies()
{
    std::vector<std::int64_t> all;
    for (const auto& answer : everyone("latencies")) {
        std::istringstream numbers(answer);
        for (std::int64_t latency = 0; numbers >> latency;)
            all.push_back(latency);
    }
    return all;
}

} // namespace liena::bench
