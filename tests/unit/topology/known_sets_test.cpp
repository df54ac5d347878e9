// Which set counts, what differs between two, and what a person accepts.
#include "liena/known_sets.hpp"

#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>

using namespace liena;

namespace {

std::string setText(const std::string& body, const std::string& version = "1.0")
{
    return "<message-set xmlns=\"urn:liena:message-set:1\" name=\"pump\" version=\"" + version +
           "\" class=\"hand\" manufacturer=\"9\" type=\"3\" device-version=\"1\" vendor=\"Test\" title=\"Pump\">" + body + "</message-set>";
}

constexpr auto plain = R"(
  <enum name="State"><value name="Idle" number="1"/><value name="Running" number="2"/></enum>
  <message number="0x0100" name="Pump" role="command" priority="control" max-age="50ms" title="Go">
    <field name="rate" type="float32" unit="mL/min" min="0" max="5" title="Rate"/>
    <field name="mode" type="State" title="Mode"/>
  </message>
  <message number="0x0200" name="Status" role="report" priority="status" title="How it is">
    <field name="text" type="string" max-length="40" title="Text"/>
  </message>)";

std::shared_ptr<const MessageSet> parsed(const std::string& text) { return MessageSet::parse(text, "set.xml").value(); }

std::string replaced(std::string text, const std::string& what, const std::string& with)
{
    const auto at = text.find(what);
    return at == std::string::npos ? std::string() : text.replace(at, what.size(), with);
}

/// Folders with a register and a store.
struct Folders {
    QTemporaryDir root;
    std::filesystem::path registry = std::filesystem::path(root.path().toStdString()) / "devices";
    std::filesystem::path store = std::filesystem::path(root.path().toStdString()) / "state" / "sets";

    Folders() { std::filesystem::create_directories(registry); }
    void write(const std::string& name, const std::string& text) const
    {
        QFile file(QString::fromStdString((registry / name).string()));
        QVERIFY(file.open(QIODevice::WriteOnly));
        QCOMPARE(file.write(text.data(), static_cast<qint64>(text.size())), static_cast<qint64>(text.size()));
    }
    std::vector<KnownSet> known() const { return knownSets({registry}, store).value(); }
};

} // namespace

class KnownSetsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void saysWhatDiffers_data()
    {
        QTest::addColumn<QString>("what");
        QTest::addColumn<QString>("with");
        QTest::addColumn<QString>("line");
        QTest::newRow("bound") << R"(max="5")"
                               << R"(max="50")"
                               << "Pump.rate: max was 5, is 50";
        QTest::newRow("unit") << R"(unit="mL/min")"
                              << R"(unit="mL/s")"
                              << "Pump.rate: unit was mL/min, is mL/s";
        QTest::newRow("type") << R"(type="float32")"
                              << R"(type="float64")"
                              << "Pump.rate: type was float32, is float64";
        QTest::newRow("name") << R"(name="rate")"
                              << R"(name="flow")"
                              << "Pump.flow: stands where rate stood";
        QTest::newRow("age") << "50ms"
                             << "500ms"
                             << "Pump (0x0100): max-age was 50000 us, is 500000 us";
        QTest::newRow("priority") << R"(priority="status")"
                                  << R"(priority="bulk")"
                                  << "Status (0x0200): priority was status, is bulk";
        QTest::newRow("stand-by") << R"(max-age="50ms")"
                                  << R"(max-age="50ms" in-standby="allow")"
                                  << "Pump (0x0100): in-standby was refuse, is allow";
        QTest::newRow("enum value") << R"(name="Running" number="2")"
                                    << R"(name="Running" number="3")"
                                    << "enum State: Running (2) is gone";
        QTest::newRow("enum name") << R"(name="Running")"
                                   << R"(name="Purging")"
                                   << "enum State: 2 was Running, is Purging";
        QTest::newRow("length") << R"(max-length="40")"
                                << R"(max-length="60")"
                                << "Status.text: type was string of at most 40 bytes, is string of at most 60 bytes";
        QTest::newRow("number") << "0x0200"
                                << "0x0201"
                                << "Status (0x0200): is gone";
        QTest::newRow("message")
            << R"(<message number="0x0200")"
            << R"(<message number="0x0101" name="Stop" role="command" priority="safety" title="Stop"/><message number="0x0200")"
            << "Stop (0x0101): is new, a command of priority safety";
        QTest::newRow("field") << R"(<field name="mode" type="State" title="Mode"/>)"
                               << ""
                               << "Pump.mode: is gone";
        QTest::newRow("further field") << R"(<field name="mode" type="State" title="Mode"/>)"
                                       << R"(<field name="mode" type="State" title="Mode"/><field name="ramp" type="uint8[4]" title="R"/>)"
                                       << "Pump.ramp: is new, uint8[4]";
    }
    void saysWhatDiffers()
    {
        QFETCH(QString, what);
        QFETCH(QString, with);
        QFETCH(QString, line);
        const auto before = setText(plain);
        const auto now = replaced(before, what.toStdString(), with.toStdString());
        QVERIFY(!now.empty());
        const auto lines = describeChanges(*parsed(before), *parsed(now));
        QVERIFY2(std::find(lines.begin(), lines.end(), line.toStdString()) != lines.end(), lines.empty() ? "no line" : lines[0].c_str());
    }
    void saysNothingOfTitles()
    {
        const auto before = setText(plain);
        QVERIFY(describeChanges(*parsed(before), *parsed(replaced(before, R"(title="Rate")", R"(title="Flow")"))).empty());
        QVERIFY(describeChanges(*parsed(before), *parsed(before)).empty());
    }
    void registerCountsUntilAPersonAcceptsAnother()
    {
        const Folders folders;
        folders.write("pump.xml", setText(plain));
        QCOMPARE(folders.known().size(), std::size_t{1});
        QVERIFY(folders.known()[0].source == SetSource::Register);
        const auto other = parsed(setText(plain, "1.1"));
        QVERIFY(acceptSet(folders.store, *other));
        QCOMPARE(folders.known().size(), std::size_t{1});
        QVERIFY(folders.known()[0].source == SetSource::Accepted);
        QVERIFY(folders.known()[0].hash == other->hash());
        QCOMPARE(folders.known()[0].set->version(), std::string("1.1"));
    }
    void acceptsBackAgain()
    {
        const Folders folders;
        folders.write("pump.xml", setText(plain));
        QVERIFY(acceptSet(folders.store, *parsed(setText(plain, "1.1"))));
        QVERIFY(acceptSet(folders.store, *parsed(setText(plain))));
        QVERIFY(folders.known()[0].hash == parsed(setText(plain))->hash());
    }
    void withoutStoreTheRegisterCounts()
    {
        const Folders folders;
        folders.write("pump.xml", setText(plain));
        QVERIFY(!std::filesystem::exists(folders.store));
        QCOMPARE(folders.known().size(), std::size_t{1});
        QVERIFY(!std::filesystem::exists(folders.store)); // looking makes nothing
    }
};

QTEST_APPLESS_MAIN(KnownSetsTest)
#include "known_sets_test.moc"
