// The live picture: the pane that a surgeon moves instruments by.
#pragma once

#include "imaging/picture_canvas.hpp"
#include "model/picture_state.hpp"

#include <QRegion>
#include <QTimer>

#include <functional>
#include <optional>

namespace console {

/// Paints the newest picture with its age and all its marks in one go: no mark is a widget that could be missing or on top of another
/// picture. What condition the picture is in is asked of `PictureState` at each paint and ten times a second, so a picture that stops
/// coming is shown as frozen without any event.
class LiveImageView : public PictureCanvas {
    Q_OBJECT
public:
    /// `state` outlives the view; it is told of each newly painted picture.
    explicit LiveImageView(PictureState& state, QWidget* parent = nullptr);
    ~LiveImageView() override;

    /// A picture that was not made to be the live one is not taken.
    void showPicture(const DisplayPicture& picture);

    /// What stands there now, with its whole image; for saving.
    const std::optional<DisplayPicture>& picture() const { return m_picture; }

    /// Shown under the last picture until a new one is painted.
    void showRefusal(quint32 frame, const QString& reason);

    /// What takes the steady clock's place in tests.
    void setClock(std::function<Instant()> clock) { m_clock = std::move(clock); }

    /// Every pixel inside it that is not the picture's own.
    QRegion overlayRegion() const { return m_overlay; }
    QRect livenessRect() const { return m_liveness; }

    QSize sizeHint() const override { return {600, 600}; }

Q_SIGNALS:
    /// Once for each new picture, when it stands on the screen; no age while the clocks' offset is unknown.
    void picturePainted(quint32 frame, std::optional<double> ageMs);

protected:
    const DisplayPicture* shown() const override { return m_picture ? &*m_picture : nullptr; }
    void paintEvent(QPaintEvent* event) override;

private:
    void tick();
    void notePainted();
    void paintCondition(QPainter& painter, const PictureReading& reading);
    void paintNothingYet(QPainter& painter);
    QRect paintRefusal(QPainter& painter, int footTop) const;
    void describe(const PictureReading& reading);
    static QString conditionWords(const PictureReading& reading);

    PictureState& m_state;
    std::function<Instant()> m_clock;
    QTimer m_timer;
    std::optional<DisplayPicture> m_picture;
    bool m_pictureIsNew = false;
    quint64 m_paintedPictures = 0;
    QString m_refusal;
    PictureCondition m_paintedCondition = PictureCondition::None;
    PictureReduction m_paintedReduction;
    QRegion m_overlay;
    QRect m_liveness;
};

} // namespace console
