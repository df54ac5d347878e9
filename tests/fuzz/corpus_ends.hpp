// The two devices of tests/corpus, with their message sets: the robot listens, the cockpit speaks.
#pragma once

#include "fuzz_target.hpp"
#include "liena/message_set.hpp"
#include "protocol/header_judge.hpp"

#include <memory>

namespace liena::fuzz {

inline constexpr DeviceId robotId(0x00008208U);
inline constexpr DeviceId cockpitId(0x40018208U);

inline std::shared_ptr<const MessageSet> corpusSet(const char* file)
{
    const auto set = MessageSet::load(std::filesystem::path(LIENA_SOURCE_DIR "/tests/corpus/sets") / file);
    expect(set.has_value(), "the corpus's own message set can be read");
    return set.value();
}

inline const protocol::Ends& corpusEnds()
{
    static const auto robot = corpusSet("robot.xml");
    static const auto cockpit = corpusSet("cockpit.xml");
    static const protocol::Ends ends{cockpitId, robotId, robot.get(), cockpit.get()};
    return ends;
}

} // namespace liena::fuzz
