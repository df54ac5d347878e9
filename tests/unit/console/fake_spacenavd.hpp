// A daemon of 3-D mice on a socket of the test's own: answers the handshake and the requests, and sends what the test says.
#pragma once

#include <QLocalServer>
#include <QLocalSocket>
#include <QPointer>
#include <QTemporaryDir>

#include <array>
#include <cstring>
#include <utility>

namespace console::test {

/// Protocol 1: a handshake of four bytes, then packets of eight integers both ways. What libspnav asks is answered with the same packet,
/// status in its last integer. Protocol 0 says nothing to the handshake.
class FakeSpacenavd {
public:
    using Packet = std::array<qint32, 8>;

    static constexpr qint32 motion = 0, press = 1, release = 2, device = 3;
    static constexpr qint32 added = 0, removed = 1;

    explicit FakeSpacenavd(int protocol = 1) : m_protocol(protocol)
    {
        QObject::connect(&m_server, &QLocalServer::newConnection, &m_server, [this] { accept(); });
        qputenv("SPNAV_SOCKET", path().toLocal8Bit());
    }

    QString path() const { return m_folder.filePath(QStringLiteral("spnav.sock")); }
    bool begin() { return m_server.listen(path()); }

    /// As if it crashed: no goodbye.
    void end()
    {
        m_server.close();
        if (m_client)
            m_client->abort();
        m_client.clear();
    }

    bool hasClient() const { return m_client && m_client->state() == QLocalSocket::ConnectedState; }
    int connections() const { return m_connections; }

    void send(const Packet& packet) { sendBytes(QByteArray(reinterpret_cast<const char*>(packet.data()), sizeof packet)); }

    void sendBytes(const QByteArray& bytes)
    {
        m_client->write(bytes);
        m_client->flush();
    }

    void push(int x, int y, int z, int rx = 0, int ry = 0, int rz = 0) { send({motion, x, y, z, rx, ry, rz, 16}); }
    void button(int number, bool down) { send({down ? press : release, number}); }

    void plug(bool in)
    {
        mousePlugged = in;
        send({device, in ? added : removed, 1, 0x206});
    }

    bool mousePlugged = true;
    bool plugWhileAsked = false; ///< the mouse comes between the next question for it and the answer that there is none

private:
    void accept()
    {
        // One that only looks whether somebody is there says nothing and leaves.
        auto* caller = m_server.nextPendingConnection();
        QObject::connect(caller, &QLocalSocket::disconnected, caller, &QObject::deleteLater);
        QObject::connect(caller, &QLocalSocket::readyRead, caller, [this, caller] {
            if (m_client != caller) {
                m_client = caller;
                ++m_connections;
                m_shaken = false;
            }
            answer();
        });
    }

    void answer()
    {
        if (!m_shaken && m_client->bytesAvailable() >= 4) {
            const auto hello = m_client->read(4);
            if (m_protocol == 0)
                return;
            m_shaken = true;
            sendBytes(hello);
        }
        constexpr qint32 deviceType = 0x2005;
        while (m_shaken && m_client->bytesAvailable() >= qint64(sizeof(Packet))) {
            Packet packet{};
            m_client->read(reinterpret_cast<char*>(packet.data()), sizeof packet);
            if ((packet[0] & 0xffff) == deviceType && std::exchange(plugWhileAsked, false)) {
                packet[7] = -1; // of before
                plug(true);
                send(packet);
                continue;
            }
            const bool unknown = (packet[0] & 0xffff) == deviceType && !mousePlugged;
            packet[7] = unknown ? -1 : 0;
            send(packet);
        }
    }

    QTemporaryDir m_folder;
    QLocalServer m_server;
    QPointer<QLocalSocket> m_client;
    int m_protocol;
    int m_connections = 0;
    bool m_shaken = false;
};

} // namespace console::test
