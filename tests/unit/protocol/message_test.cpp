// Messages as applications see them: defaults, reading and writing fields, what is refused and what is a mistake.
#include "liena/message.hpp"
#include "protocol/information_part.hpp"
#include "protocol/message_access.hpp"
#include "support/hex.hpp"
#include "support/sample_set.hpp"

#include <QTest>

#include <array>
#include <filesystem>
#include <limits>

using namespace liena;
using namespace liena::test;

class MessageTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void beginsWithItsDefaults();
    void standsOnTheWireAsItsDefinitionSays();
    void readsBackWhatWasWritten();
    void changesVariableFieldsInPlace();
    void takesTextOfItsOwnOtherField();
    void takesEnumsByNameAndNumber();
    void remembersRefusedValue_data();
    void remembersRefusedValue();
    void keepsTheFirstFaultAndTheOldValue();
    void throwsForMistakesOfTheProgram();
    void copiesAreTheirOwn();
    void whatIsLentIsNotCopied();
    void whatIsNotWorthLendingIsCopied_data();
    void whatIsNotWorthLendingIsCopied();
    void onlyTheLastFieldCanBeLentTo();
    void carriesItsMetaData();
    void saysItselfInOneLine();
    void cutsLongValuesForPeople();
    void makesTextOfPeersPrintable();
    void findsDefinitionsByNumberAndName();
    void everyReferenceMessageIsSoundAtItsDefaults_data();
    void everyReferenceMessageIsSoundAtItsDefaults();
    void motionCommandHasTheLayoutOfItsFile();

private:
    Message make(std::string_view name) const { return sampleMessage(m_set, name); }

    std::shared_ptr<const MessageSet> m_set;
};

void MessageTest::initTestCase() { m_set = sampleSet(); }

void MessageTest::beginsWithItsDefaults()
{
    const auto move = make("Move");
    QCOMPARE(move.get<std::uint32_t>("permit"), 0U);
    QCOMPARE(move.get<bool>("engaged"), false);
    QCOMPARE(move.get<double>("speed"), 0.0);
    QCOMPARE(move.get<double>("force"), 0.5); // the bound next to zero
    QVERIFY(move.get<std::string_view>("mode") == "slow");
    const auto state = make("State");
    QCOMPARE(state.get<int>("count"), 7);
    QCOMPARE(state.get<int>("offset"), -10);
    QVERIFY(state.get<std::string_view>("note").empty());
    QVERIFY(state.get<std::span<const std::byte>>("raw").empty());
    QVERIFY(state.get<std::vector<double>>("axes") == std::vector<double>(3, 0.0));
    QVERIFY(state.get<std::vector<double>>("trace").empty());
    QVERIFY(state.get<std::string_view>("mode") == "fast");
    QVERIFY(!state.fault());
}

void MessageTest::standsOnTheWireAsItsDefinitionSays()
{
    auto state = make("State");
    state.set("count", 0x0102).set("offset", -11).set("note", "h\xC3\xB6").set("raw", bytesOf("ff 00"));
    state.set("axes", std::array{1.0, -1.0, 0.5}).set("trace", std::vector<double>{-2, 3}).set("mode", "slow").set("total", ~0ULL);
    QVERIFY(!state.fault());
    QCOMPARE(QString::fromStdString(hexOf(state.fieldBytes())),
             QStringLiteral("02 01 f5 ff 03 00 68 c3 b6 02 00 00 00 ff 00 00 00 80 3f 00 00 80 bf 00 00 00 3f 02 00 00 00 fe ff 03 00 03 "
                            "ff ff ff ff ff ff ff ff"));
}

