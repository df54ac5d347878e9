// Any bytes as a message set: what is read keeps every promise of section 4 of the protocol.
#include "liena/message.hpp"
#include "protocol/information_part.hpp"
#include "xml_checks.hpp"

#include <set>

using namespace liena;
using namespace liena::fuzz;

namespace {

void checkMessage(const std::shared_ptr<const MessageSet>& set, const MessageDefinition& definition)
{
    const MessageId id{set->deviceType(), definition.number};
    expect(definition.role == Role::Command ? id.isCommand() : id.isReport(), "a number is in the range of its role");
    expect(definition.maximumSize() <= std::size_t{32} << 20U, "no message is over 32 MiB");
    if (definition.priority == Priority::Control)
        expect(definition.maximumSize() <= 32767, "a control message is one segment");
    if (definition.path == Path::Datagram)
        expect(definition.history == 1 && definition.maximumSize() <= 1200, "what goes by UDP fits a packet");
    std::set<std::string_view> names;
    for (const auto& field : definition.fields)
        expect(names.insert(field.name).second && field.name.size() <= 64, "names are unique and short");
    if (definition.maximumSize() > 1'000'000)
        return; // its default could be as large
    const Message message(set, definition);
    const auto fault = protocol::checkFields(definition, message.fieldBytes());
    expect(!fault, fault ? fault->c_str() : "");
}

void checkSet(const std::shared_ptr<const MessageSet>& set, std::string_view xml)
{
    expect(set->xml() == xml && set->hash() == Sha256::of(xml), "a set's identity is its bytes");
    expect(set->deviceType().isValidDevice() && set->deviceType().index() == 0, "a set belongs to a type of device");
    std::set<std::string_view> names;
    std::uint16_t last = 0;
    for (const auto& definition : set->messages()) {
        expect(definition.number > last, "numbers are unique and in order");
        last = definition.number;
        expect(names.insert(definition.name).second, "names are unique");
        expect(set->find(definition.number) == &definition && set->find(definition.name) == &definition, "each message is found");
        checkMessage(set, definition);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view xml(reinterpret_cast<const char*>(data), size);
    Findings findings;
    const auto set = MessageSet::parse(xml, "set.xml", &findings);
    checkFindings(findings, set.has_value(), xml);
    if (set)
        checkSet(set.value(), xml);
    return 0;
}
