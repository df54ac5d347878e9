// Text whose figures stand in cells of one width, so that no value jumps when it changes.
#pragma once

#include <QLabel>
#include <QString>

#include <chrono>
#include <optional>

class QPainter;
class QFont;

namespace console {

/// Inter's figures are proportional and Qt 6.4 cannot ask a face for its tabular ones; the cell is the widest figure's.
void drawFigures(QPainter& painter, const QRectF& where, Qt::Alignment alignment, const QString& text);
double figuresWidth(const QFont& font, const QString& text);

/// `12.3 mm`; an em dash and the unit when there is no value.
QString figure(std::optional<double> value, int decimals, const QString& unit);

/// An age as a person says it: `84 ms`, `2.4 s`, `3:07`, `1:02:09`.
QString spokenAge(std::chrono::nanoseconds age);

/// A running time: `0:42`, `12:07`, `1:02:09`.
QString clockDuration(std::chrono::nanoseconds duration);

/// A label for values; as wide as its widest text so far asked for with `reserve`.
class FigureLabel : public QLabel {
    Q_OBJECT
public:
    explicit FigureLabel(QWidget* parent = nullptr);

    /// Keeps room for `widest`, so that neighbours stand still.
    void reserve(const QString& widest);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QString m_widest;
};

} // namespace console
