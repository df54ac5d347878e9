// "While you were away": what an interruption that needed a re-open changed, for a person to read before the next arming.
#pragma once

#include "model/instant.hpp"
#include "model/instrument_state.hpp"
#include "model/xray_state.hpp"

#include <QObject>
#include <QString>
#include <QStringList>

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace console {

/// What the patient side reports at one moment. Only fresh reports count; what is not known is nothing.
struct SystemSnapshot {
    std::optional<RobotStatus> robot;
    Instant robotAt;            ///< of that report; the two that follow are of the same moment
    std::optional<TipPose> tip; ///< a valid one only
    std::optional<DriveStatus> drives;
    std::optional<AcquisitionStatus> xray;
    Instant xrayAt;
    quint64 picturesReceived = 0; ///< by this console since it was started, when it had that X-ray report
};

/// One line of the account.
struct AccountLine {
    QString name;
    QString text;
    bool changed = false; ///< or not known: to be read first

    bool operator==(const AccountLine&) const = default;
};

/// GUI thread only. The account of all that happened since the first loss that a person has not read about; a further loss extends it.
///
/// ```
///          a loss            all re-opened, or given up          read, at the earliest after readTime
///   None ─────────► Running ──────────────────────────► Unread ──────────────────────────────────────► None
///                      ▲                                   │ a further loss: the same account
///                      └───────────────────────────────────┘
/// ```
class InterruptionAccount : public QObject {
    Q_OBJECT
public:
    enum class Stage : std::uint8_t { None, Running, Unread };

    /// Nobody reads faster; a click that was meant for what lay there before does not count.
    static constexpr std::chrono::milliseconds readTime{1000};

    /// A report that is older than this when the loss begins is not how things stood before it.
    static constexpr std::chrono::seconds beforeLimit{2};

    explicit InterruptionAccount(QObject* parent = nullptr);

    Stage stage() const { return m_stage; }

    /// No interruption is unread and none is running: as far as this goes, instruments may be armed.
    bool settled() const { return m_stage == Stage::None; }

    /// Ten times a second. Before a loss it is how things stand; after the re-opening it is what became of them.
    void note(const SystemSnapshot& present);

    /// `what` was lost, for a person; `since`: when it was last heard, and that as Unix time in milliseconds.
    void begin(const QString& what, Instant since, qint64 sinceWallMs);

    /// No incident is left.
    void end(Instant now);

    bool readable(Instant now) const { return m_stage == Stage::Unread && now - m_since >= readTime; }

    /// A person's word; false, and nothing happens, while it is not readable().
    bool acknowledge(Instant now);

    // For who shows it.
    int losses() const { return m_losses; }
    Duration lasted() const { return m_lasted; } ///< of all its losses; meaningful while Unread
    qint64 sinceWallMs() const { return m_sinceWallMs; }
    const QStringList& lost() const { return m_lost; } ///< each once, in order of time
    const SystemSnapshot& before() const { return m_before; }
    const SystemSnapshot& present() const { return m_present; }

Q_SIGNALS:
    void changed();

private:
    void forgetOld(Instant since);

    Stage m_stage = Stage::None;
    Instant m_since;     ///< stage entered
    Instant m_lostSince; ///< of the loss that runs
    Duration m_lasted{};
    qint64 m_sinceWallMs = 0;
    int m_losses = 0;
    QStringList m_lost;
    SystemSnapshot m_before;
    SystemSnapshot m_present;
};

/// `Interrupted for 12.4 s, since 12:03:41`. Pure, like the lines.
QString accountHeadline(const InterruptionAccount& account);

/// What was lost, tip, force, contrast, X-ray time, pictures, C-arm and table, patient side: always the same lines in the same order.
std::vector<AccountLine> accountLines(const InterruptionAccount& account);

} // namespace console
