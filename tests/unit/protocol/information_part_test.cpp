// Every type of section 3: what it looks like on the wire, and what of it is malformed.
#include "protocol/information_part.hpp"
#include "support/hex.hpp"

#include <QTest>

#include <cmath>
#include <limits>
#include <memory>

using namespace liena;
using namespace liena::protocol;
using namespace liena::test;

namespace {

FieldDefinition field(FieldType type, FieldShape shape = FieldShape::Scalar, std::uint32_t count = 1)
{
    FieldDefinition definition;
    definition.name = "value";
    definition.type = type;
    definition.shape = shape;
    definition.count = count;
    return definition;
}

FieldDefinition bounded(FieldDefinition definition, std::optional<Number> min, std::optional<Number> max)
{
    definition.min = min;
    definition.max = max;
    return definition;
}

FieldDefinition enumField(FieldType base, FieldShape shape = FieldShape::Scalar, std::uint32_t count = 1)
{
    auto definition = field(base, shape, count);
    EnumDefinition modes{"Mode", base, {{"off", 0, ""}, {"on", 1, ""}, {"special", 100, ""}}};
    if (base == FieldType::Int8)
        modes.values.push_back({"below", -2, ""});
    definition.enumeration = std::make_shared<EnumDefinition>(modes);
    return definition;
}

FieldDefinition nonfinite(FieldDefinition definition)
{
    definition.nonfinite = true;
    return definition;
}

MessageDefinition message(std::vector<FieldDefinition> fields, Priority priority = Priority::Status)
{
    MessageDefinition definition;
    definition.number = 0x0200;
    definition.name = "Sample";
    definition.priority = priority;
    definition.fields = std::move(fields);
    return definition;
}

QString faultOf(const FieldDefinition& definition, const std::vector<std::byte>& bytes)
{
    const auto sample = message({definition});
    const auto fault = checkFields(sample, bytes);
    if (WireLayout(sample).accepts(bytes) == fault.has_value())
        return QStringLiteral("the layout judges otherwise than the definition");
    return fault ? QString::fromStdString(*fault) : QString();
}

} // namespace

Q_DECLARE_METATYPE(liena::FieldDefinition)

class InformationPartTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void takesWhatTheDefinitionAllows_data();
    void takesWhatTheDefinitionAllows();
    void refusesWhatItDoesNot_data();
    void refusesWhatItDoesNot();
    void takesNoBodyOfAnotherLength_data();
    void takesNoBodyOfAnotherLength();
    void namesMessageFieldValueAndBounds();
    void comparesFloatBoundsInTheirOwnType();
    void boundsDoNotApplyToTextAndTruth();
    void doesNotTakeFieldOfOneMessageForAnother();
    void findsFieldsBehindVariableOnes();
    void writesNumbersThatFit_data();
    void writesNumbersThatFit();
    void readsNumbers_data();
    void readsNumbers();
    void knowsTheLargestSizes();
    void knowsUtf8_data();
    void knowsUtf8();
};

