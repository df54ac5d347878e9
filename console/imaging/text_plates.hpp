// Texts on dark plates over a picture.
#pragma once

#include <QColor>
#include <QFont>
#include <QRect>
#include <QRegion>
#include <QString>
#include <QStringList>

#include <vector>

class QPainter;
class QWidget;

namespace console {

struct OverlayPlate {
    QRect rect;
    QString text;
    QFont font;
    Qt::Alignment alignment = Qt::AlignCenter;
    QColor ink;
};

QFont larger(QFont font, double factor);

/// Of texts that a pane paints: as large as its window gave it, or the usual size at the reference where none did.
QFont paneFont(const QWidget& pane);

/// The same or smaller, until each of the lines fits into the room.
QFont fitted(QFont font, const QStringList& lines, int room);

/// A text in as many rows as it needs, none wider than the room unless a word alone is. A figure stays in one row with its unit, and with
/// the word or sign before it.
QStringList rowsOf(const QString& text, const QFont& font, int room);

/// A text in as many rows as it needs, on a plate at the edge of `room` that `alignment` names; what the plate took.
QRect paintWrapped(QPainter& painter, const QFont& font, const QString& text, const QRect& room, Qt::Alignment alignment);

/// What stands over a picture to tell what it is.
inline constexpr double headFactor = 1.5;

/// Lays plates out and paints them.
class TextPlates {
public:
    explicit TextPlates(const QFont& font) : m_font(font), m_gap(font.pixelSize() / 2) {}

    const QFont& font() const { return m_font; }
    int gap() const { return m_gap; }

    /// `corner` is the plate's corner or edge that `alignment` names; as wide as `widest`, so that figures do not make it jump.
    QRect add(const QString& text, const QFont& font, QPoint corner, Qt::Alignment alignment, const QString& widest = {});
    QRect add(const QString& text, QPoint corner, Qt::Alignment alignment) { return add(text, m_font, corner, alignment); }

    /// In the lower left: moved up until it neither covers nor touches another plate or `avoid` sideways. Left out, and empty, where there
    /// is no such place below `top`.
    QRect addAbove(const QString& text, const QFont& font, QPoint corner, const QRect& avoid, int top);

    /// Of each text as many rows as it needs, smaller where a word alone is wider than `area`, one below the other about the middle of it:
    /// the last row of the first text ends at `foot`, or as near to that as the rows then cover neither another plate nor `taken`; narrower
    /// where that helps. What has no room even so is left out, the last text first and whole; the first one stands in any case.
    void addStack(QStringList texts, const QRect& area, int foot, const QRegion& taken = {});

    bool isFree(const QRect& rect) const { return !region().intersects(rect); }

    /// Of the plate that was added last.
    void setInk(const QColor& ink) { m_plates.back().ink = ink; }

    const std::vector<OverlayPlate>& plates() const { return m_plates; }
    QRegion region() const;
    void paint(QPainter& painter) const;

private:
    QFont m_font;
    int m_gap;
    std::vector<OverlayPlate> m_plates;
};

} // namespace console
