// Figures in equal cells.
#include "imaging/figure_cells.hpp"

#include <QFontMetricsF>
#include <QHash>
#include <QPainter>

#include <algorithm>
#include <array>

namespace console {

namespace {

/// Widths in a face, since measuring takes longer than drawing: of its ten figures, and of what else was written.
struct Cells {
    std::array<double, 10> advance{};
    double width = 0;
    QHash<QString, double> others;

    double widthOf(const QFontMetricsF& metrics, const QString& run);
};

double Cells::widthOf(const QFontMetricsF& metrics, const QString& run)
{
    constexpr qsizetype most = 512;
    const auto known = others.constFind(run);
    if (known != others.constEnd())
        return *known;
    if (others.size() >= most)
        others.clear();
    return *others.insert(run, metrics.horizontalAdvance(run));
}

Cells measure(const QFont& font)
{
    const QFontMetricsF metrics(font);
    Cells cells;
    for (std::size_t i = 0; i < cells.advance.size(); ++i) {
        cells.advance[i] = metrics.horizontalAdvance(QChar(ushort('0' + i)));
        cells.width = std::max(cells.width, cells.advance[i]);
    }
    return cells;
}

Cells& cellsOf(const QFont& font)
{
    thread_local QHash<QFont, Cells> known;
    constexpr qsizetype most = 64;
    auto place = known.find(font);
    if (place == known.end()) {
        if (known.size() >= most)
            known.clear();
        place = known.insert(font, measure(font));
    }
    return *place;
}

bool isFigureOf(QChar c) { return c >= QLatin1Char('0') && c <= QLatin1Char('9'); }

// A run is either one figure or a stretch of other characters, which keep their kerning.
template <typename Visit>
void forEachRun(const QString& text, Visit visit)
{
    qsizetype start = 0;
    for (qsizetype i = 0; i < text.size(); ++i) {
        if (!isFigureOf(text.at(i)))
            continue;
        if (i > start)
            visit(text.mid(start, i - start), false);
        visit(text.mid(i, 1), true);
        start = i + 1;
    }
    if (start < text.size())
        visit(text.mid(start), false);
}

} // namespace

double figuresWidth(const QFont& font, const QString& text)
{
    const QFontMetricsF metrics(font);
    Cells& cells = cellsOf(font);
    double width = 0;
    forEachRun(text, [&](const QString& run, bool isFigure) { width += isFigure ? cells.width : cells.widthOf(metrics, run); });
    return width;
}

void drawFigures(QPainter& painter, const QRectF& where, Qt::Alignment alignment, const QString& text)
{
    const QFontMetricsF metrics(painter.font());
    Cells& cells = cellsOf(painter.font());
    const double width = figuresWidth(painter.font(), text);
    double x = where.left();
    if (alignment.testFlag(Qt::AlignRight))
        x = where.right() - width;
    else if (alignment.testFlag(Qt::AlignHCenter))
        x = where.center().x() - width / 2;
    double y = where.center().y() + (metrics.ascent() - metrics.descent()) / 2;
    if (alignment.testFlag(Qt::AlignTop))
        y = where.top() + metrics.ascent();
    else if (alignment.testFlag(Qt::AlignBottom))
        y = where.bottom() - metrics.descent();
    forEachRun(text, [&](const QString& run, bool isFigure) {
        const double advance = isFigure ? cells.advance[std::size_t(run.front().digitValue())] : cells.widthOf(metrics, run);
        painter.drawText(QPointF(isFigure ? x + (cells.width - advance) / 2 : x, y), run);
        x += isFigure ? cells.width : advance;
    });
}

} // namespace console
