// The frames of the last minute, for review.
#pragma once

#include "model/log_moments.hpp"
#include "model/xray_frame.hpp"

#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>

namespace console {

/// Keeps copies of frames as they were encoded, since the buffers they came in are the network's. What is older than a minute goes, and the
/// oldest goes sooner when the memory is used up. Any thread.
class CineRing {
public:
    static constexpr std::chrono::seconds longest{60};
    static constexpr std::chrono::seconds longestGap{2}; ///< frames further apart are not of one run

    /// A quarter of the computer's memory, from 512 MiB to 4 GiB: a minute of 1024 x 1024 pixels of 16 bits at 30 pictures a second takes
    /// 3.5 GiB. It is taken as frames come.
    static std::size_t usualBytes();

    CineRing() : CineRing(usualBytes()) {}
    explicit CineRing(std::size_t mostBytes) : m_mostBytes(mostBytes) {}

    /// A frame larger than the whole ring is not kept.
    void add(const XrayFrame& frame);

    /// Frames are numbered as they come, and keep their number while others go.
    struct Range {
        quint64 first = 0;
        quint64 end = 0; ///< behind the last

        bool isEmpty() const { return first == end; }
    };
    Range range() const;

    /// Nothing when it is gone or not yet there.
    std::shared_ptr<const XrayFrame> at(quint64 number) const;

    struct OfMoment {
        MomentPicture picture = MomentPicture::NotTaken;
        quint64 number = 0; ///< of the frame, when it is kept
    };
    /// The last frame that was here by `moment`, if it came within the `longestGap` before. By arrivals: no clock that is set, here or at
    /// the X-ray system, leads to another frame.
    OfMoment frameOf(Instant moment) const;

    std::size_t bytes() const;

    /// From the oldest frame to the newest, by their arrivals.
    Duration span() const;

private:
    void dropOldest();

    mutable std::mutex m_mutex;
    std::size_t m_mostBytes;
    std::size_t m_bytes = 0;
    quint64 m_first = 0;
    std::deque<std::shared_ptr<const XrayFrame>> m_frames;
};

} // namespace console
