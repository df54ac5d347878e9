// Makes the picture panes and connects them with the chain.
#include "app/picture_desk.hpp"

#include "imaging/live_image_view.hpp"
#include "imaging/reference_image_view.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/log_view.hpp"
#include "widgets/picture_controls.hpp"
#include "widgets/picture_pane.hpp"
#include "widgets/review_controls.hpp"
#include "widgets/theme.hpp"

#include <QDateTime>
#include <QDir>
#include <QGuiApplication>
#include <QStandardPaths>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace console {

namespace {

constexpr double zoomStep = 1.25;
constexpr int conditionMs = 100;

QString folderFor(const QString& named)
{
    if (!named.isEmpty())
        return named;
    return QDir(QStandardPaths::writableLocation(QStandardPaths::PicturesLocation)).filePath(QStringLiteral("liena"));
}

} // namespace

PictureDesk::PictureDesk(const Options& options, ConsoleModels& models, QObject* parent)
    : QObject(parent),
      m_displayFile(options.display),
      m_patient{options.patient, options.patientId},
      m_models(models),
      m_review(m_ring),
      m_hold(m_ring, m_table),
      m_roadmapRequest(m_maker),
      m_saver(folderFor(options.pictures))
{
    m_pipeline.recordInto(m_ring);
    m_pipeline.mapInto(m_maker);
}

bool PictureDesk::prepare(QString* error)
{
    if (m_displayFile.isEmpty())
        return true;
    const DisplayMeasurementResult read = readDisplayMeasurement(m_displayFile);
    if (!read.measurement) {
        *error = read.error;
        return false;
    }
    const GreyScale scale(*read.measurement);
    m_pipeline.setGreyScale(scale);
    m_review.setGreyScale(scale);
    m_hold.setGreyScale(scale);
    return true;
}

void PictureDesk::setFolder(const QString& folder) { m_saver.setFolder(folderFor(folder)); }

void PictureDesk::build(CockpitWindow& window)
{
    m_live = new LiveImageView(m_models.picture);
    equip(*m_live);
    auto* controls = new PictureControls(m_display);
    connect(controls, &PictureControls::zoomRequested, m_live, [this](int steps) { m_live->zoomBy(std::pow(zoomStep, steps)); });
    connect(controls, &PictureControls::wholeRequested, m_live, &LiveImageView::resetView);
    connect(controls, &PictureControls::saveRequested, this, &PictureDesk::saveLive);
    connect(controls, &PictureControls::catheterRequested, this, [this] { measured().nextCatheter(); });
    connect(controls, &PictureControls::planeRequested, this, [this] { measured().nextPlane(); });
    connect(m_live, &LiveImageView::viewChanged, controls, [this, controls] { controls->showZoom(m_live->viewport().zoom()); });
    m_reference = new ReferenceImageView;
    equip(*m_reference);
    m_reviewControls = new ReviewControls;
    window.setLiveView(new PicturePane(m_live, controls));
    window.setReferenceView(new PicturePane(m_reference, m_reviewControls));
    connectLive();
    connectReference();
    connectRoadmap();
    connectSaving();
    connect(&m_clock, &QTimer::timeout, this, &PictureDesk::followCondition);
    m_clock.start(conditionMs);
}

void PictureDesk::equip(PictureCanvas& pane)
{
    theme::setTextRole(&pane, theme::TextRole::Caption);
    pane.setDisplay(&m_display);
    pane.setTable(&m_table);
    pane.setMeasuredScreen(QGuiApplication::primaryScreen());
    connect(&pane, &PictureCanvas::pointSet, this, [this, &pane] { m_measured = &pane; });
}

PictureCanvas& PictureDesk::measured() const { return m_measured ? *m_measured : *m_live; }

void PictureDesk::connectLive()
{
    connect(&m_display, &DisplayState::changed, this, [this](const DisplaySettings& settings) {
        m_pipeline.setSettings(settings);
        m_review.setSettings(settings);
        m_hold.setSettings(settings);
    });
    connect(&m_pipeline, &FramePipeline::pictureReady, m_live, &LiveImageView::showPicture);
    connect(&m_pipeline, &FramePipeline::pictureReady, &m_hold, &ImageHold::take);
    connect(&m_pipeline, &FramePipeline::pictureRefused, m_live, &LiveImageView::showRefusal);
    connect(&m_pipeline, &FramePipeline::pictureRefused, this,
            [this](quint32, const QString& reason) { m_models.picture.noteRefused(reason); });
    // The filter may delay movement by no more than the age limit leaves: with each picture anew.
    connect(m_live, &LiveImageView::picturePainted, this, [this] { m_pipeline.setFilterRoom(m_models.picture.filterRoom()); });
    connect(&m_models.picture, &PictureState::profileChanged, this, [this] { m_pipeline.setFilterRoom(m_models.picture.filterRoom()); });
}

