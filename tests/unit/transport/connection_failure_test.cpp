// What a failed connect is taken for, and whether it is this computer that has no network.
#include "transport/connection_failure.hpp"
#include "transport/own_interfaces.hpp"

#include <boost/asio/ip/address.hpp>

#include <QScopeGuard>
#include <QTest>

#include <algorithm>
#include <array>
#include <cerrno>

#include <sys/resource.h>

using namespace liena;
using namespace liena::transport;
namespace asio = boost::asio;

namespace {

const auto own = asio::ip::make_address("10.1.0.1");
const auto other = asio::ip::make_address("10.2.0.1");

OwnInterface interface(const char* name, bool running, std::optional<asio::ip::address> address = std::nullopt)
{
    return {name, std::string(name) == "lo", running, std::move(address)};
}

} // namespace

class ConnectionFailureTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void errorsOfConnectAreFindings_data()
    {
        QTest::addColumn<int>("code");
        QTest::addColumn<QByteArray>("finding");
        QTest::newRow("refused") << ECONNREFUSED << QByteArray("connection refused");
        QTest::newRow("reset") << ECONNRESET << QByteArray("connection refused");
        QTest::newRow("network down") << ENETDOWN << QByteArray("interface down");
        QTest::newRow("no route") << ENETUNREACH << QByteArray("no route");
        QTest::newRow("nobody there") << EHOSTUNREACH << QByteArray("host unreachable");
        QTest::newRow("timed out") << ETIMEDOUT << QByteArray("host unreachable");
    }

    void errorsOfConnectAreFindings()
    {
        QFETCH(int, code);
        QFETCH(QByteArray, finding);
        const boost::system::error_code error(code, boost::system::system_category());
        for (const auto& target : {std::optional<asio::ip::address>(), std::optional(asio::ip::make_address("127.0.0.1"))}) {
            const auto failure = explainConnect(error, "robot:1", target);
            QCOMPARE(QByteArray::fromStdString(std::string(toString(failure.probe))), finding);
            QVERIFY(failure.detail.starts_with("robot:1: "));
        }
    }

    void silenceIsOfTheHostWhereThisComputerHasANetwork()
    {
        QVERIFY(explainSilence("robot:1", std::nullopt).probe == ProbeResult::HostUnreachable);
        QVERIFY(explainSilence("robot:1", asio::ip::make_address("127.0.0.1")).probe == ProbeResult::HostUnreachable);
    }

    void theInterfaceOnTheWayIsTheOneThatCounts()
    {
        const std::array up{interface("lo", true), interface("eth0", true), interface("eth0", true, own), interface("eth1", false, other)};
        QVERIFY(!missingNetwork(up, own));
        const auto missing = missingNetwork(up, other);
        QVERIFY(missing);
        QVERIFY2(missing->find("eth1") != std::string::npos, missing->c_str());
        QVERIFY(!missingNetwork(up, asio::ip::make_address("10.3.0.1"))); // of none of them: nothing is claimed
    }

    void withoutAWayAllOfThemHaveToBeDown()
    {
        QVERIFY(missingNetwork(std::array{interface("lo", true), interface("eth0", false)}, std::nullopt));
        QVERIFY(!missingNetwork(std::array{interface("lo", true), interface("eth0", false), interface("eth1", true)}, std::nullopt));
        QVERIFY(!missingNetwork({}, std::nullopt)); // the kernel did not say
    }

    /// Of the very failure that is explained, a descriptor may be what is missing.
    void needsNoDescriptor()
    {
        rlimit before{};
        QCOMPARE(::getrlimit(RLIMIT_NOFILE, &before), 0);
        const rlimit none{0, before.rlim_max};
        QCOMPARE(::setrlimit(RLIMIT_NOFILE, &none), 0);
        const auto restore = qScopeGuard([&before] { (void)::setrlimit(RLIMIT_NOFILE, &before); });
        boost::system::error_code error;
        QVERIFY(!addressTowards(asio::ip::make_address("127.0.0.1"), error));
        QCOMPARE(error.value(), EMFILE);
        const boost::system::error_code failed(EMFILE, boost::system::system_category());
        QVERIFY(explainConnect(failed, "robot:1", asio::ip::make_address("192.0.2.1")).probe == ProbeResult::HostUnreachable);
    }

    void theKernelTellsOfTheLoopback()
    {
        const auto loopback = asio::ip::make_address("127.0.0.1");
        const auto found = ownInterfaces();
        QVERIFY(
            std::ranges::any_of(found, [&](const OwnInterface& one) { return one.loopback && one.running && one.address == loopback; }));
        boost::system::error_code error;
        QCOMPARE(addressTowards(loopback, error), std::optional(loopback));
        QVERIFY(!error);
        QVERIFY(!missingNetwork(found, loopback));
    }
};

QTEST_GUILESS_MAIN(ConnectionFailureTest)
#include "connection_failure_test.moc"
