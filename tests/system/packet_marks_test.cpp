// A mark that the kernel does not give to packets is said, with what to do.
#include "transport/packet_mark.hpp"

#include <QTest>

#include <unistd.h>

using namespace liena::transport;

class PacketMarksTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void saysWhichMarkIsRefused_data()
    {
        QTest::addColumn<bool>("v6");
        QTest::newRow("IPv4: it takes another instead") << false;
        QTest::newRow("IPv6: it is an error") << true;
    }
    void saysWhichMarkIsRefused()
    {
        QFETCH(const bool, v6);
        constexpr std::uint8_t none = 0;
        constexpr std::uint8_t expedited = 46;
        constexpr std::uint8_t tooLarge = 200; // a DSCP has six bits
        QVERIFY(!whyUnmarked(v6, {expedited, none}));
        const int socket = ::socket(v6 ? AF_INET6 : AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
        if (socket < 0)
            QSKIP("this computer has no IPv6");
        QCOMPARE(markPackets(socket, v6, tooLarge), !v6);
        ::close(socket);
        const auto why = whyUnmarked(v6, {expedited, tooLarge});
        QVERIFY(why && why->find("mark 200") != std::string::npos && why->find("choose 0") != std::string::npos);
    }
};

QTEST_GUILESS_MAIN(PacketMarksTest)
#include "packet_marks_test.moc"
