// The stages of a picture's age as steps, one below the other, each beginning where the one before it ends.
#pragma once

#include "model/picture_stages.hpp"

#include <QWidget>

#include <vector>

namespace console {

class Waterfall : public QWidget {
    Q_OBJECT
public:
    explicit Waterfall(QWidget* parent = nullptr);

    /// `limitMs`: how old a picture may be.
    void refresh(const PictureStages& stages, double limitMs, Instant now);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    struct Step {
        QString name;
        double begin = 0; ///< ms, where the median of the one before ends
        PictureStages::Summary summary;
    };

    double fullScale() const;
    void paintStep(QPainter& painter, const QRectF& row, const Step& step, double full) const;
    void paintLimit(QPainter& painter, const QRectF& chart, double full, bool named) const;

    std::vector<Step> m_steps; ///< behind the stages the whole, and what comes on top of it
    double m_limit = 0;        ///< ms
};

} // namespace console
