// From a line of the log to the picture of its moment, and on from there.
#pragma once

#include "model/log_moments.hpp"

#include <QWidget>

#include <chrono>
#include <optional>

class QLabel;

namespace console {

class SheetButton;

/// What cannot be reviewed has a button that cannot be pressed, and the reason below it.
class LogReview : public QWidget {
    Q_OBJECT
public:
    explicit LogReview(QWidget* parent = nullptr);

    /// What there is of the chosen line's moment; nothing: no line is chosen. `kept`: from the oldest picture to the newest.
    void showLine(std::optional<MomentPicture> picture, Duration kept);

    /// Stepping and playing are there in a review only.
    void showReview(bool open, bool playing);

    /// The line can be reviewed.
    bool mayReview() const { return m_picture == MomentPicture::Kept; }

Q_SIGNALS:
    void reviewRequested();
    void stepRequested(int frames);
    void playRequested(bool play);

    /// What has the focus is about to be disabled or to go.
    void focusLeaving();

private:
    SheetButton* addButton(const QString& text, const QString& accessibleName);
    void renew();
    QString reason() const;

    SheetButton* m_review;
    SheetButton* m_back;
    SheetButton* m_play;
    SheetButton* m_on;
    QLabel* m_note;
    std::optional<MomentPicture> m_picture;
    std::chrono::seconds m_kept{}; ///< whole ones
    bool m_open = false;
    bool m_playing = false;
};

} // namespace console
