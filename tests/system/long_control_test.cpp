// Control messages that are as long as one may be, between real devices: each arrives whole, and none ends the session.
#include "test_system.hpp"

#include <QDir>
#include <QFile>
#include <QTest>

#include <algorithm>
#include <span>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

constexpr std::size_t longest = 32'767 - 16 - 4; // a body less the safety record and the field's length

constexpr auto desk = R"(<message-set xmlns="urn:liena:message-set:1" name="desk" version="1.0" class="brain" manufacturer="9" type="1"
             device-version="1" vendor="Test" title="Commands, and says much"/>
)";
constexpr auto stage = R"(<message-set xmlns="urn:liena:message-set:1" name="stage" version="1.0" class="hand" manufacturer="9" type="1"
             device-version="1" vendor="Test" title="Moves as a table says">
  <message number="0x0100" name="LoadTable" role="command" priority="control" title="One long control message">
    <field name="table" type="bytes" max-length="32747" title="Any"/>
  </message>
  <message number="0x0101" name="Step" role="command" priority="control" title="A short one">
    <field name="number" type="uint32" title="Counts"/>
  </message>
</message-set>
)";
const DeviceSpec deskDevice{"desk", "0x40048208", "desk"};
const DeviceSpec stageDevice{"stage", "0x00048208", "stage"};

Settings settingsOf(TestSystem& system, const std::string& name)
{
    const auto folder = system.folder() / "sets";
    QDir().mkpath(QString::fromStdString(folder.string()));
    for (const auto& [file, text] : {std::pair("desk.xml", desk), std::pair("stage.xml", stage)}) {
        QFile out(QString::fromStdString((folder / file).string()));
        if (!out.open(QIODevice::WriteOnly) || out.write(text) < 0)
            throw std::runtime_error("cannot write the message sets");
    }
    auto settings = system.settingsOf(name);
    settings.registry = {folder};
    return settings;
}

std::vector<std::byte> tableOf(std::size_t size)
{
    std::vector<std::byte> table(size);
    std::ranges::generate(table, [next = 0U]() mutable { return static_cast<std::byte>(next++ * 7); });
    return table;
}

} // namespace

class LongControlTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void arrivesWholeAndInOrder_data()
    {
        QTest::addColumn<QString>("mode");
        QTest::addColumn<quint64>("size");
        for (const char* mode : {"tls", "none"}) {
            QTest::addRow("shorter than a segment, %s", mode) << mode << quint64{8'000};
            QTest::addRow("longer than a segment, %s", mode) << mode << quint64{8'192};
            QTest::addRow("as long as it may be, %s", mode) << mode << quint64{longest};
        }
    }
    void arrivesWholeAndInOrder()
    {
        QFETCH(const QString, mode);
        QFETCH(const quint64, size);
        TestSystem system({deskDevice, stageDevice}, {"desk stage"}, {mode.toStdString()});
        const auto stageId = system.idOf("stage");
        TestDevice stage(settingsOf(system, "stage"));
        TestDevice desk(settingsOf(system, "desk"));
        QVERIFY(desk->openChannel(stageId));
        QTRY_VERIFY2(desk->links().front().peerEpoch > 0, desk.story().c_str()); // before, control is refused
        const auto table = tableOf(size);
        constexpr std::uint32_t count = 5;
        for (std::uint32_t number = 1; number <= count; ++number) {
            auto load = desk->command(stageId, "LoadTable").value();
            auto step = desk->command(stageId, "Step").value();
            load.set("table", std::span<const std::byte>(table));
            step.set("number", number);
            QVERIFY2(desk->send(stageId, std::move(load)) && desk->send(stageId, std::move(step)), desk.story().c_str());
            QTRY_VERIFY2(!stage.messages("Step").empty() && stage.messages("Step").back().get<std::uint32_t>("number") == number,
                         (desk.story() + stage.story()).c_str());
        }
        const auto loaded = stage.messages("LoadTable");
        QCOMPARE(loaded.size(), std::size_t{count});
        for (const auto& message : loaded)
            QVERIFY(std::ranges::equal(message.get<std::span<const std::byte>>("table"), table));
        QVERIFY2(!stage.heard(Kind::Lost) && !desk.heard(Kind::Lost), (desk.story() + stage.story()).c_str());
        QCOMPARE(words(desk.state(stageId)), words(SessionState::Open));
    }
};

QTEST_GUILESS_MAIN(LongControlTest)
#include "long_control_test.moc"
