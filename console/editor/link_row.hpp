// One step of Open all: the link's place in the order, its state, how it went, and its button.
#pragma once

#include "model/session_model.hpp"

#include <QElapsedTimer>
#include <QFrame>

class QLabel;

namespace console {

class SheetButton;

class LinkRow : public QFrame {
    Q_OBJECT
public:
    LinkRow(int number, quint32 peer, const QString& title, QWidget* parent = nullptr);
    quint32 peer() const { return m_peer; }
    void setLink(const LinkNode& link, Instant now);
    void setChosen(bool chosen);
    void focusAction();

    /// `open, took 182 ms`; `not opened: …`.
    static QString progress(const LinkNode& link, Instant now);

Q_SIGNALS:
    void openRequested(quint32 peer);
    void closeRequested(quint32 peer);
    void reopenRequested(quint32 peer);

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void act();

    quint32 m_peer;
    QString m_title;
    LinkState m_state = LinkState::Closed;
    bool m_chosen = false;
    QLabel* m_count;
    QLabel* m_progress;
    SheetButton* m_action;
    QElapsedTimer m_acted; ///< since the last wish
};

} // namespace console