void InformationPartTest::takesWhatTheDefinitionAllows_data()
{
    QTest::addColumn<FieldDefinition>("definition");
    QTest::addColumn<QString>("hex");
    const auto row = [](const char* name, const FieldDefinition& definition, const char* hex) {
        QTest::newRow(name) << definition << QString::fromLatin1(hex);
    };
    row("false", field(FieldType::Bool), "00");
    row("true", field(FieldType::Bool), "01");
    row("int8", field(FieldType::Int8), "80");
    row("int16", field(FieldType::Int16), "00 80");
    row("int32", field(FieldType::Int32), "00 00 00 80");
    row("int64", field(FieldType::Int64), "00 00 00 00 00 00 00 80");
    row("uint8", field(FieldType::UInt8), "ff");
    row("uint16", field(FieldType::UInt16), "ff ff");
    row("uint32", field(FieldType::UInt32), "ff ff ff ff");
    row("uint64", field(FieldType::UInt64), "ff ff ff ff ff ff ff ff");
    row("float32 1.5", field(FieldType::Float32), "00 00 c0 3f");
    row("float64 1.5", field(FieldType::Float64), "00 00 00 00 00 00 f8 3f");
    row("NaN where allowed", nonfinite(field(FieldType::Float32)), "00 00 c0 7f");
    row("infinity where allowed", nonfinite(field(FieldType::Float64)), "00 00 00 00 00 00 f0 ff");
    row("NaN beside bounds, where allowed", nonfinite(bounded(field(FieldType::Float32), Number(-1.0), Number(1.0))), "00 00 c0 7f");
    row("enum", enumField(FieldType::UInt8), "64");
    row("enum of two bytes", enumField(FieldType::UInt16), "64 00");
    row("enum below zero", enumField(FieldType::Int8), "fe");
    row("empty string", field(FieldType::String, FieldShape::Scalar, 8), "00 00");
    row("string", field(FieldType::String, FieldShape::Scalar, 4), "04 00 68 c3 b6 21");
    row("empty bytes", field(FieldType::Bytes, FieldShape::Scalar, 8), "00 00 00 00");
    row("bytes", field(FieldType::Bytes, FieldShape::Scalar, 3), "03 00 00 00 ff 00 80");
    row("array", field(FieldType::Int16, FieldShape::FixedArray, 3), "01 00 02 00 ff ff");
    row("array of enums", enumField(FieldType::UInt8, FieldShape::FixedArray, 2), "00 64");
    row("array of truths", field(FieldType::Bool, FieldShape::FixedArray, 2), "00 01");
    row("empty sequence", field(FieldType::Float32, FieldShape::Sequence, 4), "00 00 00 00");
    row("sequence", field(FieldType::UInt16, FieldShape::Sequence, 2), "02 00 00 00 01 00 02 00");
    row("lower bound", bounded(field(FieldType::Int8), Number(std::int64_t{-5}), Number(std::int64_t{5})), "fb");
    row("upper bound", bounded(field(FieldType::UInt64), Number(std::uint64_t{0}), Number(std::numeric_limits<std::uint64_t>::max())),
        "ff ff ff ff ff ff ff ff");
}

void InformationPartTest::takesWhatTheDefinitionAllows()
{
    QFETCH(FieldDefinition, definition);
    QFETCH(QString, hex);
    QCOMPARE(faultOf(definition, bytesOf(hex.toStdString())), QString());
}

void InformationPartTest::refusesWhatItDoesNot_data()
{
    QTest::addColumn<FieldDefinition>("definition");
    QTest::addColumn<QString>("hex");
    const auto row = [](const char* name, const FieldDefinition& definition, const char* hex) {
        QTest::newRow(name) << definition << QString::fromLatin1(hex);
    };
    row("bool 2", field(FieldType::Bool), "02");
    row("bool 255", field(FieldType::Bool), "ff");
    row("bool 2 in an array", field(FieldType::Bool, FieldShape::FixedArray, 2), "01 02");
    row("NaN", field(FieldType::Float32), "00 00 c0 7f");
    row("signalling NaN", field(FieldType::Float32), "01 00 80 7f");
    row("infinity", field(FieldType::Float32), "00 00 80 7f");
    row("minus infinity", field(FieldType::Float64), "00 00 00 00 00 00 f0 ff");
    row("NaN in an array", field(FieldType::Float32, FieldShape::FixedArray, 2), "00 00 80 3f 00 00 c0 7f");
    row("NaN in a sequence", field(FieldType::Float64, FieldShape::Sequence, 2), "01 00 00 00 01 00 00 00 00 00 f8 7f");
    row("enum that is not declared", enumField(FieldType::UInt8), "02");
    row("enum that is not declared, beyond a byte", enumField(FieldType::UInt16), "64 01");
    row("enum below zero, of an unsigned base", enumField(FieldType::UInt8), "fe");
    row("enum in a sequence", enumField(FieldType::UInt8, FieldShape::Sequence, 4), "02 00 00 00 01 63");
    row("string too long", field(FieldType::String, FieldShape::Scalar, 3), "04 00 61 62 63 64");
    row("string that is no UTF-8", field(FieldType::String, FieldShape::Scalar, 3), "02 00 c3 28");
    row("string beyond the body", field(FieldType::String, FieldShape::Scalar, 100), "05 00 61 62");
    row("bytes too long", field(FieldType::Bytes, FieldShape::Scalar, 1), "02 00 00 00 01 02");
    row("bytes beyond the body", field(FieldType::Bytes, FieldShape::Scalar, 1U << 20U), "ff ff 0f 00 01 02");
    row("bytes of a size that wraps", field(FieldType::Bytes, FieldShape::Scalar, 8), "ff ff ff ff 01 02");
    row("sequence too long", field(FieldType::UInt8, FieldShape::Sequence, 1), "02 00 00 00 01 02");
    row("sequence beyond the body", field(FieldType::UInt64, FieldShape::Sequence, 64), "02 00 00 00 01 02");
    row("sequence of a size that wraps", field(FieldType::UInt64, FieldShape::Sequence, 0xFFFFFFFFU), "00 00 00 20");
    row("below the bound", bounded(field(FieldType::Int8), Number(std::int64_t{-5}), std::nullopt), "fa");
    row("above the bound", bounded(field(FieldType::UInt32), std::nullopt, Number(std::uint64_t{7})), "08 00 00 00");
    row("above a bound beyond int64", bounded(field(FieldType::UInt64), std::nullopt, Number(std::uint64_t{1} << 63U)),
        "01 00 00 00 00 00 00 80");
    row("above the bound in an array", bounded(field(FieldType::Float32, FieldShape::FixedArray, 2), Number(-1.0), Number(1.0)),
        "00 00 80 3f 00 00 c0 3f");
    row("below the bound in a sequence", bounded(field(FieldType::Float64, FieldShape::Sequence, 2), Number(0.0), std::nullopt),
        "01 00 00 00 00 00 00 00 00 00 f0 bf");
}

