// Verifies audit files and says which line is wrong.
#include "audit_command.hpp"

#include <liena/audit.hpp>
#include <liena/log.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>

namespace liena::tools {

namespace {

constexpr auto auditFooter =
    "An audit file has one JSON object per line. Each ends with a hash: SHA-256 over the hash of the line before (64 zeros before the\n"
    "first) and the line's own text up to and without ,\"hash\":\"... So the first line that was changed, removed, inserted or moved is\n"
    "found and named. FILE.head beside it keeps the number of entries and the newest hash, by which entries cut off at the end are\n"
    "noticed. Whoever can write both files can write a whole new history; that is noticed only by a hash that was kept elsewhere:\n"
    "devices log theirs when they stop (\"audit file ...: 57 entries, head ...\"), and `liena monitor` shows it. Keep it, and give it "
    "back:\n\n"
    "  liena audit verify /var/log/liena/robot.jsonl\n"
    "  liena audit verify robot.jsonl --expect-head 5f0c...9a     fails unless an entry has that hash\n\n"
    "A crash in the middle of a line leaves that line unfinished; the device marks it when it starts again, and that is no fault.\n"
    "Exit codes: 0 whole, 1 altered or unreadable, 2 wrong use of the command line.";

int verify(const std::string& file, const std::string& expected)
{
    std::optional<Sha256> hash;
    if (!expected.empty()) {
        hash = Sha256::fromHex(expected);
        if (!hash) {
            fmt::print(stderr, "liena audit: --expect-head {} is no hash; write its 64 lower-case hex digits\n", printable(expected));
            return 2;
        }
    }
    const auto verdict = verifyAudit(file, hash);
    if (!verdict) {
        fmt::print(stderr, "liena audit: {}\n", verdict.error().what);
        return 1;
    }
    const auto& found = verdict.value();
    for (const auto& remark : found.remarks)
        fmt::print("note: {}\n", remark);
    if (!found.sound()) {
        fmt::print("{}:{}: this line {}\n", file, found.line, found.fault);
        fmt::print("{} entries before it are whole, the last with hash {}\n", found.entries, found.head.toHex());
        return 1;
    }
    fmt::print("{}: whole, {} entries, head {}\n", file, found.entries, found.head.toHex());
    if (found.anchor)
        fmt::print("the expected hash is that of entry {}; {} entries follow it\n", *found.anchor, found.entries - *found.anchor);
    return 0;
}

} // namespace

void addAuditCommand(CLI::App& app, int& exitCode)
{
    auto* audit = app.add_subcommand("audit", "The tamper-evident record of what was done to a device's sessions");
    audit->require_subcommand(1);
    audit->footer("`liena audit verify --help` says what can be noticed, and what cannot.");
    auto* command = audit->add_subcommand("verify", "Say whether an audit file is whole, and name the first line that is wrong");
    command->footer(auditFooter);
    const auto file = std::make_shared<std::string>();
    const auto expected = std::make_shared<std::string>();
    command->add_option("FILE", *file, "The audit file; a device may be writing it")->required();
    command->add_option("--expect-head", *expected, "A hash that an entry must have: one that was kept outside of this computer");
    command->callback([file, expected, &exitCode] { exitCode = verify(*file, *expected); });
}

} // namespace liena::tools
