// Texts on dark plates over a picture.
#pragma once

#include <QColor>
#include <QFont>
#include <QRect>
#include <QRegion>
#include <QString>

#include <vector>

class QPainter;

namespace console {

struct OverlayPlate {
    QRect rect;
    QString text;
    QFont font;
    Qt::Alignment alignment = Qt::AlignCenter;
    QColor ink;
};

QFont larger(QFont font, double factor);

/// Lays plates out and paints them.
class TextPlates {
public:
    explicit TextPlates(const QFont& font) : m_font(font), m_gap(font.pixelSize() / 2) {}

    const QFont& font() const { return m_font; }
    int gap() const { return m_gap; }

    /// `corner` is the plate's corner or edge that `alignment` names; as wide as `widest`, so that figures do not make it jump.
    QRect add(const QString& text, const QFont& font, QPoint corner, Qt::Alignment alignment, const QString& widest = {});
    QRect add(const QString& text, QPoint corner, Qt::Alignment alignment) { return add(text, m_font, corner, alignment); }

    /// In the lower left: moved up until it covers neither another plate nor `avoid`.
    QRect addAbove(const QString& text, QPoint corner, const QRect& avoid);

    /// Of the plate that was added last.
    void setInk(const QColor& ink) { m_plates.back().ink = ink; }

    QRegion region() const;
    void paint(QPainter& painter) const;

private:
    QFont m_font;
    int m_gap;
    std::vector<OverlayPlate> m_plates;
};

} // namespace console
