// A measurement of a good line, for tests to spoil.
#pragma once

#include "line_verdict.hpp"

namespace liena::test {

inline ProbeFigures figures(ProbeStream asked, std::uint64_t count, std::int64_t roundTripNs)
{
    ProbeFigures made;
    made.asked = asked;
    made.perSecond = asked.perSecond;
    made.sent = made.heard = made.echoed = count;
    made.spent = std::chrono::seconds(5);
    made.roundTrip.record(roundTripNs, count);
    return made;
}

inline Measurement goodLine()
{
    using namespace tools;
    Measurement measurement;
    const ProbeStream commands{500};
    measurement.phases = {
        {phases::paced, figures(commands, 2500, 2'000'000), figures(commands, 2500, 1'900'000), {}},
        {phases::backToBack, figures({0, 1}, 1250, 2'000'000), {}, {}},
        {phases::messages, figures({0, 256}, 100'000, 9'000'000), {}, {}},
        {phases::besideImages, figures(commands, 2500, 3'000'000), figures(commands, 2500, 2'900'000),
         figures({15, 0, 524'288}, 105, 20'000'000)},
        {phases::images, {}, {}, figures({0, 3, 524'288}, 500, 60'000'000)},
    };
    return measurement;
}

inline tools::LineProfile strictProfile()
{
    const auto profile = tools::LineProfile::parse("title A <robot> & \"more\"\n"
                                                   "round-trip-p99 10 ms 20 ms\n"
                                                   "round-trip-beside-images-p99 10 ms 20 ms\n"
                                                   "round-trip-beside-images-p99.9 20 ms 40 ms\n"
                                                   "jitter 5 ms 10 ms\n"
                                                   "jitter-beside-images 6 ms 12 ms\n"
                                                   "loss 0.1 % 1 %\n"
                                                   "commands-carried 99 % 90 %\n"
                                                   "image-rate 20 MB/s 10 MB/s\n"
                                                   "images-carried 99 % 90 %\n"
                                                   "image-delivery-p99 50 ms 100 ms\n",
                                                   "strict.profile");
    return profile.value();
}

} // namespace liena::test
