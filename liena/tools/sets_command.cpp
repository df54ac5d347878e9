// Lists, compares and accepts message sets.
#include "sets_command.hpp"

#include "refusal.hpp"
#include "register_folder.hpp"

#include "liena/known_sets.hpp"
#include "liena/log.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace liena::tools {

namespace {

struct Places {
    std::vector<std::filesystem::path> registry{registerFolder()};
    std::filesystem::path store = defaultSetStore();
};

std::string_view wordOf(SetSource source)
{
    switch (source) {
    case SetSource::Register:
        return "register";
    case SetSource::Met:
        return "met first";
    case SetSource::Accepted:
        break;
    }
    return "accepted";
}

std::string titleOf(const KnownSet& known)
{
    return known.set ? fmt::format("{} {}", known.set->name(), printable(known.set->version())) : std::string("(its file is not here)");
}

int list(const Places& places)
{
    const auto known = knownSets(places.registry, places.store);
    if (!known)
        return refuse("sets", known.error().what);
    fmt::print("{:<12}{:<11}{:<14}{}\n", "TYPE", "SOURCE", "SHA-256", "SET");
    for (const auto& one : known.value())
        fmt::print("{:<12}{:<11}{:<14}{}\n", one.type.toString(), wordOf(one.source), one.hash.toHex().substr(0, 12), titleOf(one));
    return 0;
}

void printChanges(const std::vector<std::string>& changes)
{
    for (const auto& line : changes)
        fmt::print("  {}\n", line);
    if (changes.empty())
        fmt::print("  nothing that a device could notice: titles, descriptions or the way it is written\n");
}

int diff(const std::string& before, const std::string& now)
{
    const auto one = MessageSet::load(before);
    if (!one)
        return refuse("sets", one.error().what);
    const auto other = MessageSet::load(now);
    if (!other)
        return refuse("sets", other.error().what);
    printChanges(describeChanges(*one.value(), *other.value()));
    return 0;
}

int accept(const Places& places, const std::string& file, bool sure)
{
    if (places.store.empty())
        return refuse("sets", "there is no folder for state: set HOME, or name one with --store");
    const auto set = MessageSet::load(file);
    if (!set)
        return refuse("sets", set.error().what);
    const auto known = knownSets(places.registry, places.store);
    if (!known)
        return refuse("sets", known.error().what);
    const auto type = set.value()->deviceType();
    const auto held =
        std::find_if(known.value().begin(), known.value().end(), [&](const KnownSet& candidate) { return candidate.type == type; });
    if (held != known.value().end() && held->hash == set.value()->hash()) {
        fmt::print("{} may show this set already.\n", type.toString());
        return 0;
    }
    if (held != known.value().end() && held->set) {
        fmt::print("Devices of type {} may show {} now. What changes:\n", type.toString(), titleOf(*held));
        printChanges(describeChanges(*held->set, *set.value()));
    } else {
        fmt::print("No set is known for devices of type {} so far.\n", type.toString());
    }
    if (!sure) {
        fmt::print("Nothing was done. When this is what you want, repeat the command with --yes.\n");
        return 1;
    }
    if (auto accepted = acceptSet(places.store, *set.value()); !accepted)
        return refuse("sets", accepted.error().what);
    fmt::print("Accepted: devices of type {} may show {} {} and no other. Sessions that are open go on as they are.\n", type.toString(),
               set.value()->name(), set.value()->hash().toHex().substr(0, 12));
    return 0;
}

void addPlaces(CLI::App& command, const std::shared_ptr<Places>& places)
{
    command
        .add_option("--registry", places->registry,
                    "Folder of the register; may be repeated. Not named: resources/devices, or what is installed")
        ->capture_default_str();
    command.add_option("--store", places->store, "Folder with learnt sets and pins, as the device has it")->capture_default_str();
}

} // namespace

void addSetsCommand(CLI::App& app, int& exitCode)
{
    auto* command = app.add_subcommand("sets", "List the message sets that devices may show here, and accept another");
    command->require_subcommand(1);
    command->footer("A device whose message set is not the one known here is refused (MessageSetChanged) until a person has accepted it:\n"
                    "a larger bound or another unit can mean another motion. Get the file from whoever changed the device.\n\n"
                    "Examples:\n"
                    "  liena sets list\n"
                    "  liena sets accept vascular-robot-1.1.xml          shows what would change\n"
                    "  liena sets accept vascular-robot-1.1.xml --yes    accepts it on this computer\n\n"
                    "Exit codes: 0 done, 1 nothing was done, 2 wrong use of the command line.");
    const auto places = std::make_shared<Places>();

    auto* listing = command->add_subcommand("list", "The set of each device type, and why it counts");
    addPlaces(*listing, places);
    listing->callback([places, &exitCode] { exitCode = list(*places); });

    auto* comparing = command->add_subcommand("diff", "What differs between two files, message by message");
    const auto files = std::make_shared<std::pair<std::string, std::string>>();
    comparing->add_option("BEFORE", files->first, "The set that is known")->required();
    comparing->add_option("NOW", files->second, "The other")->required();
    comparing->callback([files, &exitCode] { exitCode = diff(files->first, files->second); });

    auto* accepting = command->add_subcommand("accept", "Let devices of a type show this set and no other");
    addPlaces(*accepting, places);
    const auto file = std::make_shared<std::string>();
    const auto sure = std::make_shared<bool>(false);
    accepting->add_option("FILE", *file, "The new message set")->required();
    accepting->add_flag("--yes", *sure, "Do it; without this the changes are only shown");
    accepting->callback([places, file, sure, &exitCode] { exitCode = accept(*places, *file, *sure); });
}

} // namespace liena::tools
