// The header's bytes, cutting messages into datagrams, and cutting a stream back into them.
#include "protocol/datagram.hpp"
#include "protocol/datagram_decoder.hpp"
#include "protocol/datagram_encoder.hpp"
#include "support/hex.hpp"

#include <QTest>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>

using namespace liena;
using namespace liena::protocol;
using namespace liena::test;

namespace {

const DatagramHeader plain{{DeviceId(0x40018208U), 0x0101}, DeviceId(0x00008208U), Timestamp{0x1122334455667788ULL}, 0x0102, false};

EncodedMessage messageOf(std::size_t size, std::uint16_t number = 0x0200)
{
    EncodedMessage message{{{DeviceId(0x20010208U), number}, DeviceId(0x40018208U), Timestamp{77}}, {}};
    for (std::size_t i = 0; i < size; ++i)
        message.part.push_back(static_cast<std::byte>(i * 31 + number));
    return message;
}

struct Seen {
    DatagramHeader header;
    std::vector<std::byte> body;
    friend bool operator==(const Seen&, const Seen&) = default;
};

/// Feeds `stream` in pieces of `chunk` bytes (or what fits); the verdict comes from the message number.
struct Feeder {
    DatagramDecoder decoder;
    std::vector<Seen> seen;
    std::vector<std::uint16_t> judged;
    std::uint16_t skip = 0;
    std::uint16_t refuse = 0;
    std::uint16_t stopAt = 0;

    bool process()
    {
        const auto judge = [this](const DatagramHeader& header) {
            judged.push_back(header.message.number);
            return header.message.number == refuse ? HeaderVerdict::Refuse
                   : header.message.number == skip ? HeaderVerdict::Skip
                                                   : HeaderVerdict::Take;
        };
        return decoder.process(judge, [this](const DatagramHeader& header, std::span<const std::byte> body) {
            seen.push_back({header, {body.begin(), body.end()}});
            return header.message.number != stopAt;
        });
    }

    bool feed(std::span<const std::byte> stream, std::size_t chunk)
    {
        while (!stream.empty()) {
            const auto room = decoder.writable();
            const auto count = std::min({chunk, stream.size(), room.size()});
            if (count == 0)
                return false;
            std::memcpy(room.data(), stream.data(), count);
            decoder.commit(count);
            stream = stream.subspan(count);
            if (!process())
                return false;
        }
        return true;
    }
};

std::vector<std::byte> streamOf(const std::vector<EncodedMessage>& messages, std::size_t maximum = maximumBody)
{
    std::vector<std::byte> stream;
    for (const auto& message : messages) {
        DatagramEncoder encoder;
        while (!encoder.appendSegment(message, maximum, stream)) {
        }
    }
    return stream;
}

} // namespace

class DatagramTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void writesTheHeaderAsThePageSays();
    void writesTheMoreSegmentsBit();
    void readsBackAnyTwentyBytes();
    void sendsSmallMessageAsOneDatagram();
    void sendsEmptyMessageAsOneDatagram();
    void cutsLongMessageIntoSegments_data();
    void cutsLongMessageIntoSegments();
    void lastSegmentIsNeverEmpty();
    void findsDatagramsHoweverTheStreamIsCut_data();
    void findsDatagramsHoweverTheStreamIsCut();
    void judgesTheHeaderBeforeTheBodyComes();
    void passesOverSkippedBodies();
    void endsAtRefusedHeader();
    void endsWhenTheTakerRefuses();
    void holdsTheLargestDatagram();
    void handsOnABodyInPiecesAsItComes();
    void piecesKeepTheirOrderBesideWholeBodies_data();
    void piecesKeepTheirOrderBesideWholeBodies();
    void bodiesInPiecesLandWhereTheyAreWanted_data();
    void bodiesInPiecesLandWhereTheyAreWanted();
};

void DatagramTest::writesTheHeaderAsThePageSays()
{
    QCOMPARE(QString::fromStdString(hexOf(encodeHeader(plain))),
             QStringLiteral("01 01 08 82 01 40 08 82 00 00 88 77 66 55 44 33 22 11 02 01"));
    QVERIFY(decodeHeader(encodeHeader(plain)) == plain);
}

void DatagramTest::writesTheMoreSegmentsBit()
{
    auto header = plain;
    header.moreSegments = true;
    header.length = 0x7FFF;
    const auto bytes = encodeHeader(header);
    QCOMPARE(QString::fromStdString(hexOf(std::span(bytes).last(2))), QStringLiteral("ff ff"));
    QVERIFY(decodeHeader(bytes) == header);
}

