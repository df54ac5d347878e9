// A sound server of the test's own, and the record of what is played to it.
#pragma once

#include "model/instant.hpp"

#include <QMap>
#include <QProcess>
#include <QString>
#include <QTemporaryDir>

#include <cstdint>
#include <optional>
#include <vector>

namespace console::test {

/// A pulseaudio with outputs that nobody hears, apart from any that runs on this computer. It ends with the object, and with the test's
/// process however that ends.
class SoundServer {
public:
    ~SoundServer();

    /// Why there can be none; empty: there can.
    static QString missing();

    /// From here on this process and those that it starts play to this server, which has no output yet. Before anything of Qt Multimedia;
    /// false when it does not answer in 30 s.
    bool start();
    void stop(); ///< as a crash does; start() has it again, without its outputs

    /// It answers nobody until it thaws.
    void freeze();
    void thaw();

    /// As a loudspeaker is plugged in; the first one is the default. False when the server refuses.
    bool addOutput(const char* name);
    bool removeOutput(const char* name);

    QString said() const; ///< what the server wrote

private:
    QString path(const char* name) const { return m_folder.filePath(QString::fromLatin1(name)); }

    QTemporaryDir m_folder;
    QProcess m_server;
    QMap<QString, QString> m_modules; ///< of outputs
};

/// Its standard output is then all that one output of the server plays, silence as well: 16 bit, one channel, 44.1 kHz. It ends with the
/// thread that starts it.
void startRecording(QProcess& recorder, const char* output);

/// Milliseconds after the record's beginning.
struct HeardPulse {
    double start = 0;
    double end = 0;
};

/// All that one output of the server plays, silence as well, as it comes. Read in the event loop of the thread that made it.
class SoundRecord {
public:
    explicit SoundRecord(const char* output);
    ~SoundRecord();
    Q_DISABLE_COPY_MOVE(SoundRecord)

    double length() const; ///< ms; 0: nothing has come yet

    /// What is loud, told apart by 10 ms of silence. The last one may still sound.
    std::vector<HeardPulse> pulsesSince(double start) const;

    /// Something has sounded since `start`, and then nothing for `quiet` ms.
    bool hasFallenSilent(double start, double quiet) const;

    double pitchOf(const HeardPulse& pulse) const; ///< Hz, of the fundamental, between 100 and 1000

    /// When the server mixed the first sample that is not silence, and the last one.
    std::optional<Instant> firstSound(double start) const;
    std::optional<Instant> lastSound(double start) const;

private:
    void read();
    std::size_t place(double time) const;
    Instant timeOf(std::size_t place) const;

    QProcess m_recorder;
    QByteArray m_rest; ///< half a sample
    std::vector<std::int16_t> m_samples;
    Instant m_begun = Instant::max();
};

} // namespace console::test
