// The controls under the reference picture: last image hold, and review of the last minute.
#pragma once

#include <QWidget>

namespace console {

class SmallButton;

/// As with the picture's controls a click leaves the keys to the hand.
class ReviewControls : public QWidget {
    Q_OBJECT
public:
    explicit ReviewControls(QWidget* parent = nullptr);

    /// Stepping and playing are possible in a review only.
    void showReview(bool open, bool playing);

Q_SIGNALS:
    void holdRequested();
    void reviewRequested();
    void oldestRequested();
    void stepRequested(int frames);
    void playRequested(bool play);
    void saveRequested();

private:
    SmallButton* addButton(const QString& text, const QString& name, const QString& tip);

    SmallButton* m_hold;
    SmallButton* m_review;
    SmallButton* m_oldest;
    SmallButton* m_back;
    SmallButton* m_play;
    SmallButton* m_on;
    bool m_playing = false;
};

} // namespace console
