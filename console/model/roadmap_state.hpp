// Whether a roadmap's vessels still lie where the picture shows them.
#pragma once

#include "model/instant.hpp"
#include "model/xray_frame.hpp"

#include <QObject>
#include <QString>

#include <array>
#include <cstddef>
#include <deque>
#include <optional>

namespace console {

/// How a roadmap's vessels were taken.
struct RoadmapBasis {
    XrayFrame about;    ///< its run's first picture
    quint64 lastNs = 0; ///< its last one's pulse
};

/// A roadmap that is wrong is worse than none: once anything moved by more than its tolerance it is removed and does not come back by
/// itself, since what moved back has not moved back exactly. GUI thread only.
class RoadmapState : public QObject {
    Q_OBJECT
public:
    static constexpr double angleTolerance = ProjectionTolerance{}.angle;       ///< deg
    static constexpr double distanceTolerance = ProjectionTolerance{}.distance; ///< mm, of SID and SOD
    static constexpr double tableTolerance = 1;                                 ///< mm, each axis
    static constexpr double displacementTolerance = 0.01;                       ///< of the picture's width: the patient's own movement
    static constexpr int displacementsThatCount = 3;                            ///< in a row
    static constexpr std::size_t tablesKept = 64;

    explicit RoadmapState(QObject* parent = nullptr);

    void begin(const RoadmapBasis& basis);
    void end();

    /// A person wants one; whether it is shown, isValid() tells.
    bool isWanted() const { return m_basis.has_value(); }
    bool isValid() const { return m_basis && m_reason.isEmpty(); }

    /// Why it was removed, `the table moved`; empty while it is valid, and without one.
    const QString& reason() const { return m_reason; }

    /// `Vessels of 12:03:41, run 3`, or that it was removed and why; empty without one.
    QString line() const;

    void checkPicture(const XrayFrame& about);

    /// mm, as the X-ray system reported it; also while there is no roadmap, since one may be made of a run of before.
    void noteTable(const std::array<double, 3>& table, Instant at);

    /// By how much of its width the newest picture lies beside the roadmap's.
    void checkDisplacement(double share);

Q_SIGNALS:
    void changed();

private:
    struct TablePlace {
        Instant at; ///< from then on
        std::array<double, 3> table{};
    };

    void checkTable();
    void remove(const QString& reason);

    std::deque<TablePlace> m_tables; ///< the oldest first, one for each movement
    bool m_tableForgotten = false;   ///< there were others before these
    std::optional<RoadmapBasis> m_basis;
    QString m_reason;
    int m_displaced = 0;
};

} // namespace console