void PictureDesk::connectReference()
{
    connect(&m_models.picture, &PictureState::runEnded, &m_hold, &ImageHold::endRun);
    connect(&m_hold, &ImageHold::held, this, [this](const DisplayPicture& picture) {
        m_held = picture;
        if (!m_review.isOpen() && !m_models.roadmap.isWanted())
            showReference(picture); // a roadmap that is being made takes its place when it is there
    });
    connect(&m_review, &CineReview::pictureReady, this, &PictureDesk::showReference);
    connect(&m_pipeline, &FramePipeline::pictureReady, &m_review,
            [this](const DisplayPicture& picture) { m_review.noteNewest(picture.about); });
    connect(&m_review, &CineReview::placeChanged, this, [this] {
        if (!m_models.roadmap.isWanted())
            showPlace(m_review.place());
        m_reviewControls->showReview(m_review.isOpen(), m_review.isPlaying());
    });
    connect(m_reviewControls, &ReviewControls::holdRequested, this, [this] {
        if (!m_held)
            answer(false, tr("no run has ended yet: there is no last image"));
        showHold();
    });
    connect(m_reviewControls, &ReviewControls::reviewRequested, this, &PictureDesk::showReview);
    connect(m_reviewControls, &ReviewControls::oldestRequested, &m_review, &CineReview::toOldest);
    connect(m_reviewControls, &ReviewControls::stepRequested, &m_review, &CineReview::step);
    connect(m_reviewControls, &ReviewControls::playRequested, &m_review, &CineReview::setPlaying);
    connect(m_reviewControls, &ReviewControls::saveRequested, this, &PictureDesk::saveReference);
}

void PictureDesk::joinLog(LogView& log)
{
    auto* picture = makeReferenceCopy();
    picture->setFocusPolicy(Qt::NoFocus); // to look at; what is done with a picture is done in its pane
    picture->setAttribute(Qt::WA_TransparentForMouseEvents);
    log.setReview([this](Instant moment) { return m_ring.frameOf(moment).picture; }, [this] { return m_ring.span(); }, picture);
    connect(&log, &LogView::reviewRequested, this, &PictureDesk::reviewAt);
    connect(&log, &LogView::reviewStepRequested, &m_review, &CineReview::step);
    connect(&log, &LogView::reviewPlayRequested, &m_review, &CineReview::setPlaying);
    connect(&m_review, &CineReview::placeChanged, &log, [this, &log] { log.showReview(m_review.moment(), m_review.isPlaying()); });
    connect(&m_pipeline, &FramePipeline::pictureReady, &log, &LogView::refreshReview);
}

void PictureDesk::connectRoadmap()
{
    auto& roadmap = m_models.roadmap;
    // Asked for again, it is made anew: from the present run, when that has contrast in it.
    connect(m_reviewControls, &ReviewControls::roadmapRequested, &m_roadmapRequest, &RoadmapRequest::make);
    connect(&m_roadmapRequest, &RoadmapRequest::answered, this, &PictureDesk::beginRoadmap);
    connect(m_reviewControls, &ReviewControls::opacityChanged, this, [this](double opacity) {
        for (auto* view : references())
            view->setOpacity(opacity);
    });
    connect(&m_pipeline, &FramePipeline::pictureReady, this, &PictureDesk::mapPicture);
    connect(&m_models.xray, &XraySystemState::statusChanged, this, [this] {
        const auto& status = m_models.xray.status();
        m_models.roadmap.noteTable(status.value.geometry.table, *status.received);
        m_table.note(status.value.geometry.table, *status.received);
        m_hold.tableReported();
        m_live->followTable();
        for (auto* view : references())
            view->followTable();
    });
    connect(&roadmap, &RoadmapState::changed, this, [this] {
        if (!m_models.roadmap.reason().isEmpty()) {
            m_roadmapRemoved = true;
            m_maker.forget();
            m_roadmapRequest.cancel();
            note(true, tr("roadmap removed: %1").arg(m_models.roadmap.reason()));
        }
        showVessels();
    });
}

void PictureDesk::connectSaving()
{
    const auto tell = [this](bool trouble, const QString& text) {
        note(trouble, text);
        if (m_saving != nullptr)
            m_saving->tell(text);
    };
    connect(&m_saver, &PictureSaver::saved, this, [tell](const QString& path) { tell(false, tr("picture saved: %1").arg(path)); });
    connect(&m_saver, &PictureSaver::failed, this, [tell](const QString& reason) { tell(true, reason); });
}

void PictureDesk::showReview()
{
    if (!m_review.open())
        return answer(false, tr("there is nothing to review yet"));
    endRoadmap();
}

/// As with showReview(), and whatever is armed: the live picture, and what may move by it, is not touched.
void PictureDesk::reviewAt(Instant moment)
{
    const auto found = m_ring.frameOf(moment);
    if (found.picture != MomentPicture::Kept || !m_review.openAt(found.number))
        return answer(false, tr("no picture of that moment is kept any more"));
    endRoadmap();
}

