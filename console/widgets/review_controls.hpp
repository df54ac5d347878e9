// The controls under the reference picture: last image hold, review of the last minute, roadmap.
#pragma once

#include <QWidget>

class QHBoxLayout;
class QSlider;

namespace console {

class SmallButton;

/// As with the picture's controls a click leaves the keys to the hand.
class ReviewControls : public QWidget {
    Q_OBJECT
public:
    explicit ReviewControls(QWidget* parent = nullptr);

    /// Stepping and playing are possible in a review only.
    void showReview(bool open, bool playing);

    /// The strength of the vessels takes the place of stepping and playing.
    void showRoadmap(bool wanted);

Q_SIGNALS:
    void holdRequested();
    void reviewRequested();
    void oldestRequested();
    void stepRequested(int frames);
    void playRequested(bool play);
    void saveRequested();
    void roadmapRequested();
    void opacityChanged(double opacity); ///< of the vessels, 0 to 1

private:
    SmallButton* addButton(const QString& text, const QString& name, const QString& tip);
    void addStrength(QHBoxLayout* row);

    SmallButton* m_hold;
    SmallButton* m_review;
    SmallButton* m_roadmap;
    SmallButton* m_weaker = nullptr;
    QSlider* m_opacity = nullptr;
    SmallButton* m_stronger = nullptr;
    SmallButton* m_oldest;
    SmallButton* m_back;
    SmallButton* m_play;
    SmallButton* m_on;
    void updateButtons();

    bool m_reviewing = false;
    bool m_playing = false;
    bool m_mapping = false;
};

} // namespace console
