// Region I: how the figures that matter went, over a minute or ten.
#pragma once

#include "model/trend_book.hpp"

#include <QFrame>

class QPushButton;

namespace console {

/// A row for each figure: its name, its course with the limit it has, and its value now.
class TrendsPane : public QFrame {
    Q_OBJECT
public:
    /// Marks at which a course is drawn against its limit; nothing: it has none.
    struct Limits {
        std::optional<double> force;        ///< N
        std::optional<double> pictureAgeMs; ///< as the procedure's profile allows
    };

    /// How a figure is written.
    struct Description {
        QString name;
        QString unit;
        int decimals = 0;
    };
    static Description describe(TrendFigure figure);

    explicit TrendsPane(const TrendBook& book, QWidget* parent = nullptr);

    void refresh(const Limits& limits, Instant now);
    TrendSpan span() const { return m_span; }
    void setSpan(TrendSpan span);

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void toggleSpan();
    void placeButton();
    void paintRow(QPainter& painter, const QRectF& row, std::size_t index) const;
    void paintCourse(QPainter& painter, const QRectF& where, TrendFigure figure) const;
    std::optional<double> limitOf(TrendFigure figure) const;
    std::optional<double> valueOf(TrendFigure figure) const;
    double headHeight() const;

    const TrendBook& m_book;
    QPushButton* m_spanButton;
    TrendSpan m_span = TrendSpan::Minute;
    Limits m_limits;
    Instant m_now;
};

} // namespace console
