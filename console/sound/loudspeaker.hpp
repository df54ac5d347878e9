// The computer's sound output.
#pragma once

#include "sound/alarm_voice.hpp"
#include "sound/answer_watch.hpp"

#include <QTimer>

#include <memory>

class QThread;

namespace console {

class BurstPlayer;

/// On a thread of its own: opening a sound output may take seconds, and nothing of the console may wait for it. The one folder with Qt
/// Multimedia in it.
class Loudspeaker : public AlarmVoice {
    Q_OBJECT
public:
    explicit Loudspeaker(QObject* parent = nullptr);
    ~Loudspeaker() override;

    /// Looks for the output; from here on troubleChanged tells how it stands, the first time in any case.
    void start();

    void play(console::AlarmPriority priority) override;
    void silence() override;

private:
    void look();
    void noteTrouble(const QString& trouble);

    std::unique_ptr<QThread> m_thread;
    BurstPlayer* m_player; ///< lives on the thread, and ends with it
    AnswerWatch m_watch;
    QTimer m_look;
    bool m_late = false;
    QString m_trouble; ///< as the player told it last
};

} // namespace console
