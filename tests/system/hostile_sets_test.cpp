// Message sets from a hostile peer: bombs, lies and names that are paths. None is taken, none leaves a trace.
#include "hostile_stage.hpp"

#include <QTest>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

struct Show {
    const char* name;
    std::string announced; ///< whose hash is told
    std::string sent;      ///< empty: the same
    std::uint8_t reason = wire::reason::messageSetInvalid;
};

std::string repeated(std::string_view text, std::size_t times)
{
    std::string all;
    for (std::size_t i = 0; i < times; ++i)
        all += text;
    return all;
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const auto at = text.find(from);
    if (at == std::string::npos)
        throw std::logic_error("the set does not have " + from);
    return text.replace(at, from.size(), to);
}

std::string billionLaughs(const std::string& good)
{
    std::string type = "<!DOCTYPE message-set [<!ENTITY a \"ha\">";
    for (char c = 'b'; c <= 'j'; ++c)
        type += std::string("<!ENTITY ") + c + " \"" + repeated(std::string("&") + static_cast<char>(c - 1) + ";", 10) + "\">";
    return replaced(replaced(good, "<message-set", type + "]>\n<message-set"), "Siemens", "&j;");
}

std::vector<Show> shows(const std::filesystem::path& registry)
{
    const auto good = wire::fileText(registry / "cbct-xray.xml");
    const auto before = [&](const std::string& text) { return replaced(good, "</message-set>", text + "</message-set>"); };
    const auto named = [&](const std::string& name) { return replaced(good, "name=\"cbct-xray\"", "name=\"" + name + "\""); };
    std::string utf16 = "\xff\xfe";
    for (const char c : good)
        utf16 += {c, '\0'};
    return {
        {"billion laughs", billionLaughs(good), {}},
        {"a document type alone", replaced(good, "<message-set", "<!DOCTYPE message-set>\n<message-set"), {}},
        {"an entity from a file", replaced(good, "<message-set", "<!DOCTYPE message-set SYSTEM \"file:///etc/passwd\">\n<message-set"), {}},
        {"a processing instruction", replaced(good, "<message-set", "<?php evil ?>\n<message-set"), {}},
        {"an include", before("<include href=\"/etc/passwd\"/>"), {}},
        {"nine levels", before(repeated("<message>", 8) + repeated("</message>", 8)), {}},
        {"ten thousand levels", before(repeated("<a>", 10000) + repeated("</a>", 10000)), {}},
        {"20 001 elements", before(repeated("<x/>", 20001)), {}},
        {"17 attributes",
         before([] {
             std::string element = "<message";
             for (int i = 0; i < 17; ++i)
                 element += " a" + std::to_string(i) + "=\"1\"";
             return element + "/>";
         }()),
         {}},
        {"an attribute twice", replaced(good, "vendor=\"Siemens\"", "vendor=\"Siemens\" vendor=\"Siemens\""), {}},
        {"an unknown attribute", replaced(good, "vendor=\"Siemens\"", "vendor=\"Siemens\" run=\"rm\""), {}},
        {"cut off", good.substr(0, good.size() / 2), {}},
        {"nothing", " ", {}},
        {"bytes that are no text", replaced(good, "Siemens", "\xff\xc0\x80"), {}},
        {"a NUL", replaced(good, "Siemens", std::string(1, '\0')), {}},
        {"a byte order mark", "\xef\xbb\xbf" + good, {}},
        {"UTF-16", utf16, {}},
        {"another type of device", wire::fileText(registry / "vascular-robot.xml"), {}},
        {"another version of the type", replaced(good, "device-version=\"1\"", "device-version=\"2\""), {}},
        {"a name that is a path", named("../../etc/x"), {}},
        {"a name that is an absolute path", named("/tmp/x"), {}},
        {"a name with a NUL reference", named("x&#0;y"), {}},
        {"a name of 65 letters", named(std::string(65, 'a')), {}},
        {"a message name that is a path", replaced(good, "name=\"XrayFrame\"", "name=\"../XrayFrame\""), {}},
        {"a message larger than can be", replaced(good, "max-length=\"16777216\"", "max-length=\"4294967295\""), {}},
        {"other bytes than announced", good, good + "\n"},
        {"another good set than announced", good + "<!-- a -->\n", good},
    };
}

/// Every file below, except what the robot may write: its store, which is looked at by itself.
std::vector<std::string> filesBelow(const std::filesystem::path& folder)
{
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && entry.path().string().find("store-") == std::string::npos)
            files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
}

