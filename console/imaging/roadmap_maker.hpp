// Keeps what a roadmap can be made of, picture by picture, and finds out whether the patient still lies where it was made.
#pragma once

#include "imaging/opacification.hpp"

#include <QPointF>

#include <memory>
#include <mutex>
#include <optional>

namespace console {

/// take() is the decoding thread's, the rest may be called by any thread.
class RoadmapMaker {
public:
    void take(const cv::Mat& stored, const XrayFrame& frame);

    /// Of the present run, or else of the last one in which contrast was seen; null when there was none.
    std::shared_ptr<const Roadmap> make() const;

    /// What was taken until now serves no more, since something moved.
    void forget();

    /// Compares pictures with it from now on, two a second; null: with none.
    void watch(std::shared_ptr<const Roadmap> roadmap);

    struct Displacement {
        quint32 frame = 0;
        QPointF pixels; ///< of the picture
    };
    /// Of the newest picture that could be compared.
    std::optional<Displacement> displacement() const;

private:
    mutable std::mutex m_mutex;
    Opacification m_run;
    bool m_forgetRun = false;
    std::shared_ptr<const Roadmap> m_last; ///< of runs before the present one
    std::shared_ptr<const Roadmap> m_watched;
    std::optional<Displacement> m_displacement;
    quint64 m_comparedNs = 0;
};

} // namespace console
