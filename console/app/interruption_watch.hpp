// Keeps the account of an interruption: what is lost, when it is over, and how things stood before and after.
#pragma once

#include "model/console_models.hpp"

#include <QObject>
#include <QSet>

#include <functional>

namespace console {

/// GUI thread only. `models` must outlive it.
class InterruptionWatch : public QObject {
    Q_OBJECT
public:
    /// `picturesReceived`: by this console since its start.
    InterruptionWatch(ConsoleModels& models, std::function<quint64()> picturesReceived, QObject* parent = nullptr);

    /// Ten times a second.
    void update(Instant now);

    /// A person has read the account; `who` is for the log.
    void acknowledge(const QString& who, Instant now);

private:
    void begin(quint64 incident);
    void beginShort(quint32 peer);
    void beginNameless(Instant now);
    void look();
    bool standsBy() const;
    bool isDown() const; ///< that, or a link of this console is

    ConsoleModels& m_models;
    std::function<quint64()> m_picturesReceived;
    QSet<quint32> m_interrupted;    ///< told of, and neither healed nor decided
    quint64 m_picturesAtReport = 0; ///< when the newest report of the X-ray system came
};

} // namespace console
