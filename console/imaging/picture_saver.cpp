// Saves pictures beside the work of the console.
#include "imaging/picture_saver.hpp"

#include "imaging/picture_export.hpp"

#include <QDir>

#include <utility>

namespace console {

PictureSaver::PictureSaver(QString folder, QObject* parent) : QObject(parent), m_folder(std::move(folder)) {}

PictureSaver::~PictureSaver()
{
    if (m_thread.joinable())
        m_thread.join();
}

void PictureSaver::save(const DisplayPicture& picture, const QImage& pane)
{
    if (m_busy) {
        Q_EMIT failed(tr("A picture is still being saved. Save again when it is done."));
        return;
    }
    if (m_thread.joinable())
        m_thread.join();
    m_busy = true;
    m_thread = std::thread([this, picture, pane] {
        const QString path = QDir(m_folder).filePath(exportName(picture));
        QString reason;
        if (!QDir().mkpath(m_folder))
            reason = tr("The folder %1 cannot be made. Name another one with --pictures.").arg(m_folder);
        if (reason.isEmpty())
            reason = savePng(withBanner(pane, picture), path + QStringLiteral(".png"));
        if (reason.isEmpty())
            reason = saveSecondaryCapture(picture, path + QStringLiteral(".dcm"));
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
