// Dead-man and clutch as they are sent and as the robot received them, what the hand asks for, and what force it is offered.
#pragma once

#include "model/hand_state.hpp"
#include "model/instrument_state.hpp"

#include <QWidget>

#include <vector>

namespace console {

class HandBlock : public QWidget {
    Q_OBJECT
public:
    explicit HandBlock(QWidget* parent = nullptr);

    /// `owner`: the other console that has armed the robot, whose dead-man the robot then reports; empty for none.
    void setState(const HandState& hand, const InstrumentState& instrument, const QString& owner, Instant now);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    enum class Lamp { Unknown, Off, On, AnothersOn };
    struct Row {
        QString name, value;
    };
    double namesWidth() const;
    double cellWidth() const;
    double askedWidth() const;
    double lampSide() const;
    static QString lampWord(Lamp lamp);
    QString receivedWords() const;
    void paintLamps(QPainter& painter, const QRectF& where) const;
    void paintLamp(QPainter& painter, const QRectF& where, bool deadMan, Lamp lamp) const;
    QString forceText() const;
    QString scaleText() const;
    std::vector<Row> rows() const;
    void paintAsked(QPainter& painter, const QRectF& where) const;

    HandReading m_hand;
    Lamp m_received = Lamp::Unknown;
    QString m_owner; ///< of the robot, where it is another console; empty while that is not known
};

} // namespace console
