// The mean of the last pictures of a run: less noise in a picture that is held.
#pragma once

#include "imaging/cine_ring.hpp"

#include <opencv2/core.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace console {

/// Of pictures of one size and depth, in whole numbers: 32 bits hold the sum of 2^15 pictures of 16 bits. One thread at a time.
class PictureMean {
public:
    /// CV_8UC1 or CV_16UC1, like the first.
    void add(const cv::Mat& stored);

    int count() const { return m_count; }

    /// Each value rounded to the nearest, a half upwards; into memory of the right size without taking any. There must be a picture.
    void writeTo(cv::Mat& stored) const;

private:
    cv::Mat m_sum; ///< CV_32SC1
    int m_type = CV_8UC1;
    int m_count = 0;
};

using SharedFrames = std::vector<std::shared_ptr<const XrayFrame>>;

/// `last` and the pictures of its run before it, the newest first, at most `most`: back to the first that was taken with another exposure,
/// or before `restSince`, when the table stood elsewhere (TableRest). Pictures that are missing between two are no end. The ring's own
/// frames, not copies of them; empty while `last` is not in the ring.
SharedFrames framesForMean(const CineRing& ring, const XrayFrame& last, std::size_t most, Instant restSince);

/// Makes `stored`, the decoded values of `newest`, the mean of it and of `earlier`, the newest first, and returns of how many pictures it
/// is. It ends at the first that differs in exposure or brightness, or cannot be decoded; 1: `stored` is as it was. Nothing is thrown.
int meanWith(const XrayFrame& newest, std::span<const std::shared_ptr<const XrayFrame>> earlier, cv::Mat& stored);

} // namespace console