void InformationPartTest::refusesWhatItDoesNot()
{
    QFETCH(FieldDefinition, definition);
    QFETCH(QString, hex);
    QVERIFY(!faultOf(definition, bytesOf(hex.toStdString())).isEmpty());
}

void InformationPartTest::takesNoBodyOfAnotherLength_data() { takesWhatTheDefinitionAllows_data(); }

void InformationPartTest::takesNoBodyOfAnotherLength()
{
    QFETCH(FieldDefinition, definition);
    QFETCH(QString, hex);
    auto bytes = bytesOf(hex.toStdString());
    for (std::size_t length = 0; length < bytes.size(); ++length)
        QVERIFY(!faultOf(definition, {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)}).isEmpty());
    bytes.push_back(std::byte{0});
    QVERIFY(!faultOf(definition, bytes).isEmpty());
}

void InformationPartTest::namesMessageFieldValueAndBounds()
{
    const auto fault = faultOf(bounded(field(FieldType::Float32), Number(-40.0), Number(40.5)), bytesOf("00 00 28 42")); // 42
    for (const char* part : {"Sample", "value", "42", "-40", "40.5"})
        QVERIFY2(fault.contains(QString::fromLatin1(part)), qPrintable(fault));
}

void InformationPartTest::comparesFloatBoundsInTheirOwnType()
{
    // 0.1 as float32 is above 0.1 as float64; the bound itself must be accepted, its neighbours outside must not (ruling B12).
    const auto definition = bounded(field(FieldType::Float32), Number(-0.1), Number(0.1));
    const float bound = 0.1F;
    const auto bytes = [](float value) {
        const auto raw = std::as_bytes(std::span(&value, 1));
        return std::vector<std::byte>(raw.begin(), raw.end());
    };
    QCOMPARE(faultOf(definition, bytes(bound)), QString());
    QCOMPARE(faultOf(definition, bytes(-bound)), QString());
    QVERIFY(!faultOf(definition, bytes(std::nextafter(bound, 1.0F))).isEmpty());
    QVERIFY(!faultOf(definition, bytes(std::nextafter(-bound, -1.0F))).isEmpty());
}

void InformationPartTest::boundsDoNotApplyToTextAndTruth()
{
    const Number five(std::int64_t{5});
    QCOMPARE(faultOf(bounded(field(FieldType::Bool), five, five), bytesOf("01")), QString());
    QCOMPARE(faultOf(bounded(field(FieldType::String, FieldShape::Scalar, 4), five, five), bytesOf("01 00 61")), QString());
    QCOMPARE(faultOf(bounded(field(FieldType::Bytes, FieldShape::Scalar, 4), five, five), bytesOf("01 00 00 00 61")), QString());
    QCOMPARE(faultOf(bounded(enumField(FieldType::UInt8), five, five), bytesOf("01")), QString());
}

