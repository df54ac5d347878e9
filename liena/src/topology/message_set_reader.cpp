// Reads message sets: the root, then the enumerations, then the messages that use them.
#include "topology/message_set_reader.hpp"

#include "protocol/wire_layout.hpp"
#include "topology/file_bytes.hpp"
#include "topology/message_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace liena {

std::shared_ptr<const MessageSet> MessageSetReader::read(const XmlDocument& document, std::string_view xml)
{
    const auto root = document.root(messageSetElement, messageSetNamespace);
    if (!root)
        return nullptr;
    MessageSetReader reader(*root);
    reader.readRoot();
    reader.readEnums();
    reader.readMessages();
    if (root->findings().hasErrors())
        return nullptr;
    for (auto& message : reader.m_set->m_messages)
        message.layout = CompiledLayout(std::make_shared<const protocol::WireLayout>(message));
    reader.m_set->m_xml = xml;
    reader.m_set->m_hash = Sha256::of(xml);
    return reader.m_set;
}

void MessageSetReader::readRoot()
{
    constexpr std::int64_t lastManufacturer = 0x3FFF;
    constexpr std::int64_t lastOfSixBits = 0x3F;
    m_root.expectAttributes({"xmlns", "name", "version", "class", "manufacturer", "type", "device-version", "vendor", "title"});
    m_children = m_root.children({"description", "enum", "message"});
    m_set->m_description = descriptionAmong(m_children);
    m_set->m_name = nameFrom(m_root.require("name")).value_or("");
    m_set->m_version = filledTextFrom(m_root.require("version"));
    m_set->m_vendor = textFrom(m_root.find("vendor"));
    m_set->m_title = textFrom(m_root.find("title"));
    const auto deviceClass = choiceFrom<DeviceClass>(m_root.require("class"), {{"hand", DeviceClass::Hand},
                                                                               {"eye", DeviceClass::Eye},
                                                                               {"brain", DeviceClass::Brain},
                                                                               {"arm", DeviceClass::Arm},
                                                                               {"special", DeviceClass::Special}});
    const auto manufacturer = integerFrom(m_root.require("manufacturer"), 0, lastManufacturer);
    const auto type = integerFrom(m_root.require("type"), 0, lastOfSixBits);
    const auto version = integerFrom(m_root.require("device-version"), 0, lastOfSixBits);
    if (deviceClass && manufacturer && type && version)
        m_set->m_deviceType = DeviceId::compose(*deviceClass, static_cast<std::uint32_t>(*manufacturer), static_cast<std::uint32_t>(*type),
                                                static_cast<std::uint32_t>(*version), 0);
}

void MessageSetReader::readEnums()
{
    Once<std::string> names;
    for (const auto& child : m_children) {
        if (child.name() != "enum")
            continue;
        const auto definition = readEnum(child);
        if (definition->name.empty())
            continue;
        const auto name = *child.find("name");
        if (fieldTypeFrom(definition->name)) {
            name.reject(inQuotes(definition->name) + " is a type of the protocol", "give the enum another name");
            continue;
        }
        if (!names.take(definition->name, name, "the enum name '" + definition->name + "'"))
            continue;
        m_enums.emplace(definition->name, definition->values.empty() ? nullptr : definition);
        m_set->m_enums.push_back(definition);
    }
}

void MessageSetReader::readMessages()
{
    Once<std::string> names;
    Once<std::uint16_t> numbers;
    auto& messages = m_set->m_messages;
    for (const auto& child : m_children) {
        if (child.name() != "message")
            continue;
        auto message = readMessage(child, m_enums);
        if (!message.name.empty())
            names.take(message.name, *child.find("name"), "the message name '" + message.name + "'");
        if (message.number != 0)
            numbers.take(message.number, *child.find("number"), fmt::format("the message number 0x{:04x}", message.number));
        messages.push_back(std::move(message));
    }
    std::stable_sort(messages.begin(), messages.end(),
                     [](const MessageDefinition& a, const MessageDefinition& b) { return a.number < b.number; });
}

Result<std::shared_ptr<const MessageSet>> MessageSet::parse(std::string_view xml, const std::string& file, Findings* findings)
{
    FindingList list(file, xml);
    const auto document = XmlDocument::read(xml, list);
    const auto set = document ? MessageSetReader::read(*document, xml) : nullptr;
    if (findings) {
        const auto sorted = list.sorted();
        findings->insert(findings->end(), sorted.begin(), sorted.end());
    }
    if (!set)
        return list.summary(document ? Errc::MessageSetInvalid : Errc::XmlInvalid);
    return set;
}

Result<std::shared_ptr<const MessageSet>> MessageSet::load(const std::filesystem::path& file, Findings* findings)
{
    const auto bytes = readFile(file, XmlLimits::bytes);
    if (bytes)
        return parse(bytes.value(), file.string(), findings);
    if (findings)
        findings->push_back({Severity::Error, file.string(), 0, 0, bytes.error().what, {}});
    return bytes.as_failure();
}

} // namespace liena
