// Plays bursts on the default sound output, on the loudspeaker's thread.
#pragma once

#include "model/alarm_list.hpp"

#include <QBuffer>
#include <QObject>
#include <QTimer>

#include <atomic>
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

    /// Any thread: what should sound; nothing: silence.
    void setWish(std::optional<AlarmPriority> wish);

    /// Any thread: how many calls of open() and followWish() have come back.
    quint64 served() const { return m_served; }

    // On the thread of this object.
    void open();
    void followWish();

Q_SIGNALS:
    void troubleChanged(const QString& trouble);

private:
    void openOutput();
    void lookForOutput();
    void playWish();
    void tell(const QString& trouble);
    void readSink();

    static constexpr int silent = -1;
    static constexpr int followed = -2;
    std::atomic<int> m_wish{followed};
    std::atomic<quint64> m_served{0};
    int m_played = silent; ///< last
    std::unique_ptr<QMediaDevices> m_devices;
    QTimer m_look;
    QByteArray m_output; ///< that was looked at last, open or not; empty: there was none
    std::unique_ptr<QAudioSink> m_sink;
    QBuffer m_samples;
    std::optional<QString> m_told;
};

} // namespace console
