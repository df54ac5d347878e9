// Makes the picture panes and connects them with the chain.
#include "app/picture_desk.hpp"

#include "imaging/live_image_view.hpp"
#include "imaging/reference_image_view.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/picture_controls.hpp"
#include "widgets/picture_pane.hpp"
#include "widgets/review_controls.hpp"

#include <QDateTime>
#include <QDir>
#include <QStandardPaths>

#include <cmath>

namespace console {

namespace {

constexpr double zoomStep = 1.25;

QString folderFor(const QString& named)
{
    if (!named.isEmpty())
        return named;
    return QDir(QStandardPaths::writableLocation(QStandardPaths::PicturesLocation)).filePath(QStringLiteral("liena"));
}

} // namespace

PictureDesk::PictureDesk(const Options& options, ConsoleModels& models, QObject* parent)
    : QObject(parent), m_displayFile(options.display), m_models(models), m_review(m_ring), m_saver(folderFor(options.pictures))
{
    m_pipeline.recordInto(m_ring);
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
    return true;
}

void PictureDesk::setFolder(const QString& folder) { m_saver.setFolder(folderFor(folder)); }

void PictureDesk::build(CockpitWindow& window)
{
    m_live = new LiveImageView(m_models.picture);
    m_live->setDisplay(&m_display);
    auto* controls = new PictureControls(m_display);
    connect(controls, &PictureControls::zoomRequested, m_live, [this](int steps) { m_live->zoomBy(std::pow(zoomStep, steps)); });
    connect(controls, &PictureControls::wholeRequested, m_live, &LiveImageView::resetView);
    connect(controls, &PictureControls::saveRequested, this, &PictureDesk::saveLive);
    connect(m_live, &LiveImageView::viewChanged, controls, [this, controls] { controls->showZoom(m_live->viewport().zoom()); });
    m_reference = new ReferenceImageView;
    m_reference->setDisplay(&m_display);
    m_reviewControls = new ReviewControls;
    window.setLiveView(new PicturePane(m_live, controls));
    window.setReferenceView(new PicturePane(m_reference, m_reviewControls));
    connectLive();
    connectReference();
    connectSaving();
}

void PictureDesk::connectLive()
{
    connect(&m_display, &DisplayState::changed, this, [this](const DisplaySettings& settings) {
        m_pipeline.setSettings(settings);
        m_review.setSettings(settings);
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
    connect(m_live, &LiveImageView::conditionChanged, this, [this](PictureCondition condition) {
        if (condition == PictureCondition::Held)
            m_hold.endRun();
    });
    connect(&m_hold, &ImageHold::held, this, [this](const DisplayPicture& picture) {
        m_held = picture;
        if (!m_review.isOpen())
            showHold();
    });
    connect(&m_review, &CineReview::pictureReady, this, &PictureDesk::showReference);
    connect(&m_review, &CineReview::placeChanged, this, [this] {
        showPlace(m_review.place());
        m_reviewControls->showReview(m_review.isOpen(), m_review.isPlaying());
    });
    connect(m_reviewControls, &ReviewControls::holdRequested, this, &PictureDesk::showHold);
    connect(m_reviewControls, &ReviewControls::reviewRequested, this, [this] {
        if (!m_review.open())
            note(false, tr("there is nothing to review yet"));
    });
    connect(m_reviewControls, &ReviewControls::oldestRequested, &m_review, &CineReview::toOldest);
    connect(m_reviewControls, &ReviewControls::stepRequested, &m_review, &CineReview::step);
    connect(m_reviewControls, &ReviewControls::playRequested, &m_review, &CineReview::setPlaying);
    connect(m_reviewControls, &ReviewControls::saveRequested, this, &PictureDesk::saveReference);
}

void PictureDesk::connectSaving()
{
    connect(&m_saver, &PictureSaver::saved, this, [this](const QString& path) { note(false, tr("picture saved: %1").arg(path)); });
    connect(&m_saver, &PictureSaver::failed, this, [this](const QString& reason) { note(true, reason); });
}

void PictureDesk::showHold()
{
    m_review.close();
    if (m_held)
        showReference(*m_held);
}

void PictureDesk::showReference(const DisplayPicture& picture)
{
    m_reference->showPicture(picture);
    if (m_copy)
        m_copy->showPicture(picture);
}

void PictureDesk::showPlace(const QString& place)
{
    m_reference->setPlace(place);
    if (m_copy)
        m_copy->setPlace(place);
}

ReferenceImageView* PictureDesk::makeReferenceCopy()
{
    m_copy = new ReferenceImageView;
    m_copy->setDisplay(&m_display);
    if (m_reference->picture())
        m_copy->showPicture(*m_reference->picture());
    showPlace(m_review.place());
    return m_copy;
}

void PictureDesk::saveLive()
{
    if (m_live->picture())
        m_saver.save(*m_live->picture(), m_live->grab().toImage());
}

void PictureDesk::saveReference()
{
    if (m_reference->picture())
        m_saver.save(*m_reference->picture(), m_reference->grab().toImage());
}

void PictureDesk::note(bool trouble, const QString& text)
{
    m_models.log.append(trouble ? LogKind::Trouble : LogKind::Note, text, QDateTime::currentMSecsSinceEpoch());
}

} // namespace console
