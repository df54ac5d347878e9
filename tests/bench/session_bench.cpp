// Measures sessions on this computer, TLS on: how long an opening takes, beside the bare TLS handshakes that it contains, and how soon a
// silent peer is noticed. Prints; judges nothing.
#include "bare_handshake.hpp"
#include "child_process.hpp"
#include "test_system.hpp"

#include <QCoreApplication>
#include <QEventLoop>
#include <QTimer>

#include <algorithm>
#include <cstdio>
#include <vector>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

constexpr auto referenceTiming = R"(heartbeat="20ms" suspect="70ms" lost="110ms" reconnect="500ms")";

double milliseconds(std::chrono::nanoseconds span) { return std::chrono::duration<double, std::milli>(span).count(); }

/// Returns the median.
double print(const char* what, std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const auto at = [&](double part) { return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))]; };
    std::printf("%-44s n %3zu   min %7.2f   p50 %7.2f   p99 %7.2f   max %7.2f ms\n", what, values.size(), values.front(), at(0.5), at(0.99),
                values.back());
    return at(0.5);
}

/// Lets the event loop turn until `condition` holds; false after ten seconds.
template <typename Condition>
bool waitUntil(Condition condition)
{
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > limit)
            return false;
        QCoreApplication::processEvents(QEventLoop::AllEvents, 1);
    }
    return true;
}

/// The largest time that this process was kept from running while nothing else happened: what the machine itself adds.
double largestStall()
{
    double largest = 0;
    auto last = std::chrono::steady_clock::now();
    const auto end = last + std::chrono::seconds(2);
    while (last < end) {
        const auto now = std::chrono::steady_clock::now();
        largest = std::max(largest, milliseconds(now - last));
        last = now;
    }
    return largest;
}

struct Openings {
    std::vector<double> sessions;   ///< from the request to Open; two connections, one each way
    std::vector<double> handshakes; ///< of one connection with the same certificates, nothing of ours above it
};

/// In turns, so that the machine's noise meets both.
Openings openings(int rounds)
{
    TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"}, {"tls", referenceTiming});
    TestDevice robot(system.settingsOf("robot"));
    TestDevice cockpit(system.settingsOf("cockpit"));
    BareHandshakes bare(system, "cockpit", "robot");
    const auto peer = system.idOf("robot");
    Openings times;
    for (int i = 0; i < rounds; ++i) {
        times.handshakes.push_back(milliseconds(bare.next()));
        const auto count = cockpit.events(Kind::Opened).size();
        if (!cockpit->openChannel(peer) || !waitUntil([&] { return cockpit.events(Kind::Opened).size() > count; }))
            break;
        times.sessions.push_back(milliseconds(cockpit.events(Kind::Opened).back().duration));
        (void)cockpit->closeChannel(peer);
        if (!waitUntil(
                [&] { return cockpit.state(peer) == SessionState::Closed && robot.state(system.idOf("cockpit")) == SessionState::Closed; }))
            break;
    }
    return times;
}

std::vector<double> detections(int rounds)
{
    std::vector<double> times;
    for (int i = 0; i < rounds; ++i) {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"}, {"tls", referenceTiming});
        ChildProcess robot(QStringLiteral("liena-device"), QStringList{QStringLiteral("robot")} + system.argumentsOf("robot"));
        if (!robot.waitForLine(QStringLiteral("listening on")))
            break;
        TestDevice cockpit(system.settingsOf("cockpit"));
        const auto peer = system.idOf("robot");
        if (!cockpit->openChannel(peer) || !waitUntil([&] { return cockpit.state(peer) == SessionState::Open; }))
            break;
        const auto frozen = std::chrono::steady_clock::now();
        robot.freeze();
        const auto lost = [&]() -> std::optional<SessionEvent> {
            for (const auto& event : cockpit.events(Kind::StateChanged, peer))
                if (event.to == SessionState::Reconnecting)
                    return event;
            return std::nullopt;
        };
        if (!waitUntil([&] { return lost().has_value(); }))
            break;
        times.push_back(milliseconds(lost()->at - frozen));
    }
    return times;
}

} // namespace

int main(int argc, char** argv)
{
    const QCoreApplication application(argc, argv);
    std::printf("largest stall of this machine in an idle loop: %.1f ms\n", largestStall());
    const auto opened = openings(50);
    const auto noticed = detections(20);
    if (opened.sessions.empty() || noticed.empty()) {
        std::fprintf(stderr, "session_bench: the devices did not open a session\n");
        return 1;
    }
    const auto handshake = print("bare TLS handshake, both ends verified", opened.handshakes);
    const auto session = print("open, request to Open (TLS, one machine)", opened.sessions);
    std::printf("%-44s %.2f\n", "open / two bare handshakes, medians", session / (2 * handshake));
    print("frozen peer noticed (lost = 110 ms)", noticed);
    return 0;
}
