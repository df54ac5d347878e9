// What contrast filled during a run: the vessels of a roadmap.
#pragma once

#include "model/xray_frame.hpp"

#include <QImage>
#include <QPointF>

#include <opencv2/core.hpp>

#include <optional>

namespace console {

/// The vessels of one run. A value; immutable once made, any thread.
struct Roadmap {
    cv::Mat vessels;    ///< CV_8UC1, coarser than the picture: 0 … 255, how much of the beam contrast took away there
    cv::Mat background; ///< CV_32FC1, detail of the picture before contrast, coarser still: where the patient lay
    XrayFrame about;    ///< the run's first picture, without its pixels
    quint64 lastNs = 0; ///< its last picture's pulse
    int pictures = 0;   ///< that it is made of
};

/// What is painted over a picture for it, in the colour of roadmaps: clear where nothing was filled.
QImage vesselLayer(const Roadmap& roadmap);

/// Peak opacification: the most that each pixel was darkened in a run, R = max D over its time, with D = ln M - ln C, M the mean of the
/// first pictures and C those after them (Harrington, AJR 1982;139:781; DICOM PS3.3 C.8.19.7 has the logarithmic space). Noise darkens as
/// well, and the more the longer a run is; but it brightens as much, which contrast does not, so that the most by which a pixel was
/// brightened is taken off; and each picture is made as bright on the whole as the first ones. A wire that moves in the run is in it as
/// well. One thread at a time.
class Opacification {
public:
    static constexpr int maskPictures = 4;
    static constexpr int leastPictures = 8;

    /// The next picture of a run, as it was stored; another run, projection or size begins anew.
    void take(const cv::Mat& stored, const XrayFrame& frame);

    Opacification copy() const; ///< with memory of its own

    /// True where `frame` cannot go on with what was taken so far.
    bool endsWith(const XrayFrame& frame) const;

    /// Nothing while the run is too short, or nothing in it was darkened by more than its noise.
    std::optional<Roadmap> roadmap() const;

    /// By how many pixels of the picture the newest one lies beside the roadmap's; nothing where the pictures have too little in common to
    /// tell. Phase correlation (Kuglin and Hines, 1975).
    std::optional<QPointF> displacement(const Roadmap& roadmap) const;

private:
    void begin(const XrayFrame& frame);

    XrayFrame m_first; ///< without pixels
    quint64 m_lastNs = 0;
    quint32 m_lastFrame = 0;
    int m_count = 0;
    cv::Mat m_coarse; ///< CV_32FC1, the newest
    cv::Mat m_mask;   ///< sum of the first
    cv::Mat m_smooth; ///< over time
    cv::Mat m_darkest;
    cv::Mat m_brightest;
};

} // namespace console
