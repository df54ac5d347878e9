// The live checklist of the motion permit: what is missing first, what is met after it.
#pragma once

#include "model/motion_permit.hpp"

#include <QAbstractButton>

#include <vector>

class QPainter;

namespace console {

enum class GuardMark {
    Missing,  ///< an empty box
    Met,      ///< a tick
    NotAsked, ///< a dash: while armed it need not be true any more
};

struct ShownGuard {
    GuardMark mark;
    QString text;

    bool operator==(const ShownGuard&) const = default;
};

/// All of them, in their own order. While armed or engaged what must stay true is judged as that.
std::vector<ShownGuard> shownGuards(const GuardChecklist& checklist, const PermitState& permit);

void drawGuardMark(QPainter& painter, const QRectF& where, GuardMark mark);

/// A press, Space, or Enter asks for the view that shows all of them. What finds no room here is counted in words.
class GuardList : public QAbstractButton {
    Q_OBJECT
public:
    explicit GuardList(QWidget* parent = nullptr);
    /// While armed or engaged only the conditions that must stay true are listed.
    void setChecklist(const GuardChecklist& checklist, const PermitState& permit);

    /// Lines that are written out; the others are counted in the last place.
    std::size_t writtenOut() const;

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    int rows() const;
    int columns() const;
    int mostColumns() const;
    std::size_t missingCount() const;
    std::vector<double> askedWidths(int columns) const;
    std::vector<double> columnWidths(int columns) const;
    QString overflowText(std::size_t from) const;

    std::vector<ShownGuard> m_lines;
};

} // namespace console