std::size_t filesIn(const std::filesystem::path& store, const std::string& ending)
{
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(store))
        count += entry.path().filename().string().ends_with(ending) ? 1 : 0;
    return count;
}

} // namespace

class HostileSetsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void takesNoneOfTheseSets()
    {
        HostileStage stage({.unknownSet = "cbct-xray"});
        const auto store = stage.system.folder() / "store-robot";
        const auto files = filesBelow(stage.system.folder());
        const auto memory = residentBytes();
        for (const auto& show : shows(stage.registry())) {
            stage.peer.showSet(show.announced, show.sent);
            const auto before = stage.robot.events(Kind::OpenFailed, stage.xrayId).size();
            const auto reason = stage.peer.refusalOfOpening();
            QVERIFY2(reason.has_value(), show.name);
            QVERIFY2(*reason == show.reason, (std::string(show.name) + ": " + std::to_string(*reason) + "\n" + stage.story()).c_str());
            QVERIFY2(eventually([&] { return stage.robot.events(Kind::OpenFailed, stage.xrayId).size() > before; }), show.name);
            QVERIFY2(filesIn(store, ".xml") == 0 && filesIn(store, "pins") == 0, show.name);
        }
        QCOMPARE(filesBelow(stage.system.folder()), files);
        QVERIFY(residentBytes() < memory + (std::size_t{256} << 20U));
        QVERIFY(!stage.robot.heard(Kind::Opened, stage.xrayId));
        const auto good = wire::fileText(stage.registry() / "cbct-xray.xml");
        stage.peer.showSet(good, {});
        stage.openPeer();
        QCOMPARE(filesIn(store, ".xml"), std::size_t{1});
        QCOMPARE(filesIn(store, "pins"), std::size_t{1});
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void aSetLongerThanAllowedIsAViolation()
    {
        HostileStage stage({.unknownSet = "cbct-xray"});
        const auto good = wire::fileText(stage.registry() / "cbct-xray.xml");
        stage.peer.showSet(good + "<!--" + std::string(300 * 1024, ' ') + "-->", {});
        QCOMPARE(stage.peer.refusalOfOpening().value_or(0), wire::reason::protocolViolation);
        QCOMPARE(filesIn(stage.system.folder() / "store-robot", ".xml"), std::size_t{0});
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// The first set that was met is kept: a later one is neither taken nor stored, however often it is shown.
    void aChangedSetIsNeitherTakenNorStored()
    {
        HostileStage stage({.unknownSet = "cbct-xray"});
        const auto good = wire::fileText(stage.registry() / "cbct-xray.xml");
        const auto store = stage.system.folder() / "store-robot";
        stage.openPeer();
        stage.peer.close();
        QVERIFY2(eventually([&] { return stage.robot.state(stage.xrayId) == SessionState::Closed; }), stage.story().c_str());
        for (int i = 0; i < 10; ++i) {
            stage.peer.showSet(good + "<!-- " + std::to_string(i) + " -->\n", {});
            QCOMPARE(stage.peer.refusalOfOpening().value_or(0), wire::reason::messageSetChanged);
        }
        QCOMPARE(filesIn(store, ".xml"), std::size_t{1});
        stage.peer.showSet(good, {});
        stage.openPeer();
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// A set that nobody asked for, in an opening that needs none.
    void anUnaskedSetIsAViolation()
    {
        HostileStage stage;
        const auto good = wire::fileText(stage.registry() / "cbct-xray.xml");
        stage.peer.habits.answers = false;
        stage.peer.begin(false);
        QVERIFY(stage.peer.waits([&] { return !stage.peer.heard(wire::number::handshakeCommit).empty(); }));
        const auto other = good + "<!-- other -->\n";
        auto head = stage.peer.header(wire::number::messageSet);
        const auto body = wire::messageSet(wire::hashOf(other), other);
        for (std::size_t at = 0; at < body.size(); at += 8192) {
            const auto end = std::min(body.size(), at + 8192);
            head.more = end < body.size();
            stage.peer.send(wire::datagram(
                head, wire::Bytes(body.begin() + static_cast<std::ptrdiff_t>(at), body.begin() + static_cast<std::ptrdiff_t>(end))));
        }
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::OpenFailed, stage.xrayId); }), stage.story().c_str());
        QCOMPARE(words(stage.robot.events(Kind::OpenFailed)[0].reason), words(RejectReason::ProtocolViolation));
        QCOMPARE(filesIn(stage.system.folder() / "store-robot", ".xml"), std::size_t{0});
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }
};

QTEST_GUILESS_MAIN(HostileSetsTest)
#include "hostile_sets_test.moc"
