// Strokes instead of a scale: how many injections are left is what is asked.
#include "widgets/contrast_bar.hpp"

#include "model/alarm_rules.hpp"
#include "widgets/theme.hpp"

#include <QPainter>

#include <algorithm>
#include <cmath>

namespace console {

namespace colour = theme::colour;

namespace {

constexpr double mostStrokes = 40; ///< beyond them each stands for more than one

} // namespace

ContrastBar::ContrastBar(QWidget* parent) : QWidget(parent)
{
    setAccessibleName(tr("Injections left"));
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
}

QSize ContrastBar::sizeHint() const { return {theme::px(this, 90), theme::px(this, 14)}; }

void ContrastBar::setContrast(std::optional<double> left, double most)
{
    if (m_left == left && m_most == most)
        return;
    m_left = left;
    m_most = most;
    const auto words = left ? tr("About %1 injections of %2 mL").arg(std::floor(*left / plannedInjection)).arg(plannedInjection)
                            : tr("Contrast left is not known");
    setAccessibleDescription(words);
    setToolTip(words);
    update();
}

void ContrastBar::paintEvent(QPaintEvent*)
{
    if (m_most <= 0)
        return;
    QPainter painter(this);
    const double injections = std::max(1.0, std::ceil(m_most / plannedInjection));
    const double each = std::ceil(injections / mostStrokes) * plannedInjection;
    const int strokes = int(std::ceil(m_most / each));
    const double pitch = double(width()) / strokes;
    const double gap = std::min(2.0, pitch / 3);
    for (int i = 0; i < strokes; ++i) {
        const QRectF place(i * pitch, 0, pitch - gap, height());
        painter.fillRect(place, colour::raised);
        const double filled = m_left ? std::clamp(*m_left / each - i, 0.0, 1.0) : 0;
        painter.fillRect(QRectF(place.left(), place.top(), place.width() * filled, place.height()), colour::secondary);
    }
}

} // namespace console
