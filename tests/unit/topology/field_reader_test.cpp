// Every rule for the fields of a message: what is read, and what is refused where.
#include "set_texts.hpp"

using namespace liena;
using namespace liena::test;

namespace {

FieldDefinition onlyField(const QByteArray& field)
{
    Findings findings;
    const auto set = MessageSet::parse(inMessage(field).toStdString(), "set.xml", &findings);
    if (!set || !findings.empty())
        qFatal("%s", listed(findings).c_str());
    return set.value()->messages().at(0).fields.at(0);
}

} // namespace

class FieldReaderTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void refusesWrongFields_data();
    void refusesWrongFields();
    void readsTypesAndShapes();
    void readsBoundsInTheFieldsType();
    void roundsFloatBoundsToNearest();
    void readsDefaults();
};

void FieldReaderTest::refusesWrongFields_data()
{
    QTest::addColumn<QByteArray>("xml");
    QTest::addColumn<QByteArray>("fragment");
    const auto row = [](const char* name, const QByteArray& attributes, const char* fragment) {
        QTest::newRow(name) << inMessage("<field name=\"f\" " + attributes + "/>") << QByteArray(fragment);
    };
    const auto whole = [](const char* name, const QByteArray& fields, const char* fragment) {
        QTest::newRow(name) << inMessage(fields) << QByteArray(fragment);
    };
    whole("no name", "@@<field type=\"bool\"/>", "'name'");
    whole("no type", "@@<field name=\"f\"/>", "'type'");
    whole("name twice", "<field name=\"f\" type=\"bool\"/>\n<field name=\"@@f\" type=\"bool\"/>", "in line 4");
    row("misspelt type", "type=\"@@flaot32\"", "did you mean 'float32'?");
    row("unknown enum", "type=\"@@Modes\"", "did you mean 'Mode'?");
    row("strange type", "type=\"@@matrix\"", "neither a type nor an enum");
    row("array of none", "type=\"@@uint8[0]\"", "1 to 65535");
    row("array too long", "type=\"@@uint8[65536]\"", "1 to 65535");
    row("array not closed", "type=\"@@uint8[3\"", "1 to 65535");
    row("array of arrays", "type=\"@@uint8[3][3]\"", "no array");
    row("array of strings", "type=\"@@string[3]\" max-length=\"4\"", "cannot be repeated");
    row("sequence of bytes", "type=\"@@bytes[]\" max-count=\"4\"", "cannot be repeated");
    whole("string without length", "@@<field name=\"f\" type=\"string\"/>", "'max-length'");
    whole("bytes without length", "@@<field name=\"f\" type=\"bytes\"/>", "'max-length'");
    whole("sequence without count", "@@<field name=\"f\" type=\"uint8[]\"/>", "'max-count'");
    row("string too long", "type=\"string\" max-length=\"@@65536\"", "1 to 65535");
    row("string of nothing", "type=\"string\" max-length=\"@@0\"", "1 to 65535");
    row("count of nothing", "type=\"uint8[]\" max-count=\"@@0\"", "no max-count");
    row("length of a number", "type=\"uint8\" @@max-length=\"3\"", "only string and bytes");
    row("count of an array", "type=\"uint8[3]\" @@max-count=\"3\"", "only a sequence");
    row("min beyond type", "type=\"uint8\" min=\"@@-1\"", "no uint8");
    row("max beyond type", "type=\"uint8\" max=\"@@256\"", "no uint8");
    row("max beyond int16", "type=\"int16\" max=\"@@32768\"", "no int16");
    row("min beyond int64", "type=\"int64\" min=\"@@-9223372036854775809\"", "no int64");
    row("max beyond uint64", "type=\"uint64\" max=\"@@18446744073709551616\"", "no uint64");
    row("fraction of an integer", "type=\"int32\" min=\"@@0.5\"", "whole decimal");
    row("exponent of an integer", "type=\"int32\" max=\"@@1e3\"", "whole decimal");
    row("max beyond float32", "type=\"float32\" max=\"@@3.5e38\"", "no float32");
    row("max beyond float64", "type=\"float64\" max=\"@@1e309\"", "no float64");
    row("bound that is NaN", "type=\"float32\" min=\"@@NaN\"", "finite");
    row("bound that is infinite", "type=\"float64\" max=\"@@inf\"", "finite");
    row("hexadecimal float", "type=\"float64\" max=\"@@0x1p3\"", "finite");
    row("bound with a unit", "type=\"float64\" max=\"@@40 mm\"", "finite");
    row("bound with a comma", "type=\"float64\" max=\"@@0,5\"", "finite");
    row("plus sign", "type=\"int32\" max=\"@@+5\"", "whole decimal");
    row("empty bound", "type=\"int32\" max=\"@@\"", "whole decimal");
    row("max below min", "type=\"float32\" min=\"40\" max=\"@@-40\"", "below min 40");
    row("max below min, unsigned", "type=\"uint64\" min=\"18446744073709551615\" max=\"@@1\"", "below min");
    row("bounds of a bool", "type=\"bool\" @@min=\"0\"", "bool has no bounds");
    row("bounds of a string", "type=\"string\" max-length=\"3\" @@max=\"4\"", "no bounds");
    row("bounds of an enum", "type=\"Mode\" @@max=\"1\"", "Mode has no bounds");
    row("default below min", "type=\"float32\" min=\"1\" default=\"@@0.5\"", "below min");
    row("default above max", "type=\"uint8\" max=\"9\" default=\"@@10\"", "above max");
    row("default of a bool", "type=\"bool\" default=\"@@1\"", "true or false");
    row("default of an enum", "type=\"Mode\" default=\"@@onn\"", "did you mean 'on'?");
    row("default of a string", "type=\"string\" max-length=\"3\" @@default=\"abc\"", "start empty");
    row("default of a sequence", "type=\"uint8[]\" max-count=\"3\" @@default=\"1\"", "start empty");
    row("nonfinite integer", "type=\"int8\" @@nonfinite=\"true\"", "only float32 and float64");
    row("nonfinite perhaps", "type=\"float32\" nonfinite=\"@@yes\"", "true or false");
    row("misspelt attribute", "type=\"bool\" @@titel=\"x\"", "did you mean 'title'?");
    whole("element in a field", "<field name=\"f\" type=\"bool\">@@<unit/></field>", "'unit'");
}