void InformationPartTest::doesNotTakeFieldOfOneMessageForAnother()
{
    const auto definition = message({field(FieldType::UInt8), field(FieldType::UInt16), field(FieldType::Bool)});
    QVERIFY(!checkFields(definition, bytesOf("ff ff ff 01")));
    QVERIFY(checkFields(definition, bytesOf("ff ff ff 02")));
    QVERIFY(!checkFields(message({}), {}));
    QVERIFY(checkFields(message({}), bytesOf("00")));
}

void InformationPartTest::findsFieldsBehindVariableOnes()
{
    const auto definition = message({field(FieldType::UInt16), field(FieldType::String, FieldShape::Scalar, 9),
                                     field(FieldType::UInt16, FieldShape::Sequence, 9), field(FieldType::Bytes, FieldShape::Scalar, 9),
                                     field(FieldType::Int8, FieldShape::FixedArray, 3), field(FieldType::Bool)});
    const auto bytes = bytesOf("01 02  02 00 61 62  01 00 00 00 03 04  01 00 00 00 ff  07 08 09  01");
    QVERIFY(!checkFields(definition, bytes));
    const std::vector<std::pair<std::size_t, std::size_t>> expected{{0, 2}, {2, 4}, {6, 6}, {12, 5}, {17, 3}, {20, 1}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto span = locateField(definition, bytes, i);
        QCOMPARE(span.begin, expected[i].first);
        QCOMPARE(span.size, expected[i].second);
        const auto compiled = WireLayout(definition).locate(bytes, i);
        QCOMPARE(compiled.begin, expected[i].first);
        QCOMPARE(compiled.size, expected[i].second);
    }
}

void InformationPartTest::writesNumbersThatFit_data()
{
    QTest::addColumn<int>("type");
    QTest::addColumn<double>("value");
    QTest::addColumn<QString>("hex");
    const auto row = [](FieldType type, double value, const char* hex) {
        QTest::addRow("%s %g", std::string(toString(type)).c_str(), value) << int(type) << value << QString::fromLatin1(hex);
    };
    row(FieldType::UInt8, 255, "ff");
    row(FieldType::UInt8, 256, "");
    row(FieldType::UInt8, -1, "");
    row(FieldType::Int8, -128, "80");
    row(FieldType::Int8, -129, "");
    row(FieldType::Int8, 128, "");
    row(FieldType::Int16, -2, "fe ff");
    row(FieldType::UInt16, 65536, "");
    row(FieldType::Int32, 2147483648.0, "");
    row(FieldType::UInt32, 4294967295.0, "ff ff ff ff");
    row(FieldType::UInt32, 4294967296.0, "");
    row(FieldType::Bool, 1, "01");
    row(FieldType::Int32, 1.5, "");
    row(FieldType::Float32, 1.5, "00 00 c0 3f");
    row(FieldType::Float32, -2, "00 00 00 c0");
    row(FieldType::Float64, 1.5, "00 00 00 00 00 00 f8 3f");
    row(FieldType::UInt64, 18446744073709551616.0, "");
    row(FieldType::Int64, 9223372036854775808.0, "");
    row(FieldType::UInt8, std::numeric_limits<double>::quiet_NaN(), "");
    row(FieldType::UInt8, std::numeric_limits<double>::infinity(), "");
}

void InformationPartTest::writesNumbersThatFit()
{
    QFETCH(int, type);
    QFETCH(double, value);
    QFETCH(QString, hex);
    const auto fieldType = static_cast<FieldType>(type);
    std::vector<std::byte> bytes(sizeOf(fieldType));
    QCOMPARE(writeNumber(fieldType, Number(value), bytes.data()), !hex.isEmpty());
    if (!hex.isEmpty())
        QCOMPARE(QString::fromStdString(hexOf(bytes)), hex);
    if (value == std::floor(value) && std::abs(value) < 1e15) { // the same number as an integer
        std::vector<std::byte> again(sizeOf(fieldType));
        QCOMPARE(writeNumber(fieldType, Number(static_cast<std::int64_t>(value)), again.data()), !hex.isEmpty());
        if (!hex.isEmpty())
            QVERIFY(again == bytes);
    }
}