void MessageTest::readsBackWhatWasWritten()
{
    auto state = make("State");
    state.set("total", std::numeric_limits<std::uint64_t>::max()).set("offset", -100).set("note", std::string("twelve bytes"));
    state.set("trace", std::vector<double>{1, 2, 3, 4}).set("axes", std::vector<double>{0.25, 0, -1}).set("raw", bytesOf("01 02 03"));
    QVERIFY(!state.fault());
    QCOMPARE(state.get<std::uint64_t>("total"), std::numeric_limits<std::uint64_t>::max());
    QCOMPARE(state.get<int>("offset"), -100);
    QVERIFY(state.get<std::string>("note") == "twelve bytes");
    QVERIFY((state.get<std::vector<double>>("trace") == std::vector<double>{1, 2, 3, 4}));
    QVERIFY((state.get<std::vector<double>>("axes") == std::vector<double>{0.25, 0, -1}));
    QCOMPARE(hexOf(state.get<std::span<const std::byte>>("raw")), std::string("01 02 03"));
    QCOMPARE(state.get<int>("count"), 7);
    QVERIFY(!protocol::checkFields(state.definition(), state.fieldBytes()));
}

void MessageTest::changesVariableFieldsInPlace()
{
    auto state = make("State");
    state.set("trace", std::vector<double>{5}).set("note", "longer text").set("total", 99U);
    state.set("note", "x").set("trace", std::vector<double>{}).set("raw", bytesOf("aa bb cc dd ee ff")).set("note", "");
    QVERIFY(!state.fault());
    QVERIFY(state.get<std::string_view>("note").empty());
    QCOMPARE(hexOf(state.get<std::span<const std::byte>>("raw")), std::string("aa bb cc dd ee ff"));
    QVERIFY(state.get<std::vector<double>>("trace").empty());
    QCOMPARE(state.get<int>("total"), 99);
    QVERIFY(!protocol::checkFields(state.definition(), state.fieldBytes()));
}

void MessageTest::takesTextOfItsOwnOtherField()
{
    const auto set = MessageSet::parse(R"(<message-set xmlns="urn:liena:message-set:1" name="two" version="1.0" class="hand"
        manufacturer="7" type="4" device-version="1" vendor="Sample" title="Two texts">
      <message number="0x0200" name="Two" role="report" priority="status" title="Two texts">
        <field name="first" type="string" max-length="400" title="First"/>
        <field name="second" type="string" max-length="400" title="Second"/>
      </message></message-set>)",
                                       "two.xml");
    QVERIFY(set);
    auto two = sampleMessage(set.value(), "Two");
    two.set("second", std::string(180, 'x') + "end");
    two.set("first", two.get<std::string_view>("second")); // grows beyond what the message holds in itself
    QVERIFY(two.get<std::string_view>("first") == std::string(180, 'x') + "end");
    two.set("second", two.get<std::string_view>("first").substr(180));
    two.set("first", two.get<std::string_view>("first").substr(180));
    QVERIFY(two.get<std::string_view>("first") == "end" && two.get<std::string_view>("second") == "end");
}

void MessageTest::takesEnumsByNameAndNumber()
{
    auto move = make("Move");
    move.set("mode", "fast");
    QCOMPARE(move.get<int>("mode"), 9);
    move.set("mode", 3);
    QVERIFY(move.get<std::string_view>("mode") == "slow");
    QVERIFY(!move.fault());
}

void MessageTest::remembersRefusedValue_data()
{
    QTest::addColumn<QString>("message");
    QTest::addColumn<QString>("field");
    QTest::addColumn<QVariant>("value");
    QTest::addColumn<QStringList>("words");
    const auto row = [](const char* name, const char* message, const char* field, const QVariant& value, const QStringList& words) {
        QTest::newRow(name) << QString::fromLatin1(message) << QString::fromLatin1(field) << value << words;
    };
    row("above the bound", "Move", "speed", 40.5, {QStringLiteral("40.5"), QStringLiteral("-40"), QStringLiteral("40")});
    row("below the bound", "Move", "force", 0.25, {QStringLiteral("0.25"), QStringLiteral("0.5"), QStringLiteral("30")});
    row("not a number", "Move", "speed", std::numeric_limits<double>::quiet_NaN(), {QStringLiteral("nan")});
    row("infinite", "Move", "force", std::numeric_limits<double>::infinity(), {QStringLiteral("inf")});
    row("negative in unsigned", "Move", "permit", -1, {QStringLiteral("-1")});
    row("too large for the type", "State", "count", 65536, {QStringLiteral("65536")});
    row("undeclared number", "Move", "mode", 4, {QStringLiteral("4")});
    row("text too long", "State", "note", QStringLiteral("thirteen byte"), {QStringLiteral("12")});
    row("bool 2", "Move", "engaged", 2, {QStringLiteral("2")});
}