void FieldReaderTest::refusesWrongFields() { refusesMarkedSet(); }

void FieldReaderTest::readsTypesAndShapes()
{
    const auto sequence = onlyField("<field name=\"f\" type=\"Mode[]\" max-count=\"7\" unit=\"1\" title=\"T &amp; t\"/>");
    QVERIFY(sequence.type == FieldType::UInt8);
    QCOMPARE(sequence.enumeration->name, std::string("Mode"));
    QVERIFY(sequence.shape == FieldShape::Sequence);
    QCOMPARE(sequence.count, 7U);
    QCOMPARE(sequence.title, std::string("T & t"));
    QCOMPARE(sequence.unit, std::string("1"));
    const auto array = onlyField("<field name=\"f\" type=\"float64[6]\"/>");
    QVERIFY(array.shape == FieldShape::FixedArray);
    QCOMPARE(array.maximumSize(), 48U);
    QVERIFY(!array.min && !array.max && !array.initial && !array.nonfinite && !array.enumeration);
    QVERIFY(onlyField("<field name=\"f\" type=\"float32\" nonfinite=\"true\"/>").nonfinite);
    QCOMPARE(onlyField("<field name=\"f\" type=\"string\" max-length=\"9\"/>").count, 9U);
}

void FieldReaderTest::readsBoundsInTheFieldsType()
{
    const auto small = onlyField("<field name=\"f\" type=\"int8\" min=\"-128\" max=\"127\"/>");
    QVERIFY(small.min == Number(std::int64_t{-128}));
    QVERIFY(small.max == Number(std::int64_t{127}));
    const auto large = onlyField("<field name=\"f\" type=\"uint64\" min=\"1\" max=\"18446744073709551615\"/>");
    QVERIFY(large.min == Number(std::uint64_t{1}));
    QVERIFY(large.max == Number(std::uint64_t{0xFFFFFFFFFFFFFFFFULL}));
    QVERIFY(onlyField("<field name=\"f\" type=\"float64\" min=\"-1.5e-3\"/>").min == Number(-1.5e-3));
}

void FieldReaderTest::roundsFloatBoundsToNearest()
{
    const auto single = onlyField("<field name=\"f\" type=\"float32\" max=\"0.1\"/>");
    QVERIFY(single.max == Number(static_cast<double>(0.1F)));
    QVERIFY(onlyField("<field name=\"f\" type=\"float64\" max=\"0.1\"/>").max == Number(0.1));
    QVERIFY(onlyField("<field name=\"f\" type=\"float32\" max=\"3.4028234663852886e38\"/>").max.has_value());
}

void FieldReaderTest::readsDefaults()
{
    QVERIFY(onlyField("<field name=\"f\" type=\"bool\" default=\"true\"/>").initial == Number(std::uint64_t{1}));
    QVERIFY(onlyField("<field name=\"f\" type=\"Mode\" default=\"on\"/>").initial == Number(std::uint64_t{1}));
    QVERIFY(onlyField("<field name=\"f\" type=\"int32\" default=\"-5\"/>").initial == Number(std::int64_t{-5}));
    QVERIFY(onlyField("<field name=\"f\" type=\"float32[3]\" default=\"0.25\"/>").initial == Number(0.25));
}

QTEST_APPLESS_MAIN(FieldReaderTest)
#include "field_reader_test.moc"
