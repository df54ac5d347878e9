// The wire's decisions and orders: seeded, and as often as they are told to be.
#include "wire/late_spans.hpp"
#include "wire/orders.hpp"
#include "wire/tap.hpp"

#include <QtTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

using namespace liena::lab;

namespace {

constexpr int frames = 100'000;
constexpr std::size_t frameSize = 200;

std::vector<Decision> decisions(const Impairment& impairment, std::uint64_t seed, Protocol protocol = Protocol::Udp)
{
    ImpairmentDraw draw(seed);
    std::vector<Decision> made;
    for (int i = 0; i < frames; ++i)
        made.push_back(draw.decide(impairment, protocol, frameSize, SteadyTime{}));
    return made;
}

double lossOf(const std::vector<Decision>& made)
{
    return static_cast<double>(std::count_if(made.begin(), made.end(), [](const Decision& d) { return d.drop; })) / frames;
}

double meanBurst(const std::vector<Decision>& made)
{
    int bursts = 0;
    int lost = 0;
    bool before = false;
    for (const auto& decision : made) {
        bursts += decision.drop && !before;
        lost += decision.drop;
        before = decision.drop;
    }
    return static_cast<double>(lost) / bursts;
}

} // namespace

class WireTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void decidesTheSameWithTheSameSeed();
    void losesAsManyAsItIsTold();
    void losesInBurstsOfTheMeanLength();
    void keepsTheFateOfLaterFramesWhenASettingChanges();
    void leavesTheOtherProtocolAlone();
    void growsTheDelayUpToItsEnd();
    void turnsABitInsideTheFrame();
    void readsOrders_data();
    void readsOrders();
    void refusesOrders_data();
    void refusesOrders();
    void joinsWhatWasLateTogether();
    void keepsTheNewestOfTooManySpans();
    void countsALongFrameAsItsPackets_data();
    void countsALongFrameAsItsPackets();
};

void WireTest::decidesTheSameWithTheSameSeed()
{
    Impairment impairment;
    impairment.drop = 0.3;
    impairment.jitter = std::chrono::milliseconds(10);
    const auto first = decisions(impairment, 7);
    const auto second = decisions(impairment, 7);
    const auto other = decisions(impairment, 8);
    const auto same = [&](const std::vector<Decision>& a, const std::vector<Decision>& b) {
        return std::equal(a.begin(), a.end(), b.begin(),
                          [](const Decision& x, const Decision& y) { return x.drop == y.drop && x.delay == y.delay; });
    };
    QVERIFY(same(first, second));
    QVERIFY(!same(first, other));
}

void WireTest::losesAsManyAsItIsTold()
{
    Impairment impairment;
    QCOMPARE(lossOf(decisions(impairment, 1)), 0.0);
    impairment.drop = 0.05;
    QVERIFY(std::abs(lossOf(decisions(impairment, 1)) - 0.05) < 0.004); // six standard deviations
    impairment.cut = true;
    QCOMPARE(lossOf(decisions(impairment, 1)), 1.0);
}

void WireTest::losesInBurstsOfTheMeanLength()
{
    Impairment impairment;
    impairment.burstStart = 0.001;
    impairment.burstEnd = 0.1;
    const double mean = meanBurst(decisions(impairment, 3));
    QVERIFY2(mean > 7 && mean < 13, qPrintable(QString::number(mean)));
}

void WireTest::keepsTheFateOfLaterFramesWhenASettingChanges()
{
    Impairment loss;
    loss.drop = 0.5;
    ImpairmentDraw plain(11);
    ImpairmentDraw changed(11);
    Impairment other;
    other.duplicate = 1;
    other.reorder = 1;
    for (int i = 0; i < 100; ++i) {
        (void)plain.decide(loss, Protocol::Tcp, frameSize, SteadyTime{});
        (void)changed.decide(other, Protocol::Tcp, frameSize, SteadyTime{});
    }
    for (int i = 0; i < 100; ++i)
        QCOMPARE(changed.decide(loss, Protocol::Tcp, frameSize, SteadyTime{}).drop,
                 plain.decide(loss, Protocol::Tcp, frameSize, SteadyTime{}).drop);
}

void WireTest::leavesTheOtherProtocolAlone()
{
    Impairment impairment;
    impairment.cut = true;
    impairment.only = Protocol::Udp;
    QCOMPARE(lossOf(decisions(impairment, 1, Protocol::Udp)), 1.0);
    QCOMPARE(lossOf(decisions(impairment, 1, Protocol::Tcp)), 0.0);
    QCOMPARE(lossOf(decisions(impairment, 1, Protocol::Any)), 0.0);
}

