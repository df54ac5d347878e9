// The short way to write and read probes says the same as the general one.
#include "protocol/probe_words.hpp"
#include "support/hex.hpp"

#include <QTest>

using namespace liena;
using namespace liena::protocol;
using namespace liena::test;

class ProbeWordsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void writesWhatTheGeneralWayWrites()
    {
        for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{64}, std::size_t{100'000}}) {
            const ProbeHead head{0x01020304, ProbeWay::Image, 77, 0x2122232425262728ULL};
            const auto padding = filled(size, 0x5A);
            auto bytes = encodeProbeHead(head, size);
            bytes.insert(bytes.end(), padding.begin(), padding.end());
            const auto general = encodeSessionMessage(Probe{head.run, head.way, head.sequence, head.sentNs, {padding}});
            QVERIFY(std::equal(bytes.begin(), bytes.end(), general.begin(), general.end()));
            QCOMPARE(bytes.size(), probeHeadSize + size);
            const auto read = decodeProbe(general);
            QVERIFY(read && *read == head);
        }
    }

    void refusesWhatTheGeneralWayRefuses()
    {
        const auto bytes = encodeSessionMessage(Probe{1, ProbeWay::Prompt, 2, 3, {filled(8, 0x5A)}});
        for (std::size_t at = 0; at < bytes.size(); ++at)
            for (const unsigned value : {0x00U, 0x04U, 0x07U, 0x09U, 0xFFU}) {
                auto changed = bytes;
                changed[at] = static_cast<std::byte>(value);
                QCOMPARE(decodeProbe(changed).has_value(), decodeSessionMessage(Probe::number, changed).has_value());
            }
        for (std::size_t length = 0; length < bytes.size(); ++length)
            QVERIFY(!decodeProbe(std::span(bytes).first(length)));
    }
};

QTEST_APPLESS_MAIN(ProbeWordsTest)
#include "probe_words_test.moc"
