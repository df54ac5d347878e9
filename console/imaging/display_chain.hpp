// The display chain: from a frame's bytes to a picture, in the order of DICOM PS3.4 N.2.5.
#pragma once

#include "imaging/display_picture.hpp"
#include "imaging/edge_enhancement.hpp"
#include "imaging/image_pool.hpp"
#include "imaging/multi_scale_enhancement.hpp"
#include "imaging/temporal_filter.hpp"
#include "imaging/window_level.hpp"

#include <opencv2/core.hpp>

#include <memory>
#include <optional>
#include <span>

namespace console {

/// Stored values → temporal filter → edge enhancement → VOI window → polarity and grey scale of the display → shutter. Up to the window the
/// picture keeps 16 bits or is floating-point; only the last table makes 8 bits of it. One thread at a time; its buffers are used again.
class DisplayChain {
public:
    /// A picture, or why there is none. `filterRoom`: how much older what is shown may still become; the filter's delay and the time until
    /// the next picture stay within it. With `earlier` frames of its run, the newest first, it is the mean with those that can go into it.
    QString process(const XrayFrame& frame, const DisplaySettings& settings, Duration filterRoom, DisplayPicture& picture,
                    std::span<const std::shared_ptr<const XrayFrame>> earlier = {});

    /// The last picture once more under other settings; false when there was none. For the temporal filter no time passes.
    bool redraw(const DisplaySettings& settings, DisplayPicture& picture);

    void setGreyScale(const GreyScale& greyScale) { m_table.setGreyScale(greyScale); }

    /// The last frame's values as sent, or the mean; until the next process().
    const cv::Mat& stored() const { return m_stored; }

private:
    void filter(const XrayFrame& frame, const DisplaySettings& settings, Duration room);
    bool draw(const DisplaySettings& settings, DisplayPicture& picture);
    const cv::Mat& enhanced(const DisplaySettings& settings, DisplayPicture& picture, int& fractionBits);
    bool continues(const XrayFrame& frame) const;
    double chosenK(double wanted) const;
    GreyWindow chosenWindow(const DisplaySettings& settings, bool& isAutomatic);
    GreyWindow automaticWindow(ShutterShape shape);

    cv::Mat m_incoming;  ///< what a refused frame leaves behind is never shown
    cv::Mat m_stored;    ///< as sent, or their mean
    cv::Mat m_filtered;  ///< CV_32FC1, after the temporal filter
    cv::Mat m_work;      ///< CV_32FC1, after the edge enhancement
    cv::Mat m_quantised; ///< CV_16UC1: stored values times 2 to the unused bits
    bool m_isFiltered = false;
    NoiseModel m_noise;
    int m_untilNextNoise = 0;
    double m_brightness = 0;
    double m_k = 1;
    Duration m_delay{}; ///< of the last picture, by the filter
    TemporalFilter m_temporal;
    EdgeEnhancement m_edge;
    MultiScaleEnhancement m_multiScale;
    WindowLevelTable m_table;
    AutoWindow m_autoWindow;
    std::optional<GreyWindow> m_automatic;                ///< of the present picture, once it was shown so
    ShutterShape m_automaticShutter = ShutterShape::None; ///< inside which that is
    ImagePool m_pool;
    std::optional<DisplayPicture> m_last;     ///< without its image
    std::optional<DisplayPicture> m_previous; ///< the one before it
};

} // namespace console
