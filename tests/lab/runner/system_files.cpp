// The files of a lab's robotic system: implementation.
#include "runner/system_files.hpp"

#include "runner/network.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace liena::lab {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t firstPort = 52200;
constexpr auto oneWeek = std::chrono::hours(24 * 7);

DevicePlan cockpitPlan() { return {"cockpit", "0x40018208", "siat-cockpit", {}}; }

DevicePlan robotPlan(std::size_t index)
{
    constexpr std::string_view lastDigits = "89abcde"; // seven devices of one type
    return {index == 0 ? "robot" : "robot" + std::to_string(index + 1),
            "0x0000820" + std::string(1, lastDigits.at(index)),
            "vascular-robot",
            {}};
}

fs::path makeFolder()
{
    std::string pattern = (fs::temp_directory_path() / "liena-lab-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
        throw std::runtime_error("cannot make a folder in " + fs::temp_directory_path().string());
    return pattern;
}

fs::path projectRegister() { return fs::path(LIENA_SOURCE_DIR) / "resources" / "devices"; }

} // namespace

SystemPlan plans::pair() { return {{cockpitPlan(), robotPlan(0)}, {"cockpit robot"}, {}}; }

SystemPlan plans::withPictures()
{
    return {{cockpitPlan(), robotPlan(0), {"xray", "0x20010208", "cbct-xray", {}}}, {"cockpit robot", "cockpit xray"}, {}};
}

SystemPlan plans::twoViewers()
{
    auto plan = withPictures();
    plan.devices.push_back({"viewer", "0x40018209", "siat-cockpit", 0});
    plan.links.insert(plan.links.end(), {"viewer robot", "viewer xray"});
    return plan;
}

SystemPlan plans::star(std::size_t devices)
{
    SystemPlan plan{{cockpitPlan()}, {}, {}};
    for (std::size_t i = 0; i + 1 < devices; ++i) {
        plan.devices.push_back(robotPlan(i));
        plan.links.push_back("cockpit " + plan.devices.back().name);
    }
    return plan;
}

SystemPlan plans::mesh(std::size_t devices)
{
    SystemPlan plan = star(devices);
    for (std::size_t i = 1; i < devices; ++i)
        for (std::size_t j = i + 1; j < devices; ++j)
            plan.links.push_back(plan.devices[i].name + " " + plan.devices[j].name);
    return plan;
}

SystemFiles::SystemFiles(const SystemPlan& plan) : m_folder(makeFolder()), m_flags(plan.flags)
{
    writeTopology(plan);
    issueCertificates(plan);
    for (const auto& device : plan.devices)
        fs::create_directory(storeOf(device.name));
}

SystemFiles::~SystemFiles()
{
    std::error_code ignored;
    if (!m_kept)
        fs::remove_all(m_folder, ignored);
}

void SystemFiles::writeTopology(const SystemPlan& plan) const
{
    std::ofstream file(m_folder / "topology.xml");
    file << "<topology xmlns=\"urn:liena:topology:1\" name=\"lab\" version=\"1.0\">\n"
         << "  <timing heartbeat=\"20ms\" suspect=\"70ms\" lost=\"110ms\" reconnect=\"500ms\"/>\n  <security mode=\"tls\"/>\n";
    for (std::size_t i = 0; i < plan.devices.size(); ++i)
        file << "  <device name=\"" << plan.devices[i].name << "\" id=\"" << plan.devices[i].id << "\" message-set=\""
             << plan.devices[i].set << "\" host=\"" << Networks::addressOf(plan.portOf(i)) << "\" port=\"" << firstPort + i << "\"/>\n";
    for (const auto& link : plan.links)
        file << "  <link between=\"" << link << "\"/>\n";
    file << "</topology>\n";
    if (!file.flush())
        throw std::runtime_error("cannot write " + (m_folder / "topology.xml").string());
}

void SystemFiles::issueCertificates(const SystemPlan& plan) const
{
    const auto authority = CertificateAuthority::create(m_folder / "pki", "The lab", 2 * oneWeek);
    if (!authority)
        throw std::runtime_error(authority.error().what);
    for (const auto& device : plan.devices)
        if (const auto issued = authority.value().issue(DeviceId::fromString(device.id).value(), device.name, oneWeek); !issued)
            throw std::runtime_error(issued.error().what);
}

fs::path SystemFiles::registryWithout(const std::vector<std::string>& sets) const
{
    const auto folder = m_folder / "register";
    fs::create_directory(folder);
    for (const auto& entry : fs::directory_iterator(projectRegister()))
        if (std::find(sets.begin(), sets.end(), entry.path().stem().string()) == sets.end())
            fs::copy_file(entry.path(), folder / entry.path().filename(), fs::copy_options::overwrite_existing);
    return folder;
}

std::vector<std::string> SystemFiles::argumentsOf(const std::string& device, const std::optional<fs::path>& registry) const
{
    const auto pki = m_folder / "pki";
    std::vector<std::string> arguments{"--topology",    (m_folder / "topology.xml").string(),
                                       "--device",      device,
                                       "--registry",    registry.value_or(projectRegister()).string(),
                                       "--store",       storeOf(device).string(),
                                       "--certificate", (pki / (device + ".crt")).string(),
                                       "--key",         (pki / (device + ".key")).string(),
                                       "--authority",   (pki / "ca.crt").string()};
    arguments.insert(arguments.end(), m_flags.begin(), m_flags.end());
    return arguments;
}

} // namespace liena::lab
