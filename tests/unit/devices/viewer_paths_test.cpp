// What the picture ladder hears of the links.
#include "viewer_paths.hpp"

#include <QTest>

using namespace liena;
using namespace liena::devices;

namespace {

const DeviceId cockpit(0x40018208);
const DeviceId recorder(0xE0018208);
const DeviceId robot(0x00008208);
constexpr std::uint16_t frames = 0x0202;
constexpr std::uint16_t runs = 0x0203;

LinkStatus link(DeviceId peer, std::uint64_t superseded, SessionState state = SessionState::Open)
{
    LinkStatus status;
    status.peer = peer;
    status.state = state;
    status.bulkSuperseded = superseded;
    return status;
}

} // namespace

class ViewerPathsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void countsWhatWasReplacedSinceTheLastLook()
    {
        ViewerPaths paths({cockpit}, frames);
        QCOMPARE(paths.read({link(cockpit, 3)}, {}).at(0).withheld, std::uint64_t(3));
        QCOMPARE(paths.read({link(cockpit, 3)}, {}).at(0).withheld, std::uint64_t(0));
        QCOMPARE(paths.read({link(cockpit, 5)}, {}).at(0).withheld, std::uint64_t(2));
        QCOMPARE(paths.read({link(cockpit, 0)}, {}).at(0).withheld, std::uint64_t(0)); // a counter that begins anew
    }

    void aReportThatGaveWayIsNoPicture()
    {
        ViewerPaths paths({cockpit}, frames);
        LinkStatus status = link(cockpit, 2);
        status.messagesSuperseded = 7;
        QCOMPARE(paths.read({status}, {}).at(0).withheld, std::uint64_t(2));
    }

    void addsWhatWasAcceptedAndLost()
    {
        ViewerPaths paths({cockpit, recorder}, frames);
        const auto readings = paths.read({link(cockpit, 1), link(recorder, 0)}, {{cockpit, 2}});
        QCOMPARE(readings.at(0).withheld, std::uint64_t(3));
        QCOMPARE(readings.at(1).withheld, std::uint64_t(0));
    }

    void passesTheKnownRateOn()
    {
        ViewerPaths paths({cockpit}, frames);
        LinkStatus status = link(cockpit, 0);
        QVERIFY(!paths.read({status}, {}).at(0).bulkRate);
        status.bulkRate = 2e6;
        QCOMPARE(paths.read({status}, {}).at(0).bulkRate, std::optional(2e6));
    }

    void countsOnThePicturesOwnRateOnly()
    {
        ViewerPaths paths({cockpit}, frames);
        LinkStatus status = link(cockpit, 0);
        status.bulkRate = 10e6;
        status.bulkStreams = {{runs, 6e6}, {frames, 4e6}};
        QCOMPARE(paths.read({status}, {}).at(0).bulkRate, std::optional(4e6));
        status.bulkStreams = {{runs, 10e6}}; // pictures will share the path with them
        QCOMPARE(paths.read({status}, {}).at(0).bulkRate, std::optional(5e6));
        status.bulkStreams = {{runs, 6e6}, {frames, std::nullopt}}; // that others' way is known says nothing of the pictures'
        QVERIFY(!paths.read({status}, {}).at(0).bulkRate);
        status.bulkRate.reset();
        status.bulkStreams.clear();
        QVERIFY(!paths.read({status}, {}).at(0).bulkRate);
    }

    void leavesOutWhoSeesNoPictures()
    {
        ViewerPaths paths({cockpit, recorder}, frames);
        QVERIFY(paths.read({link(robot, 9), link(cockpit, 4, SessionState::StandBy)}, {{robot, 1}}).empty());
        QCOMPARE(paths.read({link(cockpit, 4)}, {}).at(0).withheld, std::uint64_t(0)); // not what was lost before it came back
    }
};

QTEST_GUILESS_MAIN(ViewerPathsTest)
#include "viewer_paths_test.moc"