void DatagramTest::readsBackAnyTwentyBytes()
{
    for (unsigned value = 0; value < 256; ++value) {
        HeaderBytes bytes;
        bytes.fill(static_cast<std::byte>(value));
        bytes[3] = static_cast<std::byte>(value + 1);
        QVERIFY(encodeHeader(decodeHeader(bytes)) == bytes);
    }
}

void DatagramTest::sendsSmallMessageAsOneDatagram()
{
    const auto message = messageOf(5);
    std::vector<std::byte> out = bytesOf("ee");
    DatagramEncoder encoder;
    QVERIFY(!encoder.begun());
    QVERIFY(encoder.appendSegment(message, maximumBody, out));
    QCOMPARE(QString::fromStdString(hexOf(out)),
             QStringLiteral("ee 00 02 08 02 01 20 08 82 01 40 4d 00 00 00 00 00 00 00 05 00 00 1f 3e 5d 7c"));
}

void DatagramTest::sendsEmptyMessageAsOneDatagram()
{
    std::vector<std::byte> out;
    QVERIFY(DatagramEncoder().appendSegment(messageOf(0), maximumBody, out));
    QCOMPARE(out.size(), headerSize);
    QCOMPARE(hexOf(std::span(out).last(2)), std::string("00 00"));
}

void DatagramTest::cutsLongMessageIntoSegments_data()
{
    QTest::addColumn<int>("size");
    QTest::addColumn<int>("maximum");
    QTest::addColumn<int>("segments");
    QTest::newRow("exactly one") << 100 << 100 << 1;
    QTest::newRow("one byte more") << 101 << 100 << 2;
    QTest::newRow("exactly two") << 200 << 100 << 2;
    QTest::newRow("byte by byte") << 7 << 1 << 7;
    QTest::newRow("largest bodies") << 3 * 32767 << 32767 << 3;
}

void DatagramTest::cutsLongMessageIntoSegments()
{
    QFETCH(int, size);
    QFETCH(int, maximum);
    QFETCH(int, segments);
    const auto message = messageOf(static_cast<std::size_t>(size));
    const auto stream = streamOf({message}, static_cast<std::size_t>(maximum));
    QCOMPARE(stream.size(), static_cast<std::size_t>(size) + static_cast<std::size_t>(segments) * headerSize);
    Feeder feeder;
    QVERIFY(feeder.feed(stream, stream.size()));
    QCOMPARE(feeder.seen.size(), static_cast<std::size_t>(segments));
    std::vector<std::byte> whole;
    for (std::size_t i = 0; i < feeder.seen.size(); ++i) {
        const auto& [header, body] = feeder.seen[i];
        QCOMPARE(header.moreSegments, i + 1 < feeder.seen.size());
        QVERIFY(header.message == message.header.message && header.target == message.header.target);
        QVERIFY(header.timestamp == message.header.timestamp);
        whole.insert(whole.end(), body.begin(), body.end());
    }
    QVERIFY(std::equal(whole.begin(), whole.end(), message.part.begin(), message.part.end()));
}

void DatagramTest::lastSegmentIsNeverEmpty()
{
    for (std::size_t size = 1; size <= 64; ++size) {
        Feeder feeder;
        QVERIFY(feeder.feed(streamOf({messageOf(size)}, 16), 4096));
        QVERIFY(std::none_of(feeder.seen.begin(), feeder.seen.end(), [](const Seen& seen) { return seen.body.empty(); }));
    }
}

void DatagramTest::findsDatagramsHoweverTheStreamIsCut_data()
{
    QTest::addColumn<int>("chunk");
    for (int chunk = 1; chunk <= 120; ++chunk)
        QTest::addRow("%d bytes", chunk) << chunk;
    QTest::addRow("all at once") << (1 << 20);
}

void DatagramTest::findsDatagramsHoweverTheStreamIsCut()
{
    QFETCH(int, chunk);
    const std::vector messages{messageOf(0, 1), messageOf(1, 2), messageOf(19, 3), messageOf(20, 4), messageOf(21, 5), messageOf(0, 6)};
    Feeder feeder;
    QVERIFY(feeder.feed(streamOf(messages), static_cast<std::size_t>(chunk)));
    QCOMPARE(feeder.seen.size(), messages.size());
    QCOMPARE(feeder.judged.size(), messages.size());
    for (std::size_t i = 0; i < messages.size(); ++i) {
        QCOMPARE(feeder.seen[i].header.message.number, messages[i].header.message.number);
        QVERIFY(std::equal(feeder.seen[i].body.begin(), feeder.seen[i].body.end(), messages[i].part.begin(), messages[i].part.end()));
    }
    QCOMPARE(feeder.decoder.buffered(), std::size_t{0});
}

