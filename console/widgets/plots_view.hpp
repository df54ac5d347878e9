// F3: where a picture's age comes from, and how the figures that matter lay in the last minute and the last ten.
#pragma once

#include "model/console_models.hpp"

#include <QFrame>
#include <QTimer>

#include <array>

class QGridLayout;

namespace console {

class FigureLabel;
class SheetButton;
class Waterfall;

/// A view like the others; renews itself four times a second while it is shown. `models` must outlive it.
class PlotsView : public QFrame {
    Q_OBJECT
public:
    explicit PlotsView(const ConsoleModels& models, QWidget* parent = nullptr);

    void refresh(Instant now);

Q_SIGNALS:
    void leaveRequested();

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    QGridLayout* makeTable();

    static constexpr std::size_t columns = 4; ///< median and 99th percentile, of a minute and of ten

    const ConsoleModels& m_models;
    Waterfall* m_waterfall;
    std::array<std::array<FigureLabel*, columns>, trendFigures> m_figures{};
    SheetButton* m_leave;
    QTimer m_clock;
};

} // namespace console
