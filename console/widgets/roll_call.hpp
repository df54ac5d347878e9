// Every device of the system: has it said that it holds?
#pragma once

#include "model/incident.hpp"

#include <QWidget>

namespace console {

class RollCall : public QWidget {
    Q_OBJECT
public:
    explicit RollCall(QWidget* parent = nullptr);
    void setLines(const std::vector<HoldLine>& lines);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    double rowHeight() const;
    std::vector<HoldLine> m_lines;
};

} // namespace console
