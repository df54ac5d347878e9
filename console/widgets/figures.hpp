// Numbers as a person reads them, and a label for them that does not jump.
#pragma once

#include "imaging/figure_cells.hpp"

#include <QLabel>
#include <QString>

#include <chrono>
#include <optional>

namespace console {

/// `12.3 mm`, with a minus sign where it is negative and not shown as zero; an em dash and the unit when there is no value.
QString figure(std::optional<double> value, int decimals, const QString& unit);

/// The same with a sign, also where it is plus: for directions. What is shown as zero has none.
QString signedFigure(std::optional<double> value, int decimals, const QString& unit);

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
