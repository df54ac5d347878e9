// Busy polling of network cards: what the kernel permits, and what is said when it does not.
#include "system/card_search.hpp"
#include "system/real_time.hpp"

#include <QTest>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

using namespace liena;
using namespace liena::system;
using namespace std::chrono_literals;

namespace {

int searchOf(int socket)
{
    int value = -1;
    socklen_t size = sizeof value;
    return ::getsockopt(socket, SOL_SOCKET, SO_BUSY_POLL, &value, &size) == 0 ? value : -1;
}

/// A listening socket on loopback, and one that it accepted.
struct Accepting {
    int listener = ::socket(AF_INET, SOCK_STREAM, 0);
    int near = ::socket(AF_INET, SOCK_STREAM, 0);
    int accepted = -1;

    bool accept()
    {
        sockaddr_in address{};
        socklen_t size = sizeof address;
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        auto* place = reinterpret_cast<sockaddr*>(&address);
        const bool connected = ::bind(listener, place, size) == 0 && ::listen(listener, 1) == 0 &&
                               ::getsockname(listener, place, &size) == 0 && ::connect(near, place, size) == 0;
        accepted = connected ? ::accept(listener, nullptr, nullptr) : -1;
        return accepted >= 0;
    }
    ~Accepting()
    {
        for (const int socket : {listener, near, accepted})
            ::close(socket);
    }
};

} // namespace

class CardSearchTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void nothingIsAskedByDefault() { QVERIFY(prepareRealTime({})); }

    void saysWhatIsMissingAndWhatToDo_data()
    {
        QTest::addColumn<std::chrono::microseconds>("wanted");
        QTest::addColumn<CardSearchFacts>("facts");
        QTest::addColumn<QString>("says"); // empty: permitted
        QTest::newRow("permitted") << std::chrono::microseconds(50) << CardSearchFacts{0, 0, 50} << "";
        QTest::newRow("no right") << std::chrono::microseconds(50) << CardSearchFacts{EPERM, 20, 50}
                                  << "allows 20 us without CAP_NET_ADMIN";
        QTest::newRow("no effect") << std::chrono::microseconds(50) << CardSearchFacts{0, 50, 0} << "sysctl net.core.busy_poll=50";
        QTest::newRow("kernel without it") << std::chrono::microseconds(50) << CardSearchFacts{ENOPROTOOPT, {}, {}}
                                           << "CONFIG_NET_RX_BUSY_POLL";
        QTest::newRow("no socket") << std::chrono::microseconds(50) << CardSearchFacts{EMFILE, 0, 50} << "Too many open files";
        QTest::newRow("negative") << std::chrono::microseconds(-1) << CardSearchFacts{0, 0, 50} << "-1 us at the network card is not 0 to";
        QTest::newRow("too long") << std::chrono::microseconds(2s) << CardSearchFacts{0, 0, 50} << "2000000 us at the network card is not";
    }

    void saysWhatIsMissingAndWhatToDo()
    {
        QFETCH(std::chrono::microseconds, wanted);
        QFETCH(CardSearchFacts, facts);
        QFETCH(QString, says);
        const auto judged = judgeCardSearch(wanted, facts);
        QCOMPARE(judged.has_value(), says.isEmpty());
        QVERIFY2(says.isEmpty() || QString::fromStdString(judged.error().what).contains(says), judged ? "" : judged.error().what.c_str());
    }

    void refusesAtTheStartWhatThisKernelDoesNotAllow()
    {
        constexpr auto wanted = 50us;
        const auto facts = readCardSearchFacts(wanted);
        const bool allowed = facts.error == 0 && facts.busyPoll.value_or(0) > 0;
        QCOMPARE(prepareRealTime({0, {}, false, 0us, wanted}).has_value(), allowed);
        QVERIFY(!prepareRealTime({0, {}, false, 0us, -1us}));
    }

    void acceptedSocketsSearchAsTheListenerDoes()
    {
        constexpr auto wanted = 50us;
        if (readCardSearchFacts(wanted).error != 0)
            QSKIP("this user may not set SO_BUSY_POLL");
        Accepting sockets;
        const int before = searchOf(sockets.listener);
        searchCard(sockets.listener, 0us);
        QCOMPARE(searchOf(sockets.listener), before);
        searchCard(sockets.listener, wanted);
        QVERIFY(sockets.accept());
        QCOMPARE(searchOf(sockets.accepted), 50);
        QCOMPARE(searchOf(sockets.near), before);
    }
};

QTEST_GUILESS_MAIN(CardSearchTest)
#include "card_search_test.moc"
