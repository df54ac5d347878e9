// Plays bursts on the default sound output.
#pragma once

#include "sound/player_words.hpp"

#include <QBuffer>
#include <QObject>
#include <QTimer>

#include <memory>
#include <optional>

class QAudioSink;
class QMediaDevices;

namespace console {

class BurstPlayer : public QObject {
    Q_OBJECT
public:
    BurstPlayer();
    ~BurstPlayer() override;

    void open();

    /// From its beginning, in place of what sounds; nothing: silence. Without an output it waits for one.
    void follow(std::optional<AlarmPriority> wish);

Q_SIGNALS:
    void troubleChanged(const console::SoundTrouble& trouble); ///< the first time in any case
    void sounded();                                            ///< the newest wish, to its end, as far as can be known

private:
    void openOutput();
    bool lookForOutput();
    void play();
    void tell(const SoundTrouble& trouble);
    void readSink();
    void noteEnd();

    std::optional<AlarmPriority> m_wish; ///< that has not sounded to its end
    std::unique_ptr<QMediaDevices> m_devices;
    QTimer m_look;
    QTimer m_end;        ///< the wish has been heard whole by then
    QByteArray m_output; ///< that was looked at last, open or not; empty: there was none
    std::unique_ptr<QAudioSink> m_sink;
    QBuffer m_samples;
    std::optional<SoundTrouble> m_told;
};

} // namespace console
