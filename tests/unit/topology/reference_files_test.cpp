// Every attribute of the reference files, as an independent parser sees it, held against what was read.
#include "marked_text.hpp"
#include "xml_oracle.hpp"

#include "liena/message_set.hpp"
#include "liena/system_topology.hpp"

#include <QDir>

using namespace liena;
using namespace liena::test;

namespace {

using Attributes = std::map<std::string, std::string>;

std::string hex(std::uint16_t number) { return QByteArray::number(number, 16).rightJustified(4, '0').prepend("0x").toStdString(); }

std::string duration(const std::optional<std::chrono::nanoseconds>& value)
{
    return value ? std::to_string(*value / std::chrono::milliseconds(1)) + "ms" : std::string();
}

/// As the file writes it: compared as doubles, because the file may write 0.1 where the field holds the nearest float.
bool sameNumber(const std::optional<Number>& number, const std::string& text, FieldType type)
{
    if (!number)
        return false;
    if (type == FieldType::Float32)
        return std::get<double>(*number) == static_cast<double>(QByteArray::fromStdString(text).toFloat());
    if (type == FieldType::Float64)
        return std::get<double>(*number) == QByteArray::fromStdString(text).toDouble();
    if (const auto* whole = std::get_if<std::uint64_t>(&*number))
        return std::to_string(*whole) == text;
    return std::to_string(std::get<std::int64_t>(*number)) == text;
}

std::string typeText(const FieldDefinition& field)
{
    auto text = field.enumeration ? field.enumeration->name : std::string(toString(field.type));
    if (field.shape == FieldShape::FixedArray)
        text += "[" + std::to_string(field.count) + "]";
    return field.shape == FieldShape::Sequence ? text + "[]" : text;
}

void put(Attributes& attributes, const char* name, const std::string& value)
{
    if (!value.empty())
        attributes[name] = value;
}

Attributes attributesOf(const MessageDefinition& message, const Attributes& written)
{
    Attributes result{{"number", hex(message.number)},
                      {"name", message.name},
                      {"role", std::string(toString(message.role))},
                      {"priority", std::string(toString(message.priority))}};
    put(result, "title", message.title);
    put(result, "period", duration(message.period));
    put(result, "deadline", duration(message.deadline));
    put(result, "lifespan", duration(message.lifespan));
    put(result, "max-age", duration(message.maxAge));
    if (message.history > 0)
        result["history"] = std::to_string(message.history);
    if (message.path == Path::Datagram)
        result["path"] = "datagram";
    if (written.contains("in-standby"))
        result["in-standby"] = message.allowedInStandBy ? "allow" : "refuse";
    return result;
}

void compareField(const FieldDefinition& field, Attributes written)
{
    const auto taken = [&written](const char* name) {
        const auto node = written.extract(name);
        return node.empty() ? std::string() : node.mapped();
    };
    QCOMPARE(field.name, taken("name"));
    QCOMPARE(typeText(field), taken("type"));
    QCOMPARE(field.unit, taken("unit"));
    QCOMPARE(field.title, taken("title"));
    const bool measured = field.type == FieldType::String || field.type == FieldType::Bytes;
    QCOMPARE(measured ? std::to_string(field.count) : std::string(), taken("max-length"));
    for (const auto& [name, number] : {std::pair("min", field.min), std::pair("max", field.max), std::pair("default", field.initial)}) {
        const auto text = taken(name);
        QVERIFY2(number ? sameNumber(number, text, field.type) : text.empty(), (field.name + " " + name).c_str());
    }
    QVERIFY2(written.empty(), "an attribute that this test does not know");
}

} // namespace

class ReferenceFilesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void readsEveryAttributeOfEachSet_data();
    void readsEveryAttributeOfEachSet();
    void readsTheMotionCommand();
    void readsEveryAttributeOfTheTopology();
    void readsTheLoopbackPair();
    void passesTheCheckTogether();

private:
    static void compareMessage(const MessageDefinition& message, const OracleNode& node);
    static void compareEnum(const EnumDefinition& definition, const OracleNode& node);
};

void ReferenceFilesTest::readsEveryAttributeOfEachSet_data()
{
    QTest::addColumn<QByteArray>("name");
    QTest::addColumn<QByteArray>("type");
    QTest::newRow("vascular-robot") << QByteArray("vascular-robot") << QByteArray("0x00008208");
    QTest::newRow("arm-grasper") << QByteArray("arm-grasper") << QByteArray("0x60008208");
    QTest::newRow("cbct-xray") << QByteArray("cbct-xray") << QByteArray("0x20010208");
    QTest::newRow("siat-cockpit") << QByteArray("siat-cockpit") << QByteArray("0x40018208");
}

void ReferenceFilesTest::readsEveryAttributeOfEachSet()
{
    QFETCH(QByteArray, name);
    QFETCH(QByteArray, type);
    const auto path = sourceFile("resources/devices/" + name.toStdString() + ".xml");
    const auto xml = bytesOf(path).toStdString();
    Findings findings;
    const auto result = MessageSet::load(path, &findings);
    QVERIFY2(result && findings.empty(), listed(findings).c_str());
    const auto& set = *result.value();
    const auto tree = treeOf(xml);
    QCOMPARE(set.deviceType().toString(), type.toStdString());
    QVERIFY(set.hash() == Sha256::of(xml));
    const auto id = set.deviceType();
    QVERIFY((tree.attributes == Attributes{{"name", set.name()},
                                           {"version", set.version()},
                                           {"class", std::string(toString(static_cast<DeviceClass>(id.classNumber())))},
                                           {"manufacturer", std::to_string(id.manufacturer())},
                                           {"type", std::to_string(id.type())},
                                           {"device-version", std::to_string(id.version())},
                                           {"vendor", set.vendor()},
                                           {"title", set.title()}}));
    QVERIFY(!set.description().empty());
    std::size_t enums = 0;
    std::size_t messages = 0;
    for (const auto& child : tree.children) {
        if (child.name == "enum")
            compareEnum(*set.enums().at(enums++), child);
        else if (child.name == "message")
            compareMessage(set.messages().at(messages++), child);
        if (QTest::currentTestFailed())
            return;
    }
    QCOMPARE(enums, set.enums().size());
    QCOMPARE(messages, set.messages().size());
    QVERIFY(messages > 0);
}

