// Verifying an audit file, line by line.
#include "liena/audit.hpp"

#include "audit/audit_file.hpp"
#include "liena/log.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace liena {

using namespace audit;

namespace {

constexpr std::size_t longestDamage = 64UL * 1024UL;

class Verifier {
public:
    explicit Verifier(const std::optional<Sha256>& expected) : m_expected(expected) {}

    /// False: there is a fault, and what follows does not matter.
    bool take(std::string_view line)
    {
        ++m_line;
        const auto parsed = parseLine(line);
        auto fault = parsed ? faultOf(*parsed) : std::string("is no audit entry");
        if (m_damage && (!fault.empty() || !isRecovery(*parsed)))
            return blame(m_damage->line, m_damage->fault);
        if (!fault.empty()) {
            m_damage = Damage{m_line, line.size(), Sha256::of(line), std::move(fault)};
            return true;
        }
        if (!m_damage && parsed->event == "recovered")
            return blame(m_line, "tells of an unfinished line before it, and that line is missing");
        if (parsed->event == "missing")
            return blame(m_line, "tells that entries had been cut off before it when the device started");
        accept(*parsed);
        return true;
    }

    bool finish(bool cutInTheMiddle)
    {
        if (m_damage && cutInTheMiddle)
            return blame(m_damage->line,
                         "is cut off in its middle: a crash, or somebody shortened the file. The next start of the device marks it");
        return m_damage ? blame(m_damage->line, m_damage->fault) : true;
    }

    /// What `.head` and the expected hash say about the end.
    void compare(const std::filesystem::path& file)
    {
        const auto head = readHead(file);
        if (!head)
            verdict.remarks.push_back(
                fmt::format("{} is not there: entries cut off at the end are noticed by a hash kept elsewhere only (--expect-head)",
                            headFileOf(file).string()));
        else if (head->entries > verdict.entries)
            blame(m_line + 1, fmt::format("is missing: {} entries had been written and {} are there; the end was cut off", head->entries,
                                          verdict.entries));
        else if (m_hashAtHead && *m_hashAtHead != head->hash)
            blame(m_lineAtHead, "is another entry than the one that had been written: the file was made anew");
        if (verdict.sound() && m_expected && !verdict.anchor)
            blame(m_line + 1,
                  "or an earlier one is missing: no entry has the expected hash. The end was cut off, or the file was made anew");
    }

    void lookForHead(std::uint64_t entries) { m_headEntries = entries; }

    AuditVerdict verdict;

private:
    struct Damage {
        std::uint64_t line = 0;
        std::size_t bytes = 0;
        Sha256 hash;
        std::string fault;
    };

    bool blame(std::uint64_t line, std::string what)
    {
        verdict.line = line;
        verdict.fault = std::move(what);
        return false;
    }

    /// Why a line that has the form of an entry does not follow what was before; empty when it does.
    std::string faultOf(const ParsedLine& line) const
    {
        const auto due = verdict.entries + 1;
        if (line.number == due + 1)
            return fmt::format("holds entry {}, but entry {} is missing before it", line.number, due);
        if (line.number > due)
            return fmt::format("holds entry {}, but entries {} to {} are missing before it", line.number, due, line.number - 1);
        if (line.number < due)
            return fmt::format("holds entry {} again, where entry {} belongs", line.number, due);
        if (line.hash != AuditChain::hashOf(verdict.head, line.body))
            return "was altered: its hash does not follow from it and from the lines before";
        return {};
    }

    bool isRecovery(const ParsedLine& line) const
    {
        return line.event == "recovered" && line.bytes == m_damage->bytes && line.damaged == m_damage->hash.toHex();
    }

    void accept(const ParsedLine& line)
    {
        if (m_damage)
            verdict.remarks.push_back(
                fmt::format("line {} was left unfinished by a crash; the device marked it when it started again", m_damage->line));
        m_damage.reset();
        verdict.entries = line.number;
        verdict.head = line.hash;
        if (m_expected == line.hash)
            verdict.anchor = line.number;
        if (m_headEntries == line.number)
            m_hashAtHead = line.hash, m_lineAtHead = m_line;
    }

    std::optional<Sha256> m_expected;
    std::uint64_t m_headEntries = 0;
    std::optional<Sha256> m_hashAtHead;
    std::uint64_t m_lineAtHead = 0;
    std::uint64_t m_line = 0;
    std::optional<Damage> m_damage; ///< a line that does not follow: the next one has to own up to it
};

} // namespace

Result<AuditVerdict> verifyAudit(const std::filesystem::path& file, const std::optional<Sha256>& expected)
{
    std::error_code ignored;
    const auto head = readHead(file); // before the file: a device may go on writing
    std::ifstream stream(file, std::ios::binary);
    if (!stream || !std::filesystem::is_regular_file(file, ignored))
        return fail(Errc::FileUnreadable, fmt::format("the audit file {} cannot be read: {}", file.string(), std::strerror(errno)));
    Verifier verifier(expected);
    if (head)
        verifier.lookForHead(head->entries);
    std::string line;
    bool sound = true;
    bool cut = false;
    for (int byte = stream.get(); sound && byte != std::char_traits<char>::eof(); byte = stream.get()) {
        if (byte == '\n') {
            sound = verifier.take(line);
            line.clear();
        } else if (line.size() < longestDamage) {
            line += static_cast<char>(byte);
        }
    }
    if (sound && !line.empty()) {
        cut = true;
        sound = verifier.take(line);
    }
    if (sound && verifier.finish(cut))
        verifier.compare(file);
    return verifier.verdict;
}

} // namespace liena
