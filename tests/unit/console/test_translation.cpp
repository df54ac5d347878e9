// Every message that the console understands, translated. What becomes of a session is tried by unit.session_intake.
#include "link/message_intake.hpp"
#include "link/translate.hpp"
#include "linked_models.hpp"
#include "protocol/message_access.hpp"

#include <liena/message_set.hpp>

#include <QTest>

#include <map>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

liena::Message compose(const char* set, const char* message)
{
    static std::map<std::string, std::shared_ptr<const liena::MessageSet>> known;
    auto& held = known[set];
    if (!held)
        held = liena::MessageSet::load(std::string(LIENA_SOURCE_DIR "/resources/devices/") + set + ".xml").value();
    return liena::Message(held, *held->find(std::string_view(message)));
}

} // namespace

class TestTranslation : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void robotStatusComesThrough()
    {
        auto m = compose("vascular-robot", "RobotStatus");
        m.set("state", std::string_view("Engaged"))
            .set("permit", 42U)
            .set("owner", 0x40018209U)
            .set("engaged", true)
            .set("hold_confirmed", false);
        m.set("hold_since_ns", std::uint64_t(5)).set("last_sequence", 9U).set("applied_commands", std::uint64_t(1) << 40U);
        m.set("refused_commands", std::uint64_t(3)).set("guidewire_position", 12.5).set("guidewire_angle", -720.25);
        m.set("catheter_position", 3.5).set("catheter_angle", 1.5).set("guidewire_velocity", -8.0).set("guidewire_rotation", 90.0);
        m.set("catheter_velocity", 2.0).set("catheter_rotation", -4.0).set("guidewire_force", 0.5).set("guidewire_torque", -2.5);
        m.set("guidewire_gripper_closed", true).set("catheter_gripper_closed", false).set("limit_switches", std::uint16_t(0x24));
        m.set("contrast_remaining", 80.0)
            .set("emergency_stop_token", std::uint64_t(0xFFFFFFFFFFFFFFFF))
            .set("fault_code", std::uint16_t(4));
        QVERIFY(!m.fault());
        const auto s = robotStatus(m);
        QCOMPARE(s.state, RobotState::Engaged);
        QCOMPARE(s.permit, 42U);
        QCOMPARE(s.owner, 0x40018209U);
        QVERIFY(s.engaged && !s.holdConfirmed);
        QCOMPARE(s.holdSinceNs, quint64(5));
        QCOMPARE(s.lastSequence, 9U);
        QCOMPARE(s.appliedCommands, quint64(1) << 40U);
        QCOMPARE(s.refusedCommands, quint64(3));
        QCOMPARE(s.guidewirePosition, 12.5);
        QCOMPARE(s.guidewireAngle, -720.25);
        QCOMPARE(s.catheterPosition, 3.5);
        QCOMPARE(s.catheterAngle, 1.5);
        QCOMPARE(s.guidewireVelocity, -8.0);
        QCOMPARE(s.guidewireRotation, 90.0);
        QCOMPARE(s.catheterVelocity, 2.0);
        QCOMPARE(s.catheterRotation, -4.0);
        QCOMPARE(s.guidewireForce, 0.5);
        QCOMPARE(s.guidewireTorque, -2.5);
        QVERIFY(s.guidewireGripperClosed && !s.catheterGripperClosed);
        QCOMPARE(s.limitSwitches, quint16(GuidewireHardLow | CatheterSoftHigh));
        QCOMPARE(s.contrastRemaining, 80.0);
        QCOMPARE(s.emergencyStopToken, ~quint64(0));
        QCOMPARE(faultText(s.faultCode), QStringLiteral("command stream lost"));
    }

    void otherRobotReportsComeThrough()
    {
        auto drives = compose("vascular-robot", "DriveStatus");
        drives.set("enabled", std::vector<double>{1, 1, 0, 1}).set("current", std::vector<double>{0.5, 1, 1.5, 2});
        drives.set("temperature", std::vector<double>{20, 21, 22, 23}).set("bus_voltage", std::vector<double>{48, 48, 47, 48});
        const auto d = driveStatus(drives);
        QVERIFY(d.enabled[0] && d.enabled[1] && !d.enabled[2] && d.enabled[3]);
        QVERIFY(!d.allEnabled());
        QCOMPARE(d.current[2], 1.5);
        QCOMPARE(d.temperature[3], 23.0);
        QCOMPARE(d.busVoltage[2], 47.0);

        auto tip = compose("vascular-robot", "TipPose");
        tip.set("valid", true)
            .set("position", std::vector<double>{1, 2, 3})
            .set("quaternion", std::vector<double>{1, 0, 0, 0})
            .set("error", 0.5);
        const auto t = tipPose(tip);
        QVERIFY(t.valid);
        QCOMPARE(t.position, (std::array<double, 3>{1, 2, 3}));
        QCOMPARE(t.quaternion[0], 1.0);
        QCOMPARE(t.error, 0.5);

        auto limits = compose("vascular-robot", "TravelLimits");
        limits.set("guidewire_soft", std::vector<double>{0, 837}).set("guidewire_hard", std::vector<double>{-5, 842});
        limits.set("catheter_soft", std::vector<double>{1, 400}).set("catheter_hard", std::vector<double>{-2, 410});
        const auto travel = travelLimits(limits);
        QCOMPARE(travel.guidewire.soft.high, 837.0);
        QCOMPARE(travel.guidewire.hard.low, -5.0);
        QCOMPARE(travel.catheter.soft.low, 1.0);
        QCOMPARE(travel.catheter.hard.high, 410.0);

        auto injection = compose("vascular-robot", "InjectionReport");
        injection.set("injection", 6U).set("delivered", 1.5).set("state", std::string_view("refused")).set("reason", "empty");
        const auto i = injectionStatus(injection);
        QCOMPARE(i.injection, 6U);
        QCOMPARE(i.progress, InjectionProgress::Refused);
        QCOMPARE(i.reason, QStringLiteral("empty"));
    }

    void armAndXrayReportsComeThrough()
    {
        auto status = compose("arm-grasper", "ArmStatus");
        status.set("positions", std::vector<double>{0.5, 0, 0, 0, 0, -1})
            .set("brake", true)
            .set("state", std::string_view("Moving"))
            .set("holding", true);
        const auto a = armStatus(status);
        QCOMPARE(a.positions[5], -1.0);
        QCOMPARE(a.phase, ArmPhase::Moving);
        QVERIFY(a.brake && a.holding);

        auto xray = compose("cbct-xray", "AcquisitionStatus");
        xray.set("mode", std::string_view("acquisition")).set("beam_on", true).set("tube_voltage", 70.0).set("pulse_rate", 15.0);
        xray.set("air_kerma", 12.0).set("source_detector_distance", 1100.0).set("table_position", std::vector<double>{1, 2, 3});
        xray.set("frames_withheld", std::uint64_t(7));
        const auto x = acquisitionStatus(xray);
        QCOMPARE(x.mode, AcquisitionMode::Acquisition);
        QVERIFY(x.beamOn);
        QCOMPARE(x.tubeVoltage, 70.0);
        QCOMPARE(x.pulseRate, 15.0);
        QCOMPARE(x.airKerma, 12.0);
        QCOMPARE(x.geometry.sourceDetectorDistance, 1100.0);
        QCOMPARE(x.geometry.table[2], 3.0);
        QCOMPARE(x.framesWithheld, quint64(7));
    }

    void frameKeepsItsMessageAndCopiesNoPixel()
    {
        auto m = compose("cbct-xray", "XrayFrame");
        const std::vector<std::byte> pixels(32, std::byte{7});
        m.set("frame", 3U).set("acquisition", 2U).set("capture_ns", std::uint64_t(1000)).set("source", std::string_view("recorded"));
        m.set("rows", std::uint16_t(4)).set("columns", std::uint16_t(4)).set("bits_stored", std::uint8_t(12));
        m.set("photometric", std::string_view("MONOCHROME1")).set("encoding", std::string_view("jpeg-ls")).set("quality", std::uint8_t(2));
        m.set("pixel_intensity_relationship", std::string_view("LOG")).set("imager_pixel_spacing", 0.25).set("window_centre", 100.0);
        m.set("rung", std::uint8_t(3)).set("rate", 7.5).set("asked_rate", 15.0).set("asked_encoding", std::string_view("raw"));
        m.set("window_width", 50.0).set("mask", true).set("pixels", std::span<const std::byte>(pixels));
        QVERIFY(!m.fault());
        auto kept = std::make_shared<const liena::Message>(m);
        const std::weak_ptr<const liena::Message> watch = kept;
        auto frame = xrayFrame(std::move(kept), 1ms);
        QVERIFY(!watch.expired());
        QCOMPARE(frame->pixels.data(), watch.lock()->get<std::span<const std::byte>>("pixels").data());
        QCOMPARE(frame->pixels.size(), std::size_t(32));
        QCOMPARE(frame->encodedBytes, std::size_t(32));
        QCOMPARE(frame->frame, 3U);
        QCOMPARE(frame->source, PictureSource::Recorded);
        QCOMPARE(frame->rows, 4);
        QCOMPARE(frame->bitsStored, 12);
        QCOMPARE(frame->photometric, Photometric::Monochrome1);
        QCOMPARE(frame->encoding, PixelEncoding::JpegLs);
        QCOMPARE(frame->quality, 2);
        QCOMPARE(reductionOf(*frame), (PictureReduction{3, 7.5, 15, PixelEncoding::JpegLs, 2}));
        QCOMPARE(frame->askedEncoding, PixelEncoding::Raw);
        QCOMPARE(frame->intensity, IntensityRelationship::Logarithmic);
        QVERIFY(frame->mask);
        QVERIFY(!frame->ageAtArrival); // the clocks were not compared
        frame.reset();
        QVERIFY(watch.expired());
    }

    void frameTellsWhatPassedBeforeItWasSent()
    {
        auto m = compose("cbct-xray", "XrayFrame");
        m.set("capture_ns", std::uint64_t(1'000'000'000));
        const auto sent = [&m](std::uint64_t ns, std::optional<std::chrono::nanoseconds> latency) {
            liena::MessageAccess::setMeta(m, {}, {}, {ns});
            liena::MessageAccess::setArrival(m, std::chrono::steady_clock::now(), latency);
            return xrayFrame(std::make_shared<const liena::Message>(m), 1ms);
        };
        const auto frame = sent(1'021'000'000, 9ms);
        QCOMPARE(frame->beforeSending, Duration(21ms));
        QCOMPARE(frame->ageAtArrival.value(), Duration(30ms));
        QVERIFY(!sent(999'999'999, 9ms)->ageAtArrival); // sent before it was taken: a lie or a fault
        QVERIFY(!sent(1'021'000'000, std::nullopt)->ageAtArrival);
    }

    void unknownMessageIsToldOnce()
    {
        ConsoleModels models;
        fill(models);
        MessageIntake intake(models);
        const auto note = compose("siat-cockpit", "OperatorNote");
        QVERIFY(!intake.take(robot.value(), note));
        QVERIFY(!intake.take(robot.value(), note));
        QCOMPARE(models.log.rowCount(), 1);
        QVERIFY(intake.take(robot.value(), compose("vascular-robot", "RobotStatus")));
        QCOMPARE(models.instrument.statusCount(), quint64(1));
    }

    void reportsOfTheWrongDeviceAreNotShownAndToldOnce_data()
    {
        QTest::addColumn<QByteArray>("set");
        QTest::addColumn<QByteArray>("report");
        QTest::addColumn<quint32>("right");
        for (const char* report : {"RobotStatus", "TipPose", "DriveStatus", "InjectionReport", "TravelLimits"})
            QTest::newRow(report) << QByteArray("vascular-robot") << QByteArray(report) << robot.value();
        QTest::newRow("ArmStatus") << QByteArray("arm-grasper") << QByteArray("ArmStatus") << arm.value();
        QTest::newRow("AcquisitionStatus") << QByteArray("cbct-xray") << QByteArray("AcquisitionStatus") << xray.value();
    }

    /// A second robot of the same kind, or the arm with a robot's report: neither may stand for the robot.
    void reportsOfTheWrongDeviceAreNotShownAndToldOnce()
    {
        QFETCH(QByteArray, set);
        QFETCH(QByteArray, report);
        QFETCH(quint32, right);
        ConsoleModels models;
        fill(models);
        MessageIntake intake(models);
        const auto message = compose(set.constData(), report.constData());
        const auto second = right + 1; // another index: the same kind
        QCOMPARE(kindOf(second), kindOf(right));
        const auto other = right == arm.value() ? robot.value() : arm.value();
        for (const auto wrong : {second, other, cockpit.value(), second})
            QVERIFY(!intake.take(wrong, message));
        QCOMPARE(models.log.rowCount(), 3);
        QVERIFY(!models.instrument.robot().known() && !models.instrument.tip().known() && !models.instrument.drives().known());
        QVERIFY(models.instrument.injections().empty() && !models.arm.status().known() && !models.xray.status().known());
        QVERIFY(intake.take(right, message));
        QCOMPARE(models.log.rowCount(), 3);
    }

    void messageOfAnotherShapeIsRefusedAndTold()
    {
        const char* const xml = R"(<?xml version="1.0" encoding="UTF-8"?>
<message-set xmlns="urn:liena:message-set:1" name="other-robot" version="1.0" class="hand" manufacturer="9" type="1" device-version="1"
             vendor="Other" title="Another robot">
  <message number="0x0200" name="RobotStatus" role="report" priority="status" title="Little">
    <field name="permit" type="uint32" min="0" max="10" title="Permit"/>
  </message>
</message-set>)";
        const auto set = liena::MessageSet::parse(xml, "other.xml");
        QVERIFY2(set.has_value(), set ? "" : set.error().what.c_str());
        ConsoleModels models;
        fill(models);
        MessageIntake intake(models);
        QVERIFY(!intake.take(robot.value(), liena::Message(set.value(), set.value()->messages().front())));
        QVERIFY(!models.instrument.robot().known());
        QCOMPARE(models.log.rowCount(), 1);
    }
};

QTEST_GUILESS_MAIN(TestTranslation)
#include "test_translation.moc"