void MessageTest::remembersRefusedValue()
{
    QFETCH(QString, message);
    QFETCH(QString, field);
    QFETCH(QVariant, value);
    QFETCH(QStringList, words);
    auto subject = make(message.toStdString());
    const auto before = hexOf(subject.fieldBytes());
    if (value.metaType().id() == QMetaType::Double)
        subject.set(field.toStdString(), value.toDouble());
    else if (value.metaType().id() == QMetaType::QString)
        subject.set(field.toStdString(), value.toString().toStdString());
    else
        subject.set(field.toStdString(), value.toInt());
    QVERIFY(subject.fault());
    QVERIFY(subject.fault()->code == Errc::ValueRefused);
    const auto what = QString::fromStdString(subject.fault()->what);
    for (const auto& word : QStringList{message, field} + words)
        QVERIFY2(what.contains(word), qPrintable(what));
    QCOMPARE(hexOf(subject.fieldBytes()), before);
}

void MessageTest::keepsTheFirstFaultAndTheOldValue()
{
    auto state = make("State");
    state.set("axes", std::vector<double>{0.5, 0.5, 0.5});
    state.set("axes", std::vector<double>{0, 2, 0}).set("trace", std::vector<double>{1, 2, 3, 4, 5});
    QVERIFY(state.fault());
    QVERIFY(state.fault()->what.find("axes") != std::string::npos);
    QVERIFY((state.get<std::vector<double>>("axes") == std::vector<double>{0.5, 0.5, 0.5}));
    QVERIFY(state.get<std::vector<double>>("trace").empty());
    state.set("note", "fine");
    QVERIFY(state.fault());
}

