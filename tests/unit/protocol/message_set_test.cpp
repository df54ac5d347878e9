// Sizes, names and look-ups of definitions, without any XML.
#include <QTest>

#include "liena/message_set.hpp"

using namespace liena;

class MessageSetTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void knowsNameAndSizeOfEachType_data();
    void knowsNameAndSizeOfEachType();
    void refusesUnknownTypeName();
    void computesFieldSizes_data();
    void computesFieldSizes();
    void addsSafetyRecordToControlOnly();
    void findsFieldsAndEnumValues();
};

void MessageSetTest::knowsNameAndSizeOfEachType_data()
{
    QTest::addColumn<int>("type");
    QTest::addColumn<QByteArray>("name");
    QTest::addColumn<int>("size");
    const auto row = [](FieldType type, const char* name, int size) {
        QTest::newRow(name) << static_cast<int>(type) << QByteArray(name) << size;
    };
    row(FieldType::Bool, "bool", 1);
    row(FieldType::Int8, "int8", 1);
    row(FieldType::Int16, "int16", 2);
    row(FieldType::Int32, "int32", 4);
    row(FieldType::Int64, "int64", 8);
    row(FieldType::UInt8, "uint8", 1);
    row(FieldType::UInt16, "uint16", 2);
    row(FieldType::UInt32, "uint32", 4);
    row(FieldType::UInt64, "uint64", 8);
    row(FieldType::Float32, "float32", 4);
    row(FieldType::Float64, "float64", 8);
    row(FieldType::String, "string", 0);
    row(FieldType::Bytes, "bytes", 0);
}

void MessageSetTest::knowsNameAndSizeOfEachType()
{
    QFETCH(int, type);
    QFETCH(QByteArray, name);
    QFETCH(int, size);
    const auto value = static_cast<FieldType>(type);
    QCOMPARE(std::string(toString(value)), name.toStdString());
    QVERIFY(fieldTypeFrom(name.toStdString()) == value);
    QCOMPARE(sizeOf(value), static_cast<std::size_t>(size));
}

void MessageSetTest::refusesUnknownTypeName()
{
    QVERIFY(!fieldTypeFrom("float"));
    QVERIFY(!fieldTypeFrom("Bool"));
    QVERIFY(!fieldTypeFrom(""));
}

void MessageSetTest::computesFieldSizes_data()
{
    QTest::addColumn<int>("type");
    QTest::addColumn<int>("shape");
    QTest::addColumn<uint>("count");
    QTest::addColumn<int>("least");
    QTest::addColumn<int>("most");
    const auto row = [](const char* name, FieldType type, FieldShape shape, uint count, int least, int most) {
        QTest::newRow(name) << static_cast<int>(type) << static_cast<int>(shape) << count << least << most;
    };
    row("scalar", FieldType::Float32, FieldShape::Scalar, 1, 4, 4);
    row("array", FieldType::Float64, FieldShape::FixedArray, 6, 48, 48);
    row("sequence", FieldType::UInt16, FieldShape::Sequence, 10, 4, 24);
    row("string", FieldType::String, FieldShape::Scalar, 128, 2, 130);
    row("bytes", FieldType::Bytes, FieldShape::Scalar, 1000, 4, 1004);
}

void MessageSetTest::computesFieldSizes()
{
    QFETCH(int, type);
    QFETCH(int, shape);
    QFETCH(uint, count);
    QFETCH(int, least);
    QFETCH(int, most);
    FieldDefinition field;
    field.type = static_cast<FieldType>(type);
    field.shape = static_cast<FieldShape>(shape);
    field.count = count;
    QCOMPARE(field.minimumSize(), static_cast<std::size_t>(least));
    QCOMPARE(field.maximumSize(), static_cast<std::size_t>(most));
}

void MessageSetTest::addsSafetyRecordToControlOnly()
{
    MessageDefinition message;
    FieldDefinition field;
    field.type = FieldType::UInt32;
    message.fields = {field, field};
    message.priority = Priority::Safety;
    QCOMPARE(message.maximumSize(), 8U);
    message.priority = Priority::Control;
    QCOMPARE(message.maximumSize(), 24U);
}

void MessageSetTest::findsFieldsAndEnumValues()
{
    MessageDefinition message;
    message.fields.resize(2);
    message.fields[1].name = "speed";
    QVERIFY(message.indexOf("speed") == std::size_t{1});
    QVERIFY(!message.indexOf("velocity"));
    EnumDefinition states;
    states.values = {{"Off", 0, ""}, {"On", -1, ""}};
    QCOMPARE(states.find(-1)->name, std::string("On"));
    QCOMPARE(states.find("Off")->number, 0);
    QVERIFY(!states.find(2));
    QVERIFY(!states.find("off"));
}

QTEST_APPLESS_MAIN(MessageSetTest)
#include "message_set_test.moc"
