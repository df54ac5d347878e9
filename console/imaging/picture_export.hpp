// Saving a picture: as PNG, and as a DICOM Secondary Capture.
#pragma once

#include "imaging/display_picture.hpp"

#include <QByteArray>
#include <QImage>
#include <QString>

namespace console {

/// What a saved picture says of itself in words: role, source, time of the pulse.
QString exportWords(const DisplayPicture& picture);

/// `liena_2026-01-31T12-03-41.250_review_run3_frame17`, without folder and ending; times in UTC.
QString exportName(const DisplayPicture& picture);

/// The pane as it was seen, and below it in a line of its own what was saved: on paper nothing is live.
QImage withBanner(const QImage& pane, const DisplayPicture& picture);

/// Each writes the whole file or leaves what was there: empty, or one sentence with the file, the reason and what to do. Any thread.
QString savePng(const QImage& image, const QString& path);

/// Unique identifiers of what belongs together.
struct CaptureSeries {
    QByteArray study;
    QByteArray series;

    static CaptureSeries begin();
};

/// The picture as it is displayed, 8 bits, DICOM PS3.3 A.8.1. What it is stands in its pixels and in its attributes. No patient is named:
/// what the console shows as one was typed at its start, and nobody has checked it against the X-ray system's. A picture that is not from
/// the X-ray system's live beam is marked as one for quality control.
QString saveSecondaryCapture(const DisplayPicture& picture, const QString& path, const CaptureSeries& series = CaptureSeries::begin());

} // namespace console