void MessageTest::throwsForMistakesOfTheProgram()
{
    auto state = make("State");
    QVERIFY_EXCEPTION_THROWN(state.set("nothing", 1), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(static_cast<void>(state.get<int>("nothing")), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(static_cast<void>(state.get<int>(std::size_t{8})), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(static_cast<void>(state.get<std::string_view>("count")), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(static_cast<void>(state.get<int>("note")), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(static_cast<void>(state.get<double>("axes")), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(static_cast<void>(state.get<std::span<const std::byte>>("note")), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(static_cast<void>(state.get<std::vector<double>>("raw")), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(state.set("note", 5), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(state.set("count", "five"), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(state.set("mode", "warp"), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(state.set("axes", 1.0), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(state.set("raw", std::vector<double>{1.0}), std::logic_error);
}

void MessageTest::copiesAreTheirOwn()
{
    auto first = make("State");
    first.set("note", "first");
    auto second = first;
    second.set("note", "second");
    QVERIFY(first.get<std::string_view>("note") == "first");
    QVERIFY(second.get<std::string_view>("note") == "second");
}

namespace {

std::shared_ptr<const MessageSet> imageSet()
{
    const auto set = MessageSet::parse(R"(<message-set xmlns="urn:liena:message-set:1" name="images" version="1.0" class="eye"
        manufacturer="7" type="5" device-version="1" vendor="Sample" title="Images">
      <message number="0x0200" name="Image" role="report" priority="bulk" title="An image">
        <field name="note" type="string" max-length="40" title="Note"/>
        <field name="number" type="uint32" min="0" max="1000" title="Number"/>
        <field name="pixels" type="bytes" max-length="100000" title="Pixels"/>
      </message>
      <message number="0x0201" name="Small" role="report" priority="status" title="Not a bulk message">
        <field name="first" type="bytes" max-length="100000" title="First"/>
        <field name="pixels" type="bytes" max-length="100000" title="Pixels"/>
      </message></message-set>)",
                                       "images.xml");
    return set ? set.value() : nullptr;
}

using Pixels = std::shared_ptr<std::vector<std::byte>>;

Pixels pixelsOf(std::size_t size) { return std::make_shared<std::vector<std::byte>>(filled(size, 0x5A)); }

} // namespace

void MessageTest::whatIsLentIsNotCopied()
{
    const auto pixels = pixelsOf(50000);
    {
        auto image = sampleMessage(imageSet(), "Image");
        image.lend("pixels", pixels, *pixels);
        image.set("note", "behind").set("number", 12); // before it in the message, after it in time
        QVERIFY(image.get<std::span<const std::byte>>("pixels").data() == pixels->data());
        QVERIFY(image.lentBytes().data() == pixels->data());
        QVERIFY(image.get<std::string_view>("note") == "behind");
        QVERIFY(image.toString().find("(50000 bytes)") != std::string::npos);
        auto copied = sampleMessage(imageSet(), "Image");
        copied.set("note", "behind").set("number", 12).set("pixels", std::span<const std::byte>(*pixels));
        QCOMPARE(image.encodedSize(), copied.encodedSize());
        std::vector<std::byte> wire(image.fieldBytes().begin(), image.fieldBytes().end());
        wire.insert(wire.end(), image.lentBytes().begin(), image.lentBytes().end());
        QVERIFY(std::equal(wire.begin(), wire.end(), copied.fieldBytes().begin(), copied.fieldBytes().end()));
        const auto second = image;
        QVERIFY(second.lentBytes().data() == pixels->data());
        QVERIFY(pixels.use_count() == 2); // both messages together
        image.set("pixels", image.get<std::span<const std::byte>>("pixels").first(10));
        QVERIFY(image.lentBytes().empty());
        QCOMPARE(image.get<std::span<const std::byte>>("pixels").size(), std::size_t{10});
        QVERIFY(image.get<std::span<const std::byte>>("pixels")[9] == std::byte{0x5A});
        QVERIFY(!image.fault());
        image.lend("pixels", pixels, *pixels);
        QCOMPARE(image.encodedSize(), copied.encodedSize());
    }
    QVERIFY(pixels.use_count() == 1);
}

void MessageTest::whatIsNotWorthLendingIsCopied_data()
{
    QTest::addColumn<QString>("message");
    QTest::addColumn<quint64>("size");
    QTest::newRow("short") << "Image" << quint64{100};
    QTest::newRow("empty") << "Image" << quint64{0};
    QTest::newRow("not bulk") << "Small" << quint64{50000};
}

void MessageTest::whatIsNotWorthLendingIsCopied()
{
    QFETCH(QString, message);
    QFETCH(quint64, size);
    const auto pixels = pixelsOf(size);
    auto image = sampleMessage(imageSet(), message.toStdString());
    image.lend("pixels", pixels, *pixels);
    QVERIFY(pixels.use_count() == 1 && image.lentBytes().empty());
    const auto held = image.get<std::span<const std::byte>>("pixels");
    QVERIFY(std::equal(held.begin(), held.end(), pixels->begin(), pixels->end()));
}

void MessageTest::onlyTheLastFieldCanBeLentTo()
{
    const auto pixels = pixelsOf(100001);
    auto small = sampleMessage(imageSet(), "Small");
    QVERIFY_EXCEPTION_THROWN(small.lend("first", pixels, *pixels), std::logic_error);
    auto image = sampleMessage(imageSet(), "Image");
    QVERIFY_EXCEPTION_THROWN(image.lend("number", pixels, *pixels), std::logic_error);
    image.lend("pixels", pixels, *pixels); // one too many
    QVERIFY(image.fault() && image.fault()->what.find("100000") != std::string::npos);
    QVERIFY(pixels.use_count() == 1);
}

void MessageTest::carriesItsMetaData()
{
    auto state = make("State");
    MessageAccess::setMeta(state, DeviceId(0x00038610U), DeviceId(0x40018208U), Timestamp{5});
    QVERIFY(state.origin() == DeviceId(0x00038610U) && state.target() == DeviceId(0x40018208U) && state.timestamp() == Timestamp{5});
    QVERIFY((state.id() == MessageId{DeviceId(0x00038610U), 0x0200}));
    QVERIFY(!state.latency());
    const auto arrival = std::chrono::steady_clock::time_point(std::chrono::seconds(9));
    MessageAccess::setArrival(state, arrival, std::chrono::milliseconds(3));
    QVERIFY(state.arrival() == arrival && state.latency() == std::chrono::milliseconds(3));
}

void MessageTest::saysItselfInOneLine()
{
    auto move = make("Move");
    move.set("permit", 4).set("engaged", true).set("speed", 2.5).set("mode", "fast");
    QCOMPARE(QString::fromStdString(move.toString()), QStringLiteral("Move permit=4 engaged=true speed=2.5 force=0.5 mode=fast"));
    QCOMPARE(make("Stop").toString(), std::string("Stop"));
}

void MessageTest::cutsLongValuesForPeople()
{
    auto picture = make("Picture");
    picture.set("pixels", filled(1000000, 0xAB));
    QVERIFY(picture.toString().size() < 400);
    auto line = make("Log");
    line.set("line", std::string(200, 'x'));
    QVERIFY(line.toString().size() < 200);
}

void MessageTest::makesTextOfPeersPrintable()
{
    auto line = make("Log");
    line.set("line", "a\nb\x1b[2J");
    QVERIFY(!line.fault());
    const auto text = line.toString();
    QVERIFY(text.find('\n') == std::string::npos && text.find('\x1b') == std::string::npos);
}

void MessageTest::findsDefinitionsByNumberAndName()
{
    QVERIFY(m_set->find(0x0200) == m_set->find("State"));
    QVERIFY(m_set->find(0x0203) == nullptr);
    QVERIFY(m_set->find("state") == nullptr);
    const auto& state = *m_set->find("State");
    QVERIFY(state.indexOf("raw") == std::size_t{3});
    QVERIFY(!state.indexOf("Raw"));
    QCOMPARE(state.maximumSize(), std::size_t{2 + 2 + 14 + 10 + 12 + 12 + 1 + 8});
    QCOMPARE(m_set->find("Move")->maximumSize(), std::size_t{16 + 4 + 1 + 4 + 8 + 1});
    QCOMPARE(m_set->find("Stop")->maximumSize(), std::size_t{0});
}

void MessageTest::everyReferenceMessageIsSoundAtItsDefaults_data()
{
    QTest::addColumn<QString>("file");
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(LIENA_SOURCE_DIR "/resources/devices"))
        if (entry.path().extension() == ".xml") {
            QTest::newRow(entry.path().stem().c_str()) << QString::fromStdString(entry.path().string());
            ++files;
        }
    QVERIFY(files >= 4);
}

void MessageTest::everyReferenceMessageIsSoundAtItsDefaults()
{
    QFETCH(QString, file);
    const auto set = MessageSet::load(file.toStdString());
    QVERIFY2(set.has_value(), set ? "" : set.error().what.c_str());
    for (const auto& definition : set.value()->messages()) {
        const Message message(set.value(), definition);
        const auto fault = protocol::checkFields(definition, message.fieldBytes());
        QVERIFY2(!fault, fault ? fault->c_str() : "");
        QVERIFY(message.fieldBytes().size() + definition.recordSize() <= definition.maximumSize());
        QVERIFY(definition.path != Path::Datagram || definition.maximumSize() <= 1200);
        QVERIFY(definition.priority != Priority::Control || definition.maximumSize() <= 32767);
        QVERIFY(message.toString().starts_with(definition.name));
    }
}

void MessageTest::motionCommandHasTheLayoutOfItsFile()
{
    const auto set = MessageSet::load(LIENA_SOURCE_DIR "/resources/devices/vascular-robot.xml");
    QVERIFY(set);
    Message motion(set.value(), *set.value()->find("MotionCommand"));
    QCOMPARE(motion.definition().number, std::uint16_t{0x0101});
    QVERIFY(motion.definition().maxAge == std::chrono::milliseconds(50));
    motion.set("permit", 4).set("sequence", 9).set("engaged", true).set("guidewire_velocity", -2.5).set("catheter_rotation", 360);
    QVERIFY(!motion.fault());
    QCOMPARE(QString::fromStdString(hexOf(motion.fieldBytes())),
             QStringLiteral("04 00 00 00 09 00 00 00 01 00 00 20 c0 00 00 00 00 00 00 00 00 00 00 b4 43"));
    QCOMPARE(motion.definition().maximumSize(), std::size_t{16 + 25});
    motion.set("guidewire_velocity", 40.001);
    QVERIFY(motion.fault());
}

QTEST_APPLESS_MAIN(MessageTest)
#include "message_test.moc"