void ReferenceFilesTest::compareEnum(const EnumDefinition& definition, const OracleNode& node)
{
    QCOMPARE(definition.name, node.attributes.at("name"));
    QCOMPARE(std::string(toString(definition.base)), node.attributes.at("base"));
    QCOMPARE(definition.values.size(), node.children.size());
    for (std::size_t i = 0; i < node.children.size(); ++i) {
        const auto& value = definition.values[i];
        Attributes expected{{"name", value.name}, {"number", std::to_string(value.number)}};
        put(expected, "title", value.title);
        QVERIFY(expected == node.children[i].attributes);
    }
}

void ReferenceFilesTest::compareMessage(const MessageDefinition& message, const OracleNode& node)
{
    QVERIFY2(attributesOf(message, node.attributes) == node.attributes, message.name.c_str());
    QCOMPARE(message.fields.size(), node.children.size());
    for (std::size_t i = 0; i < message.fields.size(); ++i)
        compareField(message.fields[i], node.children[i].attributes);
}

void ReferenceFilesTest::readsTheMotionCommand()
{
    using namespace std::chrono_literals;
    const auto set = MessageSet::load(sourceFile("resources/devices/vascular-robot.xml")).value();
    const auto* message = set->find("MotionCommand");
    QVERIFY(message && message == set->find(0x0101));
    QVERIFY(message->role == Role::Command);
    QVERIFY(message->priority == Priority::Control);
    QVERIFY(!message->allowedInStandBy);
    QVERIFY(message->period == 2ms && message->deadline == 20ms && message->lifespan == 50ms && message->maxAge == 50ms);
    QCOMPARE(message->history, 1U);
    QVERIFY(message->path == Path::Datagram);
    QCOMPARE(message->maximumSize(), 16U + 4 + 4 + 1 + 4 * 4);
    const auto& velocity = message->fields.at(message->indexOf("guidewire_velocity").value());
    QVERIFY(velocity.type == FieldType::Float32);
    QVERIFY(velocity.min == Number(-40.0) && velocity.max == Number(40.0) && velocity.initial == Number(0.0));
    QVERIFY(set->find("EmergencyStop")->allowedInStandBy);
    QVERIFY(set->description().find("arrive under the permit") != std::string::npos);
}

void ReferenceFilesTest::readsEveryAttributeOfTheTopology()
{
    const auto path = sourceFile("topologies/cerebrovascular.xml");
    const auto topology = SystemTopology::load(path).value();
    const auto tree = treeOf(bytesOf(path).toStdString());
    QVERIFY((tree.attributes == Attributes{{"name", topology.name()}, {"version", topology.version()}, {"title", topology.title()}}));
    QVERIFY(topology.security() == SecurityMode::Tls);
    std::size_t devices = 0;
    std::size_t links = 0;
    for (const auto& child : tree.children) {
        if (child.name == "device") {
            const auto& device = topology.devices().at(devices++);
            QVERIFY((child.attributes == Attributes{{"name", device.name},
                                                    {"id", device.id.toString()},
                                                    {"message-set", device.messageSet},
                                                    {"host", device.host},
                                                    {"port", std::to_string(device.port)},
                                                    {"title", device.title},
                                                    {"site", device.site}}));
        } else if (child.name == "link") {
            const auto& link = topology.links().at(links++);
            const auto text = child.attributes.at("between");
            const auto space = text.find(' ');
            QVERIFY(link.joins(topology.find(text.substr(0, space))->id, topology.find(text.substr(space + 1))->id));
            QVERIFY(link.a < link.b);
            QVERIFY(link.timing == LinkTiming{});
        }
    }
    QCOMPARE(devices, 4U);
    QCOMPARE(links, 5U);
    QCOMPARE(topology.devices().size(), devices);
    QCOMPARE(topology.links().size(), links);
}

void ReferenceFilesTest::readsTheLoopbackPair()
{
    const auto topology = SystemTopology::load(sourceFile("topologies/loopback_pair.xml")).value();
    QCOMPARE(topology.devices().size(), 2U);
    QCOMPARE(topology.find("cockpit")->port, 52200);
    QCOMPARE(topology.find("robot")->port, 52210);
    QVERIFY(topology.security() == SecurityMode::Tls);
    QVERIFY(topology.link(topology.find("cockpit")->id, topology.find("robot")->id));
}

void ReferenceFilesTest::passesTheCheckTogether()
{
    std::vector<std::filesystem::path> files;
    for (const auto* folder : {"resources/devices", "topologies"})
        for (const auto& entry : QDir(QString::fromStdString(sourceFile(folder))).entryInfoList({QStringLiteral("*.xml")}, QDir::Files))
            files.emplace_back(entry.absoluteFilePath().toStdString());
    QVERIFY(files.size() >= 6);
    const auto findings = checkFiles(files);
    QVERIFY2(findings.empty(), listed(findings).c_str());
}

QTEST_APPLESS_MAIN(ReferenceFilesTest)
#include "reference_files_test.moc"
