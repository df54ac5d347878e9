// Saving a picture: as PNG, and as a DICOM Secondary Capture.
#pragma once

#include "imaging/display_picture.hpp"
#include "imaging/measurement.hpp"

#include <QByteArray>
#include <QImage>
#include <QString>

namespace console {

/// As the console was told at its start; nobody has checked it against the X-ray system's. Both or neither.
struct PatientIdentity {
    QString name;
    QString number;
};

/// A picture as it was seen when somebody asked for it to be saved.
struct Snapshot {
    DisplayPicture picture;
    PictureCondition condition = PictureCondition::Live; ///< of the live picture then
    Measurement measurement{};                           ///< on this picture
    PatientIdentity patient{};
};

/// What a saved picture says of itself in words: role, of how many pictures it is a mean, why it was not live, source, how it was reduced,
/// time of the pulse.
QString exportWords(const Snapshot& snapshot);

/// `liena_2026-01-31T12-03-41.250_review_run3_frame17`, without folder and ending; times in UTC.
QString exportName(const DisplayPicture& picture);

/// The pane as it was seen, and below it in a line of its own what was saved: on paper nothing is live.
QImage withBanner(const QImage& pane, const Snapshot& snapshot);

/// Each writes the whole file or leaves what was there: empty, or one sentence with the file, the reason and what to do. Any thread.
QString savePng(const QImage& image, const QString& path);

/// Unique identifiers of what belongs together.
struct CaptureSeries {
    QByteArray study;
    QByteArray series;

    static CaptureSeries begin();
};

/// The picture as it is displayed, 8 bits a sample, DICOM PS3.3 A.8.1: P-values (PS3.14) whatever display it is seen on, so that a
/// workstation applies its own curve and no other; RGB where a roadmap's vessels are painted into it. What it is and what was measured on
/// it stands in its pixels and in its attributes; the letters of the sides, the scale bar, frame, run and window stand in its pixels as on
/// every pane. Of the patient the attributes say that nobody has checked the name. A picture that is not from the X-ray system's live beam
/// is marked as one for quality control.
QString saveSecondaryCapture(const Snapshot& snapshot, const QString& path, const CaptureSeries& series = CaptureSeries::begin());

} // namespace console
