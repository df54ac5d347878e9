// The permit word in large letters, and in one line what it means now.
#pragma once

#include "model/permit_model.hpp"

#include <QWidget>

namespace console {

class PermitBlock : public QWidget {
    Q_OBJECT
public:
    explicit PermitBlock(QWidget* parent = nullptr);
    void setPermit(const PermitModel& permit, Instant now);

    /// The line under the word.
    static QString explanation(const PermitModel& permit, Instant now);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void paintWords(QPainter& painter, const QRectF& room, const QColor& wordInk, const QColor& lineInk) const;

    PermitPhase m_phase = PermitPhase::Off;
    QString m_explanation;
};

} // namespace console