void DatagramTest::judgesTheHeaderBeforeTheBodyComes()
{
    const auto stream = streamOf({messageOf(100, 9)});
    Feeder feeder;
    QVERIFY(feeder.feed(std::span(stream).first(headerSize - 1), 64));
    QVERIFY(feeder.judged.empty());
    QVERIFY(feeder.feed(std::span(stream).subspan(headerSize - 1, 1), 64));
    QCOMPARE(feeder.judged.size(), std::size_t{1});
    QVERIFY(feeder.feed(std::span(stream).subspan(headerSize), 7));
    QCOMPARE(feeder.judged.size(), std::size_t{1});
    QCOMPARE(feeder.seen.size(), std::size_t{1});
}

void DatagramTest::passesOverSkippedBodies()
{
    Feeder feeder;
    feeder.skip = 2;
    QVERIFY(feeder.feed(streamOf({messageOf(3, 1), messageOf(300, 2), messageOf(4, 3)}), 11));
    QCOMPARE(feeder.seen.size(), std::size_t{2});
    QCOMPARE(feeder.seen[1].header.message.number, std::uint16_t{3});
}

void DatagramTest::endsAtRefusedHeader()
{
    Feeder feeder;
    feeder.refuse = 2;
    const auto stream = streamOf({messageOf(3, 1), messageOf(300, 2), messageOf(4, 3)});
    QVERIFY(!feeder.feed(stream, stream.size()));
    QCOMPARE(feeder.seen.size(), std::size_t{1});
    QCOMPARE(feeder.judged.size(), std::size_t{2});
}

void DatagramTest::endsWhenTheTakerRefuses()
{
    Feeder feeder;
    feeder.stopAt = 1;
    const auto stream = streamOf({messageOf(3, 1), messageOf(3, 2)});
    QVERIFY(!feeder.feed(stream, stream.size()));
    QCOMPARE(feeder.seen.size(), std::size_t{1});
}

void DatagramTest::holdsTheLargestDatagram()
{
    Feeder feeder;
    const std::vector messages{messageOf(1, 1), messageOf(maximumBody, 2), messageOf(maximumBody, 3), messageOf(maximumBody, 4)};
    QVERIFY(feeder.feed(streamOf(messages), 10007));
    QCOMPARE(feeder.seen.size(), messages.size());
    QVERIFY(std::equal(feeder.seen[3].body.begin(), feeder.seen[3].body.end(), messages[3].part.begin(), messages[3].part.end()));
}

void DatagramTest::handsOnABodyInPiecesAsItComes()
{
    const auto stream = streamOf({messageOf(1000)});
    DatagramDecoder decoder;
    std::vector<std::size_t> pieces;
    bool ended = false;
    std::size_t at = 0;
    for (const std::size_t count : {std::size_t{20}, std::size_t{300}, std::size_t{1}, std::size_t{699}}) {
        std::memcpy(decoder.writable().data(), stream.data() + at, count);
        decoder.commit(count);
        at += count;
        QVERIFY(decoder.process([](const DatagramHeader&) { return HeaderVerdict::TakeInPieces; },
                                [](const DatagramHeader&, std::span<const std::byte>) { return false; },
                                [&](const DatagramHeader&, std::span<const std::byte> bytes, bool last) {
                                    pieces.push_back(bytes.size());
                                    ended = last;
                                    return true;
                                }));
        QCOMPARE(decoder.buffered(), std::size_t{0}); // nothing waits here
        QCOMPARE(ended, at == stream.size());
    }
    QVERIFY((pieces == std::vector<std::size_t>{300, 1, 699}));
}

void DatagramTest::piecesKeepTheirOrderBesideWholeBodies_data()
{
    QTest::addColumn<quint64>("chunk");
    for (const quint64 chunk : {1, 7, 20, 21, 1000, 65536})
        QTest::addRow("%llu", static_cast<unsigned long long>(chunk)) << chunk;
}

