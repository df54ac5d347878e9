// Saves pictures beside the work of the console.
#include "imaging/picture_saver.hpp"

#include "imaging/picture_export.hpp"

#include <QDir>
#include <QFile>

#include <utility>

namespace console {

namespace {

/// A picture that was saved already, perhaps without a measurement on it, stays.
QString freePath(const QString& wanted)
{
    constexpr int most = 1000;
    QString path = wanted;
    for (int copy = 2; copy < most && (QFile::exists(path + QStringLiteral(".dcm")) || QFile::exists(path + QStringLiteral(".png")));
         ++copy)
        path = wanted + QStringLiteral("_%1").arg(copy);
    return path;
}

} // namespace

PictureSaver::PictureSaver(QString folder, QObject* parent) : QObject(parent), m_folder(std::move(folder)) {}

PictureSaver::~PictureSaver()
{
    if (m_thread.joinable())
        m_thread.join();
}

void PictureSaver::save(const Snapshot& snapshot, const QImage& pane)
{
    if (m_busy) {
        Q_EMIT failed(tr("A picture is still being saved. Save again when it is done."));
        return;
    }
    if (m_thread.joinable())
        m_thread.join();
    m_busy = true;
    m_thread = std::thread([this, snapshot, pane, folder = m_folder, series = m_series] {
        const QString path = freePath(QDir(folder).filePath(exportName(snapshot.picture)));
        QString reason;
        if (!QDir().mkpath(folder))
            reason = tr("The folder %1 cannot be made. Name another one with --pictures or in the preferences (Ctrl+,).").arg(folder);
        const QString dicom = path + QStringLiteral(".dcm");
        if (reason.isEmpty())
            reason = saveSecondaryCapture(snapshot, dicom, series);
        if (reason.isEmpty()) {
            reason = savePng(withBanner(pane, snapshot), path + QStringLiteral(".png"));
            if (!reason.isEmpty())
                QFile::remove(dicom); // both or none
        }
        QMetaObject::invokeMethod(
            this, [this, path, reason] { finish(path, reason); }, Qt::QueuedConnection);
    });
}

void PictureSaver::finish(const QString& path, const QString& reason)
{
    m_busy = false;
    if (reason.isEmpty())
        Q_EMIT saved(path);
    else
        Q_EMIT failed(reason);
}

} // namespace console
