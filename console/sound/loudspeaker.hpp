// The computer's sound output, as a console and its watchdog have it: in a process of its own.
#pragma once

#include "sound/alarm_voice.hpp"
#include "sound/answer_watch.hpp"
#include "sound/kept_burst.hpp"
#include "sound/player_words.hpp"
#include "sound/replacement_plan.hpp"

#include <QProcess>
#include <QTimer>

#include <optional>

namespace console {

/// Its player is `liena-console-player`. Opening a sound output may take seconds, and Qt 6.4 does not find a sound server again that was
/// gone for more than three: nothing of the console waits for it, and a player that has been without sound is replaced as
/// `ReplacementPlan` has it.
///
/// Of a thread that lives as long as the program: with the thread that started it the player ends, too.
class Loudspeaker : public AlarmVoice {
    Q_OBJECT
public:
    explicit Loudspeaker(const QString& program, QObject* parent = nullptr);
    ~Loudspeaker() override; ///< the process has ended when this returns; half a second is waited for it before it is killed

    /// Starts the player; from here on troubleChanged tells how it stands, the first time in any case.
    void start();

    /// Leaves at once. Where nothing can sound, the newest burst is kept as `KeptBurst` has it.
    void play(console::AlarmPriority priority) override;
    void silence() override;

    qint64 processId() const { return m_player.processId(); }

private:
    void launch(Instant now);
    void hangUp();
    void order(PlayerOrder order);
    void read();
    void take(const PlayerAnswer& answer);
    void look();
    void replace(Instant now);
    void tell(const QString& trouble);

    QString m_program;
    QProcess m_player;
    int m_orders = -1; ///< our end of the player's standard input
    QTimer m_look;
    AnswerWatch m_watch;
    quint64 m_followed = 0;
    KeptBurst m_burst;
    ReplacementPlan m_plan;
    std::optional<QString> m_trouble; ///< as the player that runs has told it
    std::optional<QString> m_told;
    Instant m_launched;
    Instant m_asked;  ///< the last order
    Instant m_looked; ///< the last time
    bool m_replaced = false;
};

} // namespace console
