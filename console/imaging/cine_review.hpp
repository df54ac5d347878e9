// Shows the frames of the last minute again, one by one or as a film, as pictures for review.
#pragma once

#include "imaging/cine_ring.hpp"
#include "imaging/frame_pipeline.hpp"

#include <QObject>
#include <QTimer>

#include <optional>

namespace console {

/// Decodes on a pipeline of its own, whose pictures all have the role of a review. The ring goes on filling meanwhile; a frame that falls
/// out of it while it is shown stays on the screen. GUI thread only; `ring` outlives it.
class CineReview : public QObject {
    Q_OBJECT
public:
    explicit CineReview(const CineRing& ring, QObject* parent = nullptr);

    bool isOpen() const { return m_place.has_value(); }
    bool isPlaying() const { return m_timer.isActive(); }

    /// At the newest frame, standing still; false when there is none.
    bool open();

    /// The same at the frame of that number in the ring, or at the nearest that there still is.
    bool openAt(quint64 number);
    void close();

    void step(int frames);
    void toOldest();

    /// From where it stands to what is the newest frame now, also while new ones come; from the oldest when it stands at the end.
    void setPlaying(bool playing);

    void setSettings(const DisplaySettings& settings) { m_pipeline.setSettings(settings); }
    void setGreyScale(const GreyScale& greyScale) { m_pipeline.setGreyScale(greyScale); }

    /// `12 of 180, 11.2 s before the newest`; empty while closed.
    QString place() const;

    /// Until when the frame that is shown was the newest, by arrivals: what happened by then was at this picture. Nothing while closed.
    /// While it is the newest in the ring, for as long as one counts; noteNewest() says when that is over.
    std::optional<Instant> moment() const { return m_moment; }

    /// The newest frame of all, which is in the ring or about to be.
    void noteNewest(const XrayFrame& frame);

Q_SIGNALS:
    void pictureReady(const console::DisplayPicture& picture);

    /// Another place, or other words or times for the same one.
    void placeChanged();

private:
    void show(quint64 number);
    void playOn();
    bool endMoment(Instant next);

    const CineRing& m_ring;
    FramePipeline m_pipeline;
    QTimer m_timer;
    std::optional<quint64> m_place;
    Instant m_arrival;               ///< of the frame that is shown
    std::optional<Instant> m_moment; ///< with a place only
    quint64 m_filmEnd = 0;           ///< behind its last frame
    bool m_atEnd = false;            ///< what is shown was the newest when it was shown, or the last of the film
};

} // namespace console
