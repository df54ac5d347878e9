// Pictures as an X-ray system sends them, at their rate.
#pragma once

#include "model/frame_sink.hpp"

#include <array>
#include <atomic>
#include <optional>
#include <thread>

namespace console::test {

struct Film {
    int edge = 512; ///< rows and columns
    int bits = 8;
    PixelEncoding encoding = PixelEncoding::Raw;
    int framesPerSecond = 30;
};

constexpr double mostLate = 0.5; ///< pictures a second that may be missing of those that were sent

/// The C-arm's place in every frame.
XrayGeometry filmGeometry();

/// A smooth picture with the noise of few quanta, as fluoroscopy has.
XrayFrame filmFrame(const Film& film, unsigned seed = 7);

/// Sends from a thread of its own as long as it lives, or for `span`. `sink` outlives it.
class FilmSender {
public:
    FilmSender(const Film& film, FrameSink& sink, std::optional<Duration> span = std::nullopt);
    ~FilmSender(); ///< waits for the next frame's time at most
    FilmSender(const FilmSender&) = delete;
    FilmSender& operator=(const FilmSender&) = delete;

private:
    void run();

    const std::chrono::nanoseconds m_period;
    const std::array<XrayFrame, 2> m_pictures; ///< in turn: the same one twice would be refused
    const std::optional<Duration> m_span;
    FrameSink& m_sink;
    std::atomic<bool> m_ending = false;
    std::thread m_thread; ///< last: it uses the others
};

} // namespace console::test
