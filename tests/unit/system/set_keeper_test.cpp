// A message set that cannot be checked is answered all the same.
#include "system/set_keeper.hpp"

#include <QTest>

#include <cerrno>
#include <system_error>
#include <vector>

using namespace liena;
using namespace liena::system;

class SetKeeperTest : public QObject {
    Q_OBJECT

private slots:
    void answersWhereNoThreadCanBeHad();
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

QTEST_APPLESS_MAIN(SetKeeperTest)
#include "set_keeper_test.moc"
