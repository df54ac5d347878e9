// Region C: a card per link of this console, the button that opens them all, and a small topology.
#pragma once

#include "model/session_model.hpp"

#include <QFrame>

#include <vector>

class QLabel;
class QPushButton;
class QScrollArea;
class QVBoxLayout;

namespace console {

class LinkCard;

class LinksRail : public QFrame {
    Q_OBJECT
public:
    explicit LinksRail(const SessionModel& sessions, QWidget* parent = nullptr);

    /// Takes the small topology; it stands below the cards.
    void setMiniTopology(QWidget* topology);

    /// Shows the present figures; cards are made anew only when the topology changed.
    void refresh(Instant now);

Q_SIGNALS:
    void openRequested(quint32 peer);
    void closeRequested(quint32 peer);
    void reopenRequested(quint32 peer);
    void openAllRequested();
    void topologyRequested();

private:
    void rebuild();
    void fitMini();

    const SessionModel& m_sessions;
    QLabel* m_count;
    QPushButton* m_openAll;
    QPushButton* m_topology;
    QScrollArea* m_scroll;
    QVBoxLayout* m_column;
    QVBoxLayout* m_cardColumn;
    QWidget* m_mini = nullptr;
    std::vector<LinkCard*> m_cards;
};

} // namespace console
