// A button that acts only while it is held: for arming and for the X-ray pedal.
#pragma once

#include <QAbstractButton>
#include <QColor>

namespace console {

/// A click, a double click, Enter and Space do nothing: what is held by accident is let go by accident, too. The hold ends
/// with the release and also when the pointer leaves, the button hides or is disabled, its window is no longer active, or nobody sees it.
class HoldButton : public QAbstractButton {
    Q_OBJECT
public:
    explicit HoldButton(QWidget* parent = nullptr);

    /// The large word and the line under it.
    void setTexts(const QString& word, const QString& explanation);
    /// The colour of the fill; the edge takes it too while held.
    void setAccent(const QColor& accent);
    /// 0 to 1: how much of the button is filled.
    void setProgress(double progress);

    /// A key that another hears for it is down: held as by the mouse, while it shows and is enabled. What ends a hold ends this one, too,
    /// until the key is pressed again.
    void setKeyHeld(bool held);

    /// Nobody sees its screen: as if its window were not active, whatever Qt takes for it.
    void setUnseen(bool unseen);

    bool isHeld() const { return m_held; }

    /// At least theme::safetySide() tall, and wider, so that its neighbours stand still when it says something else.
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

Q_SIGNALS:
    void holdChanged(bool held);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void changeEvent(QEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    bool event(QEvent* event) override;

private:
    void setHeld(bool held);

    QString m_explanation;
    QColor m_accent;
    double m_progress = 0;
    bool m_held = false;
    bool m_unseen = false;
};

} // namespace console
