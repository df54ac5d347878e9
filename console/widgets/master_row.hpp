// The masters: which one the hand holds, whether it is alive, and which others could be taken.
#pragma once

#include "model/master_status.hpp"

#include <QAbstractButton>

#include <vector>

class QHBoxLayout;

namespace console {

/// One master. The one in use has a frame; its mark is filled when it is alive, hollow when it is not yet or not heard, crossed when it is
/// gone or silent. A click or Space takes it; Enter does not, on whatever desktop.
class MasterChip : public QAbstractButton {
    Q_OBJECT
public:
    explicit MasterChip(QWidget* parent = nullptr);
    void setStatus(const MasterStatus& status, const QString& words);
    const MasterStatus& status() const { return m_status; }
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;

private:
    void paintMark(QPainter& painter, const QRectF& where) const;
    QString name() const;

    MasterStatus m_status;
    QString m_words;
};

class MasterRow : public QWidget {
    Q_OBJECT
public:
    explicit MasterRow(QWidget* parent = nullptr);

    /// `mayChange`: nothing is armed.
    void setMasters(const std::vector<MasterStatus>& masters, bool mayChange, Instant now);

Q_SIGNALS:
    void masterChosen(console::MasterKind kind);

private:
    MasterChip* chip(std::size_t place);

    QHBoxLayout* m_row;
    std::vector<MasterChip*> m_chips;
};

} // namespace console