void WireTest::growsTheDelayUpToItsEnd()
{
    using std::chrono::milliseconds;
    Impairment impairment;
    impairment.ramp = milliseconds(200);
    impairment.rampEnd = milliseconds(500);
    impairment.since = SteadyTime{};
    ImpairmentDraw draw(1);
    const auto after = [&](milliseconds time) { return draw.decide(impairment, Protocol::Tcp, frameSize, SteadyTime{} + time).delay; };
    QVERIFY(after(milliseconds(0)) == milliseconds(0));
    QVERIFY(after(milliseconds(1000)) == milliseconds(200));
    QVERIFY(after(milliseconds(60'000)) == milliseconds(500));
}

void WireTest::turnsABitInsideTheFrame()
{
    Impairment impairment;
    impairment.corrupt = 1;
    for (const auto& decision : decisions(impairment, 5))
        QVERIFY(decision.turnedBit && *decision.turnedBit < frameSize * 8);
}

void WireTest::readsOrders_data()
{
    QTest::addColumn<QString>("line");
    QTest::addColumn<int>("kind");
    QTest::newRow("cut") << "link 1>2 cut" << 0;
    QTest::newRow("everything") << "link *>* drop=0.05 delay=10 jitter=20ms burst-start=0.01 burst-end=0.1 only=tcp largest=600" << 0;
    QTest::newRow("whole again") << "link *>*" << 0;
    QTest::newRow("rate") << "port 2 rate=1000000 queue=65536" << 1;
    QTest::newRow("carrier") << "carrier 1 off" << 2;
    QTest::newRow("counts") << "counts" << 3;
    QTest::newRow("late") << "late" << 4;
}

void WireTest::readsOrders()
{
    QFETCH(QString, line);
    QFETCH(int, kind);
    QCOMPARE(static_cast<int>(parseWireOrder(line.toStdString(), 2).index()), kind);
}

void WireTest::refusesOrders_data()
{
    QTest::addColumn<QString>("line");
    QTest::newRow("nothing") << "";
    QTest::newRow("unknown") << "explode";
    QTest::newRow("no port 3") << "link 1>3 cut";
    QTest::newRow("no port 0") << "link 0>1 cut";
    QTest::newRow("no number") << "link 1>2 drop=many";
    QTest::newRow("no field") << "link 1>2 sadness=1";
    QTest::newRow("no protocol") << "link 1>2 only=sctp";
    QTest::newRow("carrier") << "carrier 1 maybe";
}

void WireTest::refusesOrders()
{
    QFETCH(QString, line);
    QVERIFY(std::holds_alternative<BadOrder>(parseWireOrder(line.toStdString(), 2)));
}

void WireTest::joinsWhatWasLateTogether()
{
    const auto at = [](int microseconds) { return SteadyTime(std::chrono::microseconds(microseconds)); };
    LateSpans late;
    late.note(at(100), at(150)); // hardly
    late.note(at(1000), at(1400));
    late.note(at(1100), at(1500));
    late.note(at(5000), at(5300));
    const auto spans = late.take();
    QCOMPARE(spans.size(), std::size_t(2));
    QVERIFY(spans[0].begin == at(1000) && spans[0].end == at(1500));
    QVERIFY(spans[1].begin == at(5000) && spans[1].end == at(5300));
    QVERIFY(late.take().empty());
}

void WireTest::keepsTheNewestOfTooManySpans()
{
    LateSpans late;
    const auto due = [](std::size_t i) { return SteadyTime(std::chrono::milliseconds(10 * i)); };
    for (std::size_t i = 0; i <= LateSpans::mostKept; ++i)
        late.note(due(i), due(i) + LateSpans::worthTelling);
    const auto spans = late.take();
    QCOMPARE(spans.size(), LateSpans::mostKept);
    QVERIFY(spans.front().begin == due(1));
    QVERIFY(spans.back().begin == due(LateSpans::mostKept));
}

void WireTest::countsALongFrameAsItsPackets_data()
{
    QTest::addColumn<int>("kind"); // in front of a frame: 0 for a single packet, 1 for TCP over IPv4
    QTest::addColumn<quint64>("body");
    QTest::addColumn<quint64>("onTheCable");
    QTest::newRow("a packet") << 0 << quint64{1448} << quint64{66 + 1448};
    QTest::newRow("one that is just full") << 1 << quint64{1448} << quint64{66 + 1448};
    QTest::newRow("a byte more") << 1 << quint64{1449} << quint64{2 * 66 + 1449};
    QTest::newRow("ten") << 1 << quint64{14480} << quint64{10 * 66 + 14480};
}

void WireTest::countsALongFrameAsItsPackets()
{
    QFETCH(int, kind);
    QFETCH(quint64, body);
    constexpr std::size_t prefix = 10;
    constexpr std::size_t headers = 66;
    std::vector<std::byte> frame(prefix + headers + body);
    frame[1] = static_cast<std::byte>(kind);
    const std::array<std::uint16_t, 2> form{headers, 1448}; // their length, and what each packet carries
    std::memcpy(frame.data() + 2, form.data(), sizeof form);
    QTEST(quint64{lengthOnTheCable(frame, prefix)}, "onTheCable");
    QCOMPARE(lengthOnTheCable(frame, 0), frame.size());
}

QTEST_GUILESS_MAIN(WireTest)
#include "wire_test.moc"