void DatagramTest::piecesKeepTheirOrderBesideWholeBodies()
{
    QFETCH(quint64, chunk);
    const std::vector messages{messageOf(70000, 0x0200), messageOf(30, 0x0201), messageOf(0, 0x0200), messageOf(5000, 0x0202),
                               messageOf(33, 0x0200)};
    const auto stream = streamOf(messages, 16384);
    DatagramDecoder decoder;
    std::map<std::uint16_t, std::vector<std::byte>> bytes;
    std::map<std::uint16_t, std::vector<std::byte>> wanted;
    for (const auto& message : messages)
        if (message.header.message.number != 0x0202)
            wanted[message.header.message.number].insert(wanted[message.header.message.number].end(), message.part.begin(),
                                                         message.part.end());
    int ends = 0;
    for (std::span<const std::byte> left = stream; !left.empty();) {
        const auto count = std::min({static_cast<std::size_t>(chunk), left.size(), decoder.writable().size()});
        std::memcpy(decoder.writable().data(), left.data(), count);
        decoder.commit(count);
        left = left.subspan(count);
        QVERIFY(decoder.process(
            [](const DatagramHeader& header) {
                return header.message.number == 0x0200   ? HeaderVerdict::TakeInPieces
                       : header.message.number == 0x0202 ? HeaderVerdict::Skip
                                                         : HeaderVerdict::Take;
            },
            [&](const DatagramHeader& header, std::span<const std::byte> body) {
                bytes[header.message.number].insert(bytes[header.message.number].end(), body.begin(), body.end());
                return true;
            },
            [&](const DatagramHeader& header, std::span<const std::byte> piece, bool last) {
                bytes[header.message.number].insert(bytes[header.message.number].end(), piece.begin(), piece.end());
                ends += last ? 1 : 0;
                return true;
            }));
    }
    QVERIFY(bytes == wanted);
    QCOMPARE(ends, 5 + 1 + 1); // segments of 0x0200
}

void DatagramTest::bodiesInPiecesLandWhereTheyAreWanted_data()
{
    QTest::addColumn<quint64>("chunk");
    QTest::addColumn<bool>("all");
    for (const bool all : {false, true})
        for (const quint64 chunk : {1, 7, 20, 21, 1000, 65536})
            QTest::addRow("%llu, %s", static_cast<unsigned long long>(chunk), all ? "and what follows" : "and a header") << chunk << all;
}

/// As a connection reads: what is awaited of a body goes past the decoder's buffer, and then come one header or all that fits with it.
void DatagramTest::bodiesInPiecesLandWhereTheyAreWanted()
{
    using ReadAhead = DatagramDecoder::ReadAhead;
    QFETCH(quint64, chunk);
    QFETCH(bool, all);
    const std::vector messages{messageOf(40000, 0x0200), messageOf(30, 0x0201), messageOf(5000, 0x0200), messageOf(20, 0x0200)};
    const auto stream = streamOf(messages, 16384);
    DatagramDecoder decoder;
    std::map<std::uint16_t, std::vector<std::byte>> bytes;
    std::map<std::uint16_t, std::vector<std::byte>> wanted;
    for (const auto& message : messages)
        wanted[message.header.message.number].insert(wanted[message.header.message.number].end(), message.part.begin(), message.part.end());
    std::size_t landed = 0;
    const auto place = std::make_shared<std::vector<std::byte>>(maximumBody);
    for (std::span<const std::byte> left = stream; !left.empty();) {
        if (decoder.awaited() > 0)
            decoder.landIn(std::span(*place).first(decoder.awaited()), place);
        const auto room = decoder.room(all ? ReadAhead::All : ReadAhead::Header);
        QVERIFY(room.landing.empty() || all == (room.buffer.size() > headerSize));
        const auto count = std::min({static_cast<std::size_t>(chunk), left.size(), room.landing.size() + room.buffer.size()});
        const auto first = std::min(count, room.landing.size());
        std::copy_n(left.begin(), first, room.landing.begin());
        std::copy_n(left.begin() + static_cast<std::ptrdiff_t>(first), count - first, room.buffer.begin());
        decoder.commit(count);
        left = left.subspan(count);
        QVERIFY(decoder.process(
            [](const DatagramHeader& header) {
                return header.message.number == 0x0200 ? HeaderVerdict::TakeInPieces : HeaderVerdict::Take;
            },
            [&](const DatagramHeader& header, std::span<const std::byte> body) {
                bytes[header.message.number].insert(bytes[header.message.number].end(), body.begin(), body.end());
                return true;
            },
            [&](const DatagramHeader& header, std::span<const std::byte> piece, bool) {
                landed += piece.data() == place->data() ? piece.size() : 0;
                bytes[header.message.number].insert(bytes[header.message.number].end(), piece.begin(), piece.end());
                return true;
            }));
        QVERIFY(place.use_count() == 1); // what was read is handed on, and nothing keeps the place
    }
    QVERIFY(bytes == wanted);
    QVERIFY(chunk >= 16384 || landed > 40000); // with small steps, nearly all of it
}

QTEST_APPLESS_MAIN(DatagramTest)
#include "datagram_test.moc"
