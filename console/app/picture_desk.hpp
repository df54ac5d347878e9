// Everything between a frame and the surgeon's eyes: the chain, the two picture panes and what is done with pictures.
#pragma once

#include "app/command_line.hpp"
#include "imaging/cine_review.hpp"
#include "imaging/cine_ring.hpp"
#include "imaging/frame_pipeline.hpp"
#include "imaging/image_hold.hpp"
#include "imaging/picture_saver.hpp"
#include "imaging/roadmap_maker.hpp"
#include "imaging/roadmap_request.hpp"
#include "model/console_models.hpp"
#include "model/display_state.hpp"

#include <QObject>
#include <QPointer>
#include <QTimer>

#include <optional>
#include <vector>

namespace console {

class CockpitWindow;
class LiveImageView;
class LogView;
class PictureCanvas;
class ReferenceImageView;
class ReviewControls;

/// GUI thread only. What it says for the log, and the reasons for what it could not do, go to `models`.
class PictureDesk : public QObject {
    Q_OBJECT
public:
    PictureDesk(const Options& options, ConsoleModels& models, QObject* parent = nullptr);

    /// Reads the measurement of the display, when one was named; false with one sentence in `error`.
    bool prepare(QString* error);

    /// Gives the window its live and its reference pane.
    void build(CockpitWindow& window);

    /// Folder of saved pictures, from the next one on; empty: the person's own.
    void setFolder(const QString& folder);

    /// Of how many pictures the last image hold is the mean, from the next one on; 1: the last picture.
    void setHoldPictures(int pictures) { m_hold.setPictures(pictures); }

    /// Another pane with what the reference pane shows, for a place of its own; the caller's. After build().
    ReferenceImageView* makeReferenceCopy();

    /// Lets the log lead to the pictures of its lines, and follow the review; after build(). `log` goes first.
    void joinLog(LogView& log);

    FramePipeline& pipeline() { return m_pipeline; }
    DisplayState& display() { return m_display; }

private:
    void equip(PictureCanvas& pane);

    /// The pane in which a person set the last point; the live one before.
    PictureCanvas& measured() const;
    void connectLive();
    void connectReference();
    void connectRoadmap();
    void connectSaving();
    void followCondition();
    void showHold();
    void showReview();
    void reviewAt(Instant moment);
    void beginRoadmap(const MadeRoadmap& made);
    void endRoadmap();
    void mapPicture(const DisplayPicture& live);
    void showVessels();
    void showReference(const DisplayPicture& picture);
    std::vector<ReferenceImageView*> references() const;
    void showPlace(const QString& place);
    void saveLive();
    void saveReference();
    void save(const DisplayPicture& picture, PictureCanvas& pane);
    void note(bool trouble, const QString& text);

    /// The same where the button is that was pressed.
    void answer(bool trouble, const QString& text);

    const QString m_displayFile;
    const PatientIdentity m_patient;
    ConsoleModels& m_models;
    CineRing m_ring;
    RoadmapMaker m_maker;
    FramePipeline m_pipeline;
    CineReview m_review;
    TableRest m_table;
    ImageHold m_hold;
    RoadmapRequest m_roadmapRequest;
    PictureSaver m_saver;
    DisplayState m_display;
    std::optional<DisplayPicture> m_held;
    PictureCondition m_condition = PictureCondition::Live; ///< of the live picture, as the reference panes were told
    QTimer m_clock;
    QImage m_vessels;                          ///< of the roadmap that is wanted
    bool m_roadmapRemoved = false;             ///< and none was made since
    quint32 m_displacementSeen = 0;            ///< frame
    LiveImageView* m_live = nullptr;           ///< the window's
    ReferenceImageView* m_reference = nullptr; ///< the window's
    std::vector<QPointer<ReferenceImageView>> m_copies;
    QPointer<PictureCanvas> m_measured;
    ReviewControls* m_reviewControls = nullptr; ///< the window's
    PictureCanvas* m_saving = nullptr;          ///< whose picture is being saved
};

} // namespace console
