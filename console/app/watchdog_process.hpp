// The watchdog as the console has it: started, beaten to, and told when the console goes.
#pragma once

#include "model/instant.hpp"

#include <QObject>
#include <QProcess>
#include <QString>

#include <optional>

namespace console {

/// GUI thread only: a thread that hangs does not beat.
class WatchdogProcess : public QObject {
    Q_OBJECT
public:
    explicit WatchdogProcess(const QString& program, const QStringList& arguments = {}, QObject* parent = nullptr);
    ~WatchdogProcess() override; ///< says goodbye; the process has ended when this returns

    /// Twenty times a second. Starts the process, and anew when it has ended, at most every five seconds. `attended`: a person relies on
    /// what this console sounds, so that its silence must be heard.
    void beat(bool attended, Instant now);

    qint64 processId() const { return m_process.processId(); }

Q_SIGNALS:
    /// Why nobody watches; empty: somebody does. The first time in any case.
    void troubleChanged(const QString& trouble);

    /// Whether it has no sound, as it says itself. Heard, at first.
    void silentChanged(bool silent);

private:
    void start(Instant now);
    void tell(const QString& trouble);

    QString m_program;
    QStringList m_arguments;
    QProcess m_process;
    std::optional<Instant> m_started;
    std::optional<Instant> m_answered;
    std::optional<QString> m_told;
    bool m_silent = false;
};

} // namespace console
