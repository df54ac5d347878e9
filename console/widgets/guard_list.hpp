// The live checklist of the motion permit: what is missing first, what is met after it.
#pragma once

#include "model/motion_permit.hpp"

#include <QWidget>

#include <vector>

namespace console {

class GuardList : public QWidget {
    Q_OBJECT
public:
    explicit GuardList(QWidget* parent = nullptr);
    /// While armed or engaged only the conditions that must stay true are listed.
    void setChecklist(const GuardChecklist& checklist, const PermitState& permit);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    struct Plan {
        int columns;
        QFont font;
    };

    int columnCount() const;
    Plan plan() const;
    std::vector<double> askedWidths(int columns, const QFont& font) const;
    std::vector<double> columnWidths(const Plan& plan) const;
    QString overflowText(std::size_t from) const;

    static constexpr int rows = 5;
    std::vector<GuardLine> m_lines;
};

} // namespace console
