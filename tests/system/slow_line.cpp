// One queue for all that is on its way, and a pair of sockets for each connection.
#include "slow_line.hpp"

#include <QNetworkDatagram>
#include <QNetworkProxy>
#include <QPointer>
#include <QTcpServer>
#include <QTcpSocket>
#include <QTimer>
#include <QUdpSocket>

#include <algorithm>
#include <deque>
#include <functional>

namespace liena::test {

using Clock = std::chrono::steady_clock;

class SlowLine::Carrier : public QObject {
public:
    Carrier(const QHostAddress& shown, const QHostAddress& hidden, SlowLine& line)
        : m_lastWord{line.m_ended}, m_shown(shown), m_hidden(hidden), m_delay(line.m_delay), m_listening(line.m_listening)
    {
        m_server.setProxy(QNetworkProxy::NoProxy);
        m_packets.setProxy(QNetworkProxy::NoProxy);
        m_timer.setSingleShot(true);
        m_timer.setTimerType(Qt::PreciseTimer);
        connect(&m_server, &QTcpServer::newConnection, this, &Carrier::accept);
        connect(&m_packets, &QUdpSocket::readyRead, this, &Carrier::readPackets);
        connect(&m_timer, &QTimer::timeout, this, &Carrier::deliver);
        connect(&m_watch, &QTimer::timeout, this, &Carrier::stopWhereAsked);
        m_watch.start(std::chrono::milliseconds(5));
    }

    bool listen(quint16 port)
    {
        m_port = port;
        return m_server.listen(m_shown, port) && m_packets.bind(m_shown, port);
    }

private:
    void stopWhereAsked()
    {
        if (m_listening != Listening::Ends)
            return;
        m_server.close();
        m_listening = Listening::Ended;
        m_listening.notify_one();
    }

    struct Underway {
        Clock::time_point arrives;
        std::function<void()> deliver;
    };

    struct LastWord {
        std::atomic<bool>& ended;
        ~LastWord() { ended = true; }
    };

    void accept()
    {
        while (auto* caller = m_server.nextPendingConnection()) {
            auto* device = new QTcpSocket(caller);
            device->setProxy(QNetworkProxy::NoProxy);
            connect(device, &QTcpSocket::connected, device, [device] { device->setSocketOption(QAbstractSocket::LowDelayOption, 1); });
            connect(caller, &QTcpSocket::readyRead, device, [this, caller, device] {
                send([to = QPointer<QTcpSocket>(device), bytes = caller->readAll()] {
                    if (to)
                        to->write(bytes);
                });
            });
            connect(caller, &QTcpSocket::disconnected, this, [this, caller] {
                send([ended = QPointer<QObject>(caller)] { // which is a socket no more where it ends with this object
                    if (ended)
                        ended->deleteLater(); // and the device's end with it
                });
            });
            connect(device, &QTcpSocket::readyRead, caller, [caller, device] { caller->write(device->readAll()); });
            connect(device, &QTcpSocket::errorOccurred, caller, &QObject::deleteLater); // also when the device closes it
            device->connectToHost(m_hidden, m_port);
        }
    }

    void readPackets()
    {
        while (m_packets.hasPendingDatagrams())
            send([this, packet = m_packets.receiveDatagram().data()] { m_packets.writeDatagram(packet, m_hidden, m_port); });
    }

    void send(std::function<void()> deliverIt)
    {
        const auto behind = m_underway.empty() ? Clock::time_point() : m_underway.back().arrives;
        m_underway.push_back({std::max(behind, Clock::now() + m_delay.load()), std::move(deliverIt)});
        deliver();
    }

    void deliver()
    {
        const auto now = Clock::now();
        while (!m_underway.empty() && m_underway.front().arrives <= now) {
            const auto arrived = std::move(m_underway.front());
            m_underway.pop_front();
            arrived.deliver();
        }
        if (!m_underway.empty())
            m_timer.start(std::chrono::ceil<std::chrono::milliseconds>(m_underway.front().arrives - now));
    }

    LastWord m_lastWord; ///< first: its connections have gone by then
    QHostAddress m_shown;
    QHostAddress m_hidden;
    const std::atomic<std::chrono::milliseconds>& m_delay;
    std::atomic<Listening>& m_listening;
    quint16 m_port = 0;
    std::deque<Underway> m_underway;
    QTimer m_timer{this};
    QTimer m_watch{this};
    QUdpSocket m_packets{this};
    QTcpServer m_server{this}; ///< last: its connections say that they end
};

SlowLine::SlowLine(const QHostAddress& shown, const QHostAddress& hidden) : m_carrier(new Carrier(shown, hidden, *this))
{
    QObject::connect(&m_thread, &QThread::finished, m_carrier, &QObject::deleteLater);
}

SlowLine::~SlowLine()
{
    if (!m_thread.isRunning())
        delete m_carrier;
    m_thread.quit();
    m_thread.wait();
    m_ended.wait(false); // it is so by now; a sanitizer does not see what Qt's threads wait for
}

bool SlowLine::open(quint16 port)
{
    if (!m_carrier->listen(port))
        return false;
    m_carrier->moveToThread(&m_thread);
    m_thread.start();
    return true;
}

void SlowLine::stopListening()
{
    m_listening = Listening::Ends;
    m_listening.wait(Listening::Ends); // a sanitizer does not see how Qt's threads wait for each other
}

} // namespace liena::test
