// What is left of the contrast medium, in injections.
#pragma once

#include <QWidget>

#include <optional>

namespace console {

/// A stroke for each planned injection that has been in the injector, filled as far as there is contrast left.
class ContrastBar : public QWidget {
    Q_OBJECT
public:
    explicit ContrastBar(QWidget* parent = nullptr);

    /// mL; nothing: not known. `most`: what was left at the most since the console began, to which the bar is drawn.
    void setContrast(std::optional<double> left, double most);

    QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::optional<double> m_left;
    double m_most = 0;
};

} // namespace console
