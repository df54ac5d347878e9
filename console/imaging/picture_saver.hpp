// Saves pictures beside the work of the console: encoding and disk keep neither the hand nor the pictures waiting.
#pragma once

#include "imaging/picture_export.hpp"

#include <QImage>
#include <QObject>
#include <QString>

#include <thread>

namespace console {

/// GUI thread only; each saving runs on a thread of its own, one at a time.
class PictureSaver : public QObject {
    Q_OBJECT
public:
    explicit PictureSaver(QString folder, QObject* parent = nullptr);
    ~PictureSaver() override;

    /// From the next saving on.
    void setFolder(const QString& folder) { m_folder = folder; }

    /// `pane` as it is seen becomes a PNG, `snapshot` a Secondary Capture, side by side in the folder, which is made when it is missing.
    void save(const Snapshot& snapshot, const QImage& pane);

    bool isBusy() const { return m_busy; }

Q_SIGNALS:
    void saved(const QString& path); ///< without the ending
    void failed(const QString& reason);

private:
    void finish(const QString& path, const QString& reason);

    QString m_folder;
    const CaptureSeries m_series = CaptureSeries::begin(); ///< of everything that this run of the console saves
    bool m_busy = false;
    std::thread m_thread;
};

} // namespace console
