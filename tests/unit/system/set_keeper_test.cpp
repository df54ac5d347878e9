// A message set that cannot be checked is answered all the same, and one that can be takes nothing of the network thread's.
#include "system/set_keeper.hpp"

#include "support/bound_thread.hpp"

#include <boost/asio/post.hpp>

#include <QTest>

#include <cerrno>
#include <system_error>
#include <vector>

using namespace liena;
using namespace liena::system;

class SetKeeperTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void answersWhereNoThreadCanBeHad();
    void checksAwayFromTheProcessorsOfTheNetworkThread();
};

void SetKeeperTest::answersWhereNoThreadCanBeHad()
{
    boost::asio::io_context io;
    SetKeeper keeper(io, std::nullopt, []() -> std::unique_ptr<boost::asio::thread_pool> {
        throw std::system_error(EAGAIN, std::generic_category(), "thread");
    });
    std::vector<session::SetHeard> heard;
    keeper.learn(DeviceId(0x40018208U), Sha256{}, {}, [&](const session::SetHeard& one) { heard.push_back(one); });
    QVERIFY(heard.empty()); // whoever asks is not ready for it yet
    io.poll();
    QCOMPARE(heard.size(), std::size_t{1});
    QVERIFY(heard[0].standing == session::SetStanding::Invalid);
    QVERIFY2(heard[0].detail.find("no thread can be had") != std::string::npos, heard[0].detail.c_str());
    keeper.finish();
}

void SetKeeperTest::checksAwayFromTheProcessorsOfTheNetworkThread()
{
    const auto all = test::processorsOfProcess();
    if (CPU_COUNT(&all) < 2)
        QSKIP("there is one processor");
    boost::asio::io_context io;
    boost::asio::thread_pool* pool = nullptr;
    SetKeeper keeper(io, std::nullopt, [&pool] {
        auto started = std::make_unique<boost::asio::thread_pool>(1);
        pool = started.get();
        return started;
    });
    cpu_set_t found{};
    test::runBound([&] {
        keeper.learn(DeviceId(0x40018208U), Sha256{}, {}, [](const session::SetHeard&) {});
        boost::asio::post(*pool, [&found] { found = test::ownProcessors(); });
        keeper.finish();
    });
    QVERIFY(CPU_EQUAL(&found, &all) != 0);
}

QTEST_APPLESS_MAIN(SetKeeperTest)
#include "set_keeper_test.moc"
