// Every file of tests/corpus/session is read as its comments say, and written again byte for byte.
#include "field_values.hpp"
#include "protocol/datagram_decoder.hpp"
#include "protocol/datagram_encoder.hpp"
#include "protocol/reassembler.hpp"
#include "support/corpus_file.hpp"

#include <QFile>
#include <QHash>
#include <QTest>

#include <set>

using namespace liena;
using namespace liena::protocol;
using namespace liena::test;

Q_DECLARE_METATYPE(liena::test::CorpusFile)

namespace {

constexpr auto folder = LIENA_SOURCE_DIR "/tests/corpus/session";

using Written = std::vector<std::pair<std::string, std::string>>;

/// What a file's bytes are: the headers of its segments, and the message that they carry.
struct Reading {
    std::vector<DatagramHeader> headers;
    std::vector<std::byte> part;
    bool whole = false;
    bool clean = true; ///< nothing before, between or behind
};

Reading read(const CorpusFile& file)
{
    Reading reading;
    PartialBudget budget;
    Reassembler reassembler(budget);
    DatagramDecoder decoder;
    std::copy(file.bytes.begin(), file.bytes.end(), decoder.writable().begin());
    decoder.commit(file.bytes.size());
    const auto judge = [](const DatagramHeader& header) {
        return maximumSessionBody(header.message.number) ? HeaderVerdict::Take : HeaderVerdict::Refuse;
    };
    const auto take = [&](const DatagramHeader& header, std::span<const std::byte> body) {
        reading.clean = reading.clean && !reading.whole;
        reading.headers.push_back(header);
        const auto outcome = reassembler.take(header, body, *maximumSessionBody(header.message.number));
        if (const auto* assembled = std::get_if<Reassembler::Assembled>(&outcome))
            reading.part.assign(assembled->bytes.begin(), assembled->bytes.end());
        else if (std::holds_alternative<Reassembler::Whole>(outcome))
            reading.part.assign(body.begin(), body.end());
        reading.whole = std::holds_alternative<Reassembler::Whole>(outcome) || std::holds_alternative<Reassembler::Assembled>(outcome);
        return !std::holds_alternative<Reassembler::Violation>(outcome);
    };
    const bool processed = decoder.process(judge, take);
    reading.clean = reading.clean && processed && decoder.buffered() == 0;
    return reading;
}

Written writtenOf(const DatagramHeader& header)
{
    const auto hex4 = QString::asprintf("0x%04x", header.message.number).toStdString();
    return {{"number", hex4},
            {"origin", header.message.origin.toString()},
            {"target", header.target.toString()},
            {"timestamp", std::to_string(header.timestamp.ns)},
            {"length", std::to_string(header.length) + (header.moreSegments ? " more segments follow" : " the last segment")}};
}

/// Takes the comments of the headers out of `fields`; false when one says something else than the bytes.
bool takeHeaders(Written& fields, const std::vector<DatagramHeader>& headers)
{
    for (const auto& header : headers)
        for (const auto& meant : writtenOf(header)) {
            const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.first == meant.first; });
            if (found == fields.end() || !found->second.starts_with(meant.second))
                return false;
            fields.erase(found);
        }
    return true;
}

} // namespace

class GoldenTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void hasAFileForEverySessionMessage();
    void isReadAsItsCommentsSay_data() { rows(); }
    void isReadAsItsCommentsSay();
    void namesTheFieldsAsTheProtocolPageDoes();
    void isWrittenAgainByteForByte_data() { rows(); }
    void isWrittenAgainByteForByte();

private:
    static void rows()
    {
        QTest::addColumn<CorpusFile>("file");
        for (const auto& file : readCorpus(folder))
            QTest::newRow(file.name.c_str()) << file;
    }
};

void GoldenTest::hasAFileForEverySessionMessage()
{
    std::set<std::size_t> kinds;
    std::size_t segmented = 0;
    for (const auto& file : readCorpus(folder)) {
        const auto reading = read(file);
        if (const auto message = decodeSessionMessage(reading.headers.front().message.number, reading.part))
            kinds.insert(message->index());
        segmented += reading.headers.size() > 1 ? 1 : 0;
    }
    QCOMPARE(kinds.size(), std::variant_size_v<SessionMessage>);
    QVERIFY(segmented >= 3);
}

void GoldenTest::isReadAsItsCommentsSay()
{
    QFETCH(CorpusFile, file);
    const auto reading = read(file);
    QVERIFY2(reading.clean && reading.whole, "the file is not exactly one message");
    auto fields = file.fields;
    QVERIFY2(takeHeaders(fields, reading.headers), "a comment of a header says something else than its bytes");
    auto message = decodeSessionMessage(reading.headers.front().message.number, reading.part);
    QVERIFY(message.has_value());
    QCOMPARE(std::string(nameOf(*message)), file.remark("message"));
    FieldComparison comparison(fields);
    std::visit([&](auto& m) { m.visit(comparison); }, *message);
    QVERIFY2(comparison.differences().empty(), comparison.differences().c_str());
}

void GoldenTest::namesTheFieldsAsTheProtocolPageDoes()
{
    QFile page(QStringLiteral(LIENA_SOURCE_DIR "/liena/PROTOCOL.md"));
    QVERIFY(page.open(QIODevice::ReadOnly));
    QHash<QString, QString> rowsByName;
    for (const auto& line : QString::fromUtf8(page.readAll()).split(QLatin1Char('\n')))
        if (const auto cells = line.split(QLatin1Char('|')); cells.size() > 4 && cells[1].startsWith(QLatin1String(" 0x00")))
            rowsByName[cells[2].trimmed()] = cells[3];
    for (const auto& file : readCorpus(folder)) {
        auto row = rowsByName.value(QString::fromStdString(file.remark("message")));
        if (const auto also = row.section(QStringLiteral("as "), 1).section(QLatin1Char(','), 0, 0); rowsByName.contains(also))
            row = rowsByName[also] + row;
        auto fields = file.fields;
        QVERIFY(takeHeaders(fields, read(file).headers));
        qsizetype at = 0;
        for (const auto& [name, value] : fields) {
            at = row.indexOf(QString::fromStdString(name) + QLatin1Char(' '), at);
            QVERIFY2(at >= 0, (file.name + ": " + name + " is no field of this place on the page").c_str());
        }
    }
}

void GoldenTest::isWrittenAgainByteForByte()
{
    QFETCH(CorpusFile, file);
    const auto reading = read(file);
    const auto message = decodeSessionMessage(reading.headers.front().message.number, reading.part);
    QVERIFY(message.has_value());
    const auto part = encodeSessionMessage(*message);
    EncodedMessage encoded{reading.headers.front(), FieldBytes(part.begin(), part.end())};
    DatagramEncoder encoder;
    std::vector<std::byte> written;
    for (const auto& header : reading.headers)
        encoder.appendSegment(encoded, header.length, written);
    QVERIFY2(written == file.bytes, hexOf(written).c_str());
}

QTEST_APPLESS_MAIN(GoldenTest)
#include "golden_test.moc"
