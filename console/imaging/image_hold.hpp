// Keeps the last picture of a run when the run is over, or the mean of its last ones.
#pragma once

#include "imaging/cine_ring.hpp"
#include "imaging/display_picture.hpp"
#include "imaging/frame_pipeline.hpp"
#include "model/table_rest.hpp"

#include <QObject>

#include <array>
#include <optional>

namespace console {

/// The last picture is held at once, as it was shown. Where a mean is wanted, it takes that one's place with the X-ray system's next
/// report, which tells that the table had not moved; without one, or where only the last picture counts, that stays. The mean is made of
/// the frames that the ring has, on a thread of its own, whose pictures all have the role of a hold. GUI thread only; `ring` outlives it.
class ImageHold : public QObject {
    Q_OBJECT
public:
    /// `ring` and `table` outlive it.
    ImageHold(const CineRing& ring, const TableRest& table, QObject* parent = nullptr);

    /// Of how many pictures, from the next one that is held on; 1: the last picture, and no mean.
    void setPictures(int pictures) { m_pictures = pictures; }

    /// Each live picture; the first of another run ends the one before it.
    void take(const DisplayPicture& picture);

    /// The pedal is up: the picture that stands there is the run's last. Said once more before another picture comes, it changes nothing.
    void endRun();

    /// After each report that the table has noted, since a missing one says nothing.
    void tableReported();

    void setSettings(const DisplaySettings& settings);
    void setGreyScale(const GreyScale& greyScale) { m_pipeline.setGreyScale(greyScale); }

Q_SIGNALS:
    /// A copy with the role of a hold; the mean of the same picture later.
    void held(const console::DisplayPicture& picture);

private:
    void tell();
    void makeMean();
    void takeMean(const DisplayPicture& mean);

    const CineRing& m_ring;
    const TableRest& m_table;
    FramePipeline m_pipeline; ///< of means only
    int m_pictures = 1;
    std::optional<DisplayPicture> m_last;
    std::optional<quint64> m_heldNs;      ///< its run has ended with the picture that was taken then
    std::optional<DisplayPicture> m_held; ///< as it was told
    bool m_mustMean = false;              ///< of what is held
};

} // namespace console
