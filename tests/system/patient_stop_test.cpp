// The stop at the patient's side: it leaves whatever its words are, and goes on being sent while the robot does not name it.
#include "patient_side.hpp"
#include "test_system.hpp"

#include <QTest>

#include <memory>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

/// The arm with a person beside it, and a robot that says nothing of what it hears.
struct Bedside {
    TestSystem system{{reference::robot, reference::arm}, {"robot arm"}};
    TestDevice robot{system.settingsOf("robot")};
    std::unique_ptr<devices::PatientSide> side; ///< outlives the arm's run
    TestDevice arm{system.settingsOf("arm"), [this](DistributedSystem& device) {
                       side = std::make_unique<devices::PatientSide>(
                           device, [](LogLevel, std::string_view) {}, std::vector<DeviceId>(),
                           [this](std::string_view reason) { side->stopRobots(reason); });
                   }};

    bool open()
    {
        return arm->openChannel(system.idOf("robot")) &&
               QTest::qWaitFor([this] { return robot.heard(Kind::Opened) && arm.heard(Kind::Opened); }, 20000);
    }
    std::vector<Message> stops() { return robot.messages("EmergencyStop"); }
    std::string story() const { return arm.story() + robot.story(); }
};

} // namespace

class PatientStopTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// It is sent once to a robot that heard it; one that says nothing may never have got it.
    void isSentAgainWhileTheRobotDoesNotNameIt()
    {
        Bedside bedside;
        QVERIFY2(bedside.open(), bedside.story().c_str());
        bedside.side->obey("stop smoke");
        QTRY_VERIFY2(bedside.stops().size() >= 3, bedside.story().c_str());
        const auto heard = bedside.stops();
        const auto token = heard.front().get<std::uint64_t>("token");
        QVERIFY(token != 0);
        for (const auto& stop : heard) {
            QCOMPARE(stop.get<std::uint64_t>("token"), token);
            QCOMPARE(std::string(stop.get<std::string_view>("reason")), std::string("smoke"));
        }
    }

    void leavesWhateverItsWordsAre_data()
    {
        QTest::addColumn<QByteArray>("words");
        QTest::addColumn<QByteArray>("heard");
        QTest::newRow("129 bytes, of which 128 end in a character") << QByteArray("血").repeated(43) << QByteArray("血").repeated(41) + "…";
        QTest::newRow("a terminal in GBK") << QByteArray("\xB3\xF6") << QByteArray("\\xb3\\xf6");
        QTest::newRow("a terminal in Latin-1") << QByteArray("Rauch f\xFCr") << QByteArray("Rauch f\\xfcr");
    }

    void leavesWhateverItsWordsAre()
    {
        QFETCH(QByteArray, words);
        QFETCH(QByteArray, heard);
        Bedside bedside;
        QVERIFY2(bedside.open(), bedside.story().c_str());
        bedside.side->obey("stop " + words.toStdString());
        QTRY_VERIFY2(!bedside.stops().empty(), bedside.story().c_str());
        QCOMPARE(QByteArray::fromStdString(bedside.stops().front().get<std::string>("reason")), heard);
    }
};

QTEST_GUILESS_MAIN(PatientStopTest)
#include "patient_stop_test.moc"