void PictureDesk::beginRoadmap(const MadeRoadmap& made)
{
    const auto& roadmap = made.roadmap;
    if (!roadmap)
        return answer(false, m_roadmapRemoved ? tr("no roadmap: it was removed, and no contrast was given since")
                                              : tr("no roadmap: no run has shown contrast yet; give contrast while the pedal is down"));
    m_roadmapRemoved = false;
    m_review.close();
    m_vessels = made.vessels;
    m_maker.watch(roadmap);
    m_models.roadmap.begin({roadmap->about, roadmap->lastNs});
    const bool stands = m_models.roadmap.isValid(); // else something moved since
    answer(false, stands ? tr("roadmap made of %1 pictures of run %2").arg(roadmap->pictures).arg(roadmap->about.acquisition)
                         : m_models.roadmap.line());
    if (m_live->picture())
        mapPicture(*m_live->picture());
    m_reviewControls->showRoadmap(true);
}

void PictureDesk::endRoadmap()
{
    m_roadmapRequest.cancel();
    m_models.roadmap.end();
    m_maker.watch(nullptr);
    m_vessels = {};
    m_reviewControls->showRoadmap(false);
}

/// The live picture once more, in the reference pane: the vessels never lie over the live one.
void PictureDesk::mapPicture(const DisplayPicture& live)
{
    auto& roadmap = m_models.roadmap;
    if (!roadmap.isWanted())
        return;
    roadmap.checkPicture(live.about);
    const auto displacement = m_maker.displacement();
    if (displacement && displacement->frame != m_displacementSeen) {
        m_displacementSeen = displacement->frame;
        roadmap.checkDisplacement(std::hypot(displacement->pixels.x(), displacement->pixels.y()) / std::max(1, live.about.columns));
    }
    DisplayPicture picture = live;
    picture.role = PictureRole::Roadmap;
    showReference(picture);
}

/// By the clock: while the cockpit's window is minimised its live pane is not painted, and the copies of the reference pane are in sight.
void PictureDesk::followCondition()
{
    const auto condition = m_models.picture.reading(std::chrono::steady_clock::now()).condition;
    if (std::exchange(m_condition, condition) == condition)
        return;
    if (condition == PictureCondition::Held)
        m_hold.endRun(); // of a picture that nobody expected
    showVessels();
}

void PictureDesk::showVessels()
{
    const auto& roadmap = m_models.roadmap;
    const auto condition = m_models.picture.reading(std::chrono::steady_clock::now()).condition;
    for (auto* view : references()) {
        view->setVessels(roadmap.isValid() ? m_vessels : QImage());
        view->setCondition(condition);
    }
    showPlace(roadmap.isWanted() ? roadmap.line() : m_review.place());
}

void PictureDesk::showHold()
{
    m_review.close();
    if (!m_held)
        return;
    endRoadmap();
    showReference(*m_held);
}

void PictureDesk::showReference(const DisplayPicture& picture)
{
    for (auto* view : references())
        view->showPicture(picture);
}

void PictureDesk::showPlace(const QString& place)
{
    for (auto* view : references())
        view->setPlace(place);
}

ReferenceImageView* PictureDesk::makeReferenceCopy()
{
    auto* copy = new ReferenceImageView;
    equip(*copy);
    copy->setOpacity(m_reference->opacity());
    if (m_reference->picture())
        copy->showPicture(*m_reference->picture());
    std::erase_if(m_copies, [](const auto& other) { return other.isNull(); });
    m_copies.emplace_back(copy);
    showVessels();
    return copy;
}

std::vector<ReferenceImageView*> PictureDesk::references() const
{
    std::vector<ReferenceImageView*> all{m_reference};
    for (const auto& copy : m_copies)
        if (copy)
            all.push_back(copy);
    return all;
}

void PictureDesk::saveLive()
{
    if (!m_live->picture())
        return m_live->tell(tr("there is no picture to save yet"));
    save(*m_live->picture(), *m_live);
}

void PictureDesk::saveReference()
{
    if (!m_reference->picture())
        return m_reference->tell(tr("there is no picture to save yet"));
    save(m_reference->pictureWithVessels(), *m_reference);
}

// One is saved at a time: a second wish is answered on its own pane, and the first one keeps its own.
void PictureDesk::save(const DisplayPicture& picture, PictureCanvas& pane)
{
    PictureCanvas* before = m_saver.isBusy() ? m_saving : &pane;
    pane.tell({}); // what was told before is no part of the picture
    m_saving = &pane;
    const QImage seen = pane.grab().toImage();
    const auto condition = m_models.picture.reading(std::chrono::steady_clock::now()).condition;
    m_saver.save({pane.asSeenHere(picture), condition, pane.measurement(), m_patient}, seen);
    m_saving = before;
}

void PictureDesk::answer(bool trouble, const QString& text)
{
    note(trouble, text);
    for (auto* view : references())
        view->tell(text);
}

void PictureDesk::note(bool trouble, const QString& text)
{
    m_models.log.append(trouble ? LogKind::Trouble : LogKind::Note, text, QDateTime::currentMSecsSinceEpoch());
}

} // namespace console
