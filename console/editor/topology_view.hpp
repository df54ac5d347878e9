// The topology at run time: the canvas, every link of this console in order with its progress, and what can be asked of each.
#pragma once

#include "editor/topology_canvas.hpp"

#include <QFrame>

#include <vector>

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace console {

class LinkRow;

class TopologyView : public QFrame {
    Q_OBJECT
public:
    explicit TopologyView(const SessionModel& sessions, QWidget* parent = nullptr);

    void refresh(Instant now);
    TopologyCanvas* canvas() const { return m_canvas; }

Q_SIGNALS:
    void openRequested(quint32 peer);
    void closeRequested(quint32 peer);
    void reopenRequested(quint32 peer);
    void openAllRequested();

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    void rebuild();
    void chooseLink(quint32 a, quint32 b);
    void chooseDevice(quint32 id);

    const SessionModel& m_sessions;
    QLabel* m_title;
    QLabel* m_identity;
    QLabel* m_said;
    QPushButton* m_openAll;
    TopologyCanvas* m_canvas;
    QVBoxLayout* m_rowColumn;
    std::vector<LinkRow*> m_rows;
    QTimer m_clock;
};

} // namespace console
