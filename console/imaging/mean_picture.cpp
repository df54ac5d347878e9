// The mean of the last pictures of a run.
#include "imaging/mean_picture.hpp"

#include "imaging/exposure.hpp"
#include "imaging/frame_decoder.hpp"

#include <cstdint>
#include <exception>
#include <utility>

namespace console {

namespace {

bool isSameFrame(const XrayFrame& one, const XrayFrame& other)
{
    return one.frame == other.frame && one.acquisition == other.acquisition && one.captureNs == other.captureNs;
}

/// An X-ray system that was started anew counts its runs and pictures from the first again.
bool comesBefore(const XrayFrame& one, const XrayFrame& other) { return one.frame < other.frame && one.captureNs <= other.captureNs; }

template <typename Value>
void divide(const cv::Mat& sum, int count, cv::Mat& mean)
{
    for (int row = 0; row < sum.rows; ++row) {
        const auto* from = sum.ptr<std::int32_t>(row);
        auto* to = mean.ptr<Value>(row);
        for (int column = 0; column < sum.cols; ++column)
            to[column] = static_cast<Value>((from[column] + count / 2) / count);
    }
}

} // namespace

void PictureMean::add(const cv::Mat& stored)
{
    if (m_count++ == 0) {
        m_type = stored.type();
        stored.convertTo(m_sum, CV_32S);
    } else {
        cv::add(m_sum, stored, m_sum, cv::noArray(), CV_32S);
    }
}

void PictureMean::writeTo(cv::Mat& stored) const
{
    stored.create(m_sum.rows, m_sum.cols, m_type);
    if (m_type == CV_8UC1)
        divide<std::uint8_t>(m_sum, m_count, stored);
    else
        divide<std::uint16_t>(m_sum, m_count, stored);
}

SharedFrames framesForMean(const CineRing& ring, const XrayFrame& last, std::size_t most, Instant restSince)
{
    SharedFrames frames;
    const CineRing::Range range = ring.range();
    for (quint64 behind = range.end; behind > range.first && frames.size() < most; --behind) {
        auto frame = ring.at(behind - 1);
        if (!frame || (frames.empty() && frame->arrival < last.arrival))
            break;
        if (frames.empty() && !isSameFrame(*frame, last))
            continue; // it came after the run
        const bool goesWith =
            frames.empty() || (comesBefore(*frame, *frames.back()) && sameExposure(*frame, last) && frame->earliestCapture() >= restSince);
        if (!goesWith)
            break;
        frames.push_back(std::move(frame));
    }
    return frames;
}

int meanWith(const XrayFrame& newest, std::span<const std::shared_ptr<const XrayFrame>> earlier, cv::Mat& stored)
{
    if (earlier.empty())
        return 1;
    try {
        PictureMean mean;
        mean.add(stored);
        const double brightness = brightnessOf(stored);
        cv::Mat decoded;
        for (const auto& frame : earlier) {
            if (!sameExposure(*frame, newest) || !decodeFrame(*frame, decoded).isEmpty() ||
                !sameBrightness(brightness, brightnessOf(decoded)))
                break;
            mean.add(decoded);
        }
        mean.writeTo(stored);
        return mean.count();
    } catch (const std::exception&) { // no memory: the last picture alone is as good as it was
        return 1;
    }
}

} // namespace console
