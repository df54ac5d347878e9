// Region B: the highest alarm over the whole band, the others as chips, and the sheets that were folded away.
#pragma once

#include "model/alarm_list.hpp"

#include <QFrame>
#include <QTimer>

#include <utility>
#include <vector>

class QHBoxLayout;
class QPushButton;

namespace console {

/// The one flash clock of the screen: 2 Hz for high, 0.6 Hz for medium, half on and half off. Low does not flash.
class FlashClock : public QObject {
    Q_OBJECT
public:
    explicit FlashClock(QObject* parent = nullptr);
    bool isLit(AlarmPriority priority) const;

    static constexpr int highHalfPeriodMs = 250;
    static constexpr int mediumHalfPeriodMs = 833;

Q_SIGNALS:
    void ticked();

private:
    QTimer m_high;
    QTimer m_medium;
    bool m_highLit = true;
    bool m_mediumLit = true;
};

/// Its room is fixed: alarms come and go and nothing else on the screen moves.
class AlarmBand : public QFrame {
    Q_OBJECT
public:
    explicit AlarmBand(QWidget* parent = nullptr);

    /// In the list's order: the highest first.
    void setAlarms(const std::vector<Alarm>& alarms);

    /// A chip that brings a folded sheet back; its incident is handed back in `sheetRequested`.
    void setFoldedSheets(const std::vector<std::pair<quint64, QString>>& sheets);

    /// The band's colour now, for what lies beneath the text.
    QColor surface() const;

Q_SIGNALS:
    void acknowledgeRequested(quint64 id);
    void sheetRequested(quint64 incident);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    int paintBadge(QPainter& painter) const;
    void paintChips(QPainter& painter, const QRectF& room) const;
    void paintQuiet(QPainter& painter, double right) const;
    QColor ink() const;
    const Alarm* firstUnacknowledged() const;

    std::vector<Alarm> m_alarms;
    FlashClock m_clock;
    QHBoxLayout* m_row;
    QPushButton* m_acknowledge;
    std::vector<QPushButton*> m_chips;
    std::vector<std::pair<quint64, QString>> m_folded;
};

} // namespace console
