// Options for the marks on packets and for the network thread, the same in each program that takes them.
#pragma once

#include <liena/settings.hpp>

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdint>
#include <string>

namespace liena {

/// The settings outlive the parsing.
inline void addMarkOptions(CLI::App& command, PacketMarks& marks)
{
    const auto add = [&command](const char* name, std::uint8_t& mark, const std::string& what) {
        command
            .add_option_function<int>(
                name, [&mark](int dscp) { mark = static_cast<std::uint8_t>(dscp); },
                "DSCP (RFC 2474) of " + what + ": 0 to 63, 0 for none; default " + std::to_string(mark))
            ->check(CLI::Range(0, 63));
    };
    add("--mark-commands", marks.prompt, "what is prompt");
    add("--mark-images", marks.bulk, "images");
}

inline void addRealTimeOptions(CLI::App& command, RealTimeOptions& realTime)
{
    command.add_option("--realtime-priority", realTime.priority, "SCHED_FIFO priority of the network thread, 1 to 99; default none");
    command.add_option("--processors", realTime.processors, "Processors that the network thread may use, as 2,3; default all")
        ->delimiter(',');
    command.add_flag("--lock-memory", realTime.lockMemory, "Keep all memory of the process from being swapped");
    command.add_option_function<int>(
        "--card-poll", [&realTime](int us) { realTime.cardSearch = std::chrono::microseconds(us); },
        "Microseconds that the kernel asks the network card before the network thread sleeps");
    command.add_option_function<int>(
        "--busy-poll", [&realTime](int us) { realTime.search = std::chrono::microseconds(us); },
        "Microseconds that the network thread looks for work before it sleeps; costs a processor; default 0");
    command.add_flag_callback(
        "--sleep-in-dialogues", [&realTime] { realTime.attention = false; },
        "Let the network thread sleep also while messages follow each other, or answer its own, at once; saves a processor's time then");
}

} // namespace liena
