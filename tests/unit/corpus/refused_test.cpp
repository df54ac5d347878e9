// Every file of tests/corpus/refused is refused where and as it says, and for that reason: with the bytes that heal it, it is taken.
#include "receiver.hpp"
#include "support/corpus_file.hpp"
#include "support/hex.hpp"

#include <QTest>

#include <set>

using namespace liena::test;

Q_DECLARE_METATYPE(liena::test::CorpusFile)

namespace {

constexpr auto folder = LIENA_SOURCE_DIR "/tests/corpus/refused";

Verdict judged(const CorpusFile& file, std::span<const std::byte> bytes)
{
    const auto lane = file.remark("lane");
    Receiver receiver(lane.empty() ? std::uint8_t{0} : static_cast<std::uint8_t>(std::stoi(lane)), file.remark("state"));
    const auto where = file.remark("where");
    if (where == "attach")
        return receiver.asAttach(bytes);
    if (where == "handshake")
        return receiver.asHandshake(bytes);
    return where == "packet" ? receiver.asPacket(bytes) : receiver.onLane(bytes);
}

/// The file's bytes with what its remark `heals` puts in their place: `offset: bytes, offset: bytes`.
std::vector<std::byte> healed(const CorpusFile& file)
{
    auto bytes = file.bytes;
    for (const auto& patch : QString::fromStdString(file.remark("heals")).split(QLatin1Char(','))) {
        const auto at = patch.section(QLatin1Char(':'), 0, 0).toLongLong();
        const auto put = bytesOf(patch.section(QLatin1Char(':'), 1).toStdString());
        if (put.empty() || at + static_cast<qsizetype>(put.size()) > static_cast<qsizetype>(bytes.size()))
            throw std::runtime_error(file.name + ": the healing bytes lie outside the file");
        std::copy(put.begin(), put.end(), bytes.begin() + at);
    }
    return bytes;
}

} // namespace

class RefusedTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void saysWhatTheFormatAsks();
    void isRefusedAsItSays_data();
    void isRefusedAsItSays();
    void isTakenWhenHealed_data();
    void isTakenWhenHealed();
    void takesTheGoldenHeartbeat();
};

void RefusedTest::saysWhatTheFormatAsks()
{
    const std::set<std::string> known{"reason", "verdict", "where", "says", "heals", "lane", "state"};
    const auto files = readCorpus(folder);
    QVERIFY(files.size() >= 60);
    std::set<std::string> kinds;
    for (const auto& file : files) {
        for (const char* key : {"reason", "verdict", "where"})
            QVERIFY2(!file.remark(key).empty(), (file.name + " has no " + key).c_str());
        for (const auto& [key, value] : file.remarks)
            QVERIFY2(known.contains(key), (file.name + " has an unknown remark: " + key).c_str());
        kinds.insert(file.remark("verdict") + " at " + file.remark("where"));
    }
    for (const char* kind : {"violation at header", "dropped at header", "violation at segment", "malformed at body", "dropped at record",
                             "violation at state", "closed at attach", "closed at handshake", "dropped at packet", "violation at packet"})
        QVERIFY2(kinds.contains(kind), kind);
}

void RefusedTest::isRefusedAsItSays_data()
{
    QTest::addColumn<CorpusFile>("file");
    for (const auto& file : readCorpus(folder))
        QTest::newRow(file.name.c_str()) << file;
}

void RefusedTest::isRefusedAsItSays()
{
    QFETCH(CorpusFile, file);
    const auto verdict = judged(file, file.bytes);
    QCOMPARE(verdict.verdict + " at " + verdict.where, file.remark("verdict") + " at " + file.remark("where"));
    QVERIFY2(verdict.why.find(file.remark("says")) != std::string::npos, verdict.why.c_str());
}

void RefusedTest::isTakenWhenHealed_data()
{
    QTest::addColumn<CorpusFile>("file");
    for (const auto& file : readCorpus(folder))
        if (!file.remark("heals").empty())
            QTest::newRow(file.name.c_str()) << file;
}

void RefusedTest::isTakenWhenHealed()
{
    QFETCH(CorpusFile, file);
    const auto verdict = judged(file, healed(file));
    QVERIFY2(!verdict.isRefusal(), (verdict.verdict + " at " + verdict.where + ": " + verdict.why).c_str());
}

/// The receiver is not one that refuses everything.
void RefusedTest::takesTheGoldenHeartbeat()
{
    const auto golden = readCorpusFile(std::filesystem::path(LIENA_SOURCE_DIR "/tests/corpus/session/Heartbeat-first.hex"));
    Receiver receiver(0, "Open");
    const auto verdict = receiver.onLane(golden.bytes);
    QVERIFY2(!verdict.isRefusal(), verdict.why.c_str());
}

QTEST_APPLESS_MAIN(RefusedTest)
#include "refused_test.moc"