void InformationPartTest::readsNumbers_data()
{
    QTest::addColumn<int>("type");
    QTest::addColumn<QString>("hex");
    QTest::addColumn<QString>("text");
    const auto row = [](FieldType type, const char* hex, const char* text) {
        QTest::newRow(std::string(toString(type)).c_str()) << int(type) << QString::fromLatin1(hex) << QString::fromLatin1(text);
    };
    row(FieldType::Int8, "fe", "-2");
    row(FieldType::Int16, "fe ff", "-2");
    row(FieldType::Int32, "fe ff ff ff", "-2");
    row(FieldType::Int64, "00 00 00 00 00 00 00 80", "-9223372036854775808");
    row(FieldType::UInt8, "fe", "254");
    row(FieldType::UInt16, "fe ff", "65534");
    row(FieldType::UInt32, "fe ff ff ff", "4294967294");
    row(FieldType::UInt64, "ff ff ff ff ff ff ff ff", "18446744073709551615");
    row(FieldType::Float32, "00 00 c0 3f", "1.5");
    row(FieldType::Float64, "00 00 00 00 00 00 f8 bf", "-1.5");
}

void InformationPartTest::readsNumbers()
{
    QFETCH(int, type);
    QFETCH(QString, hex);
    QFETCH(QString, text);
    const auto bytes = bytesOf(hex.toStdString());
    QCOMPARE(QString::fromStdString(liena::protocol::toString(readNumber(static_cast<FieldType>(type), bytes.data()))), text);
}

void InformationPartTest::knowsTheLargestSizes()
{
    const std::vector<FieldDefinition> fields{field(FieldType::UInt16),
                                              field(FieldType::String, FieldShape::Scalar, 9),
                                              field(FieldType::UInt16, FieldShape::Sequence, 9),
                                              field(FieldType::Bytes, FieldShape::Scalar, 9),
                                              field(FieldType::Int64, FieldShape::FixedArray, 3),
                                              enumField(FieldType::UInt32)};
    const std::vector<std::size_t> largest{2, 2 + 9, 4 + 2 * 9, 4 + 9, 24, 4};
    const std::vector<std::size_t> least{2, 2, 4, 4, 24, 4};
    for (std::size_t i = 0; i < fields.size(); ++i) {
        QCOMPARE(fields[i].maximumSize(), largest[i]);
        QCOMPARE(fields[i].minimumSize(), least[i]);
    }
    QCOMPARE(message(fields).maximumSize(), std::size_t{2 + 11 + 22 + 13 + 24 + 4});
    QCOMPARE(message(fields, Priority::Control).maximumSize(), std::size_t{2 + 11 + 22 + 13 + 24 + 4 + 16});
    QCOMPARE(message({}, Priority::Safety).maximumSize(), std::size_t{0});
}

void InformationPartTest::knowsUtf8_data()
{
    QTest::addColumn<QString>("hex");
    QTest::addColumn<bool>("valid");
    const auto row = [](const char* name, const char* hex, bool valid) { QTest::newRow(name) << QString::fromLatin1(hex) << valid; };
    row("empty", "", true);
    row("zero", "00", true);
    row("last of one byte", "7f", true);
    row("first of two", "c2 80", true);
    row("first of three", "e0 a0 80", true);
    row("before the surrogates", "ed 9f bf", true);
    row("after the surrogates", "ee 80 80", true);
    row("first of four", "f0 90 80 80", true);
    row("last of all", "f4 8f bf bf", true);
    row("continuation", "80", false);
    row("overlong of two", "c1 bf", false);
    row("overlong of three", "e0 9f bf", false);
    row("overlong of four", "f0 8f bf bf", false);
    row("first surrogate", "ed a0 80", false);
    row("last surrogate", "ed bf bf", false);
    row("beyond Unicode", "f4 90 80 80", false);
    row("five bytes", "f8 88 80 80 80", false);
    row("cut after one", "e2", false);
    row("cut after two", "f0 9f a4", false);
    row("interrupted", "e2 41 80", false);
    row("bad after good", "41 c3 b6 ff", false);
}

void InformationPartTest::knowsUtf8()
{
    QFETCH(QString, hex);
    QFETCH(bool, valid);
    const auto bytes = bytesOf(hex.toStdString());
    QCOMPARE(isUtf8({reinterpret_cast<const char*>(bytes.data()), bytes.size()}), valid);
}

QTEST_APPLESS_MAIN(InformationPartTest)
#include "information_part_test.moc"
