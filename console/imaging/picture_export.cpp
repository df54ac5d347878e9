// Saving a picture: names, words, PNG, and the one way of writing a file whole.
#include "imaging/picture_export.hpp"

#include "imaging/file_writing.hpp"
#include "imaging/pane_colours.hpp"
#include "imaging/picture_marks.hpp"
#include "imaging/text_plates.hpp"

#include <QBuffer>
#include <QCoreApplication>
#include <QDateTime>
#include <QPainter>
#include <QSaveFile>
#include <QTimeZone>

#include <algorithm>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::PictureExport)
};

QString roleName(PictureRole role)
{
    switch (role) {
    case PictureRole::Live:
        return QStringLiteral("live");
    case PictureRole::Hold:
        return QStringLiteral("hold");
    case PictureRole::Review:
        return QStringLiteral("review");
    case PictureRole::Roadmap:
        return QStringLiteral("roadmap");
    }
    return QStringLiteral("picture");
}

/// A hold and a review are of another time whatever the live picture is.
bool followsLive(PictureRole role) { return role == PictureRole::Live || role == PictureRole::Roadmap; }

} // namespace

QString exportWords(const Snapshot& snapshot)
{
    const DisplayPicture& picture = snapshot.picture;
    // Saved, nothing is live any more.
    QStringList words{picture.role == PictureRole::Live ? Text::tr("SNAPSHOT") : roleWords(picture)};
    const bool wasLive = snapshot.condition == PictureCondition::Live || snapshot.condition == PictureCondition::None;
    if (followsLive(picture.role) && !wasLive)
        words << word(snapshot.condition);
    if (picture.about.source != PictureSource::Live)
        words << word(picture.about.source);
    if (const PictureReduction reduction = reductionOf(picture.about); reduction.stands())
        words << line(reduction);
    words << Text::tr("picture of %1").arg(clockTime(picture.about.captureNs));
    return words.join(QStringLiteral("  "));
}

QString exportName(const DisplayPicture& picture)
{
    const auto time = QDateTime::fromMSecsSinceEpoch(static_cast<qint64>(picture.about.captureNs / 1'000'000), QTimeZone::utc());
    return QStringLiteral("liena_%1_%2_run%3_frame%4")
        .arg(time.toString(QStringLiteral("yyyy-MM-ddTHH-mm-ss.zzz")), roleName(picture.role))
        .arg(picture.about.acquisition)
        .arg(picture.about.frame);
}

QImage withBanner(const QImage& pane, const Snapshot& snapshot)
{
    if (pane.isNull())
        return {};
    QImage pixels = pane;
    pixels.setDevicePixelRatio(1); // on a scaled screen it would be drawn smaller than it is
    QFont font;
    font.setPixelSize(std::clamp(pane.width() / 40, 10, 40));
    font = fitted(font, {exportWords(snapshot)}, pane.width());
    QImage image(pane.width(), pane.height() + 2 * font.pixelSize(), QImage::Format_RGB32);
    image.fill(pane_colours::background);
    QPainter painter(&image);
    painter.drawImage(0, 0, pixels);
    painter.setFont(font);
    painter.setPen(pane_colours::text);
    painter.drawText(QRect(0, pane.height(), pane.width(), 2 * font.pixelSize()), Qt::AlignCenter, exportWords(snapshot));
    return image;
}

QString writeWhole(const QByteArray& bytes, const QString& path)
{
    QSaveFile file(path);
    const bool written = file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size() && file.commit();
    if (written)
        return {};
    return Text::tr("%1 cannot be written: %2. Nothing was saved; make room on the disk or name another folder.")
        .arg(path, file.errorString());
}

QString savePng(const QImage& image, const QString& path)
{
    QByteArray bytes;
    QBuffer buffer(&bytes);
    if (image.isNull() || !buffer.open(QIODevice::WriteOnly) || !image.save(&buffer, "PNG"))
        return Text::tr("%1 cannot be written: there is no picture, or no memory for it. Save again.").arg(path);
    return writeWhole(bytes, path);
}

} // namespace console
