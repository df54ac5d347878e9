// The figures on the card of a link: of one that carries messages, and of no other.
#include "shown_texts.hpp"
#include "widgets/link_card.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QTest>

#include <utility>
#include <vector>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

constexpr quint32 robot = 0x00008208;
const Instant now = Instant{} + 1h;

/// Everything of it was told once.
LinkNode linkIn(LinkState state)
{
    LinkNode link;
    link.own = true;
    link.peer = robot;
    link.state = state;
    link.figuresAt = now;
    link.figures.lastHeard = now - 12ms;
    link.figures.roundTrip = 8400us;
    link.figures.jitter = 700us;
    link.figures.heartbeatsReceived = 94;
    link.figures.heartbeatsMissed = 6;
    return link;
}

void show(LinkCard& card, const LinkNode& link)
{
    DeviceNode device;
    device.id = link.peer;
    device.title = QStringLiteral("Vascular robot");
    device.kind = DeviceKind::Hand;
    card.resize(card.sizeHint());
    card.setLink(link, device, now);
}

/// All texts of its card, one behind the other.
QString painted(const LinkNode& link)
{
    LinkCard card(link.peer);
    show(card, link);
    return wordsPaintedBy(card);
}

QImage pictureOf(const LinkNode& link)
{
    LinkCard card(link.peer);
    show(card, link);
    return card.grab().toImage().convertToFormat(QImage::Format_RGB32);
}

/// Red pixels of the left and of the right half.
std::pair<int, int> red(const QImage& picture)
{
    std::pair<int, int> found;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            if (const QColor seen = picture.pixelColor(x, y); seen.red() > 150 && seen.green() < 110)
                ++(x < picture.width() / 2 ? found.first : found.second);
    return found;
}

} // namespace

class TestLinkCard : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void figuresAreThoseOfALinkThatCarriesMessages_data()
    {
        QTest::addColumn<LinkState>("state");
        QTest::addColumn<bool>("carries");
        QTest::newRow("closed") << LinkState::Closed << false;
        QTest::newRow("opening") << LinkState::Opening << false;
        QTest::newRow("open") << LinkState::Open << true;
        QTest::newRow("suspect") << LinkState::Suspect << true;
        QTest::newRow("interrupted") << LinkState::Reconnecting << false;
        QTest::newRow("stand-by") << LinkState::StandBy << false;
        QTest::newRow("re-opening") << LinkState::Reopening << false;
        QTest::newRow("closing") << LinkState::Closing << false;
    }

    /// What was measured before says nothing of a line that is not open: a dash stands there. When it was heard last stays true.
    void figuresAreThoseOfALinkThatCarriesMessages()
    {
        QFETCH(LinkState, state);
        QFETCH(bool, carries);
        const QString words = painted(linkIn(state));
        const auto shows = [&words](const QString& text) { return words.contains(text); };
        QVERIFY2(shows(carries ? QStringLiteral("Round trip8.4\u00A0ms") : QStringLiteral("Round trip\u2014\u00A0ms")), qPrintable(words));
        QVERIFY2(shows(carries ? QStringLiteral("Jitter0.7\u00A0ms") : QStringLiteral("Jitter\u2014\u00A0ms")), qPrintable(words));
        QVERIFY2(shows(carries ? QStringLiteral("Loss so far6.0\u00A0%") : QStringLiteral("Loss so far\u2014\u00A0%")), qPrintable(words));
        const bool closed = state == LinkState::Closed;
        QVERIFY2(shows(closed ? QStringLiteral("Heard ago\u2014Round") : QStringLiteral("Heard ago12\u00A0ms")), qPrintable(words));
    }

    /// One direction may be broken while the other stands.
    void eachDirectionHasAnArrowOfItsOwn()
    {
        const auto arrows = [](bool toPeer, bool fromPeer) {
            LinkNode link = linkIn(LinkState::Suspect);
            link.figures.toPeerConnected = toPeer;
            link.figures.fromPeerConnected = fromPeer;
            return red(pictureOf(link));
        };
        QCOMPARE(arrows(true, true), std::pair(0, 0));
        QVERIFY(arrows(false, true).first > 0);
        QCOMPARE(arrows(false, true).second, 0);
        QVERIFY(arrows(true, false).second > 0);
        QCOMPARE(arrows(true, false).first, 0);
    }

    void theLastMinuteIsDrawn()
    {
        LinkNode link = linkIn(LinkState::Open);
        link.figures.toPeerConnected = link.figures.fromPeerConnected = true;
        const QImage before = pictureOf(link);
        for (int i = 300; i >= 0; --i) // half of the minute
            link.history.push_back({now - i * 100ms, LinkState::Open, 8.0 + i % 7, 0.5, 10.0});
        const QImage after = pictureOf(link);
        std::vector<int> columns;
        for (int x = 0; x < before.width(); ++x)
            for (int y = 0; y < before.height(); ++y)
                if (before.pixel(x, y) != after.pixel(x, y)) {
                    columns.push_back(x);
                    break;
                }
        QVERIFY(columns.size() > std::size_t(before.width()) / 4);
        QVERIFY2(columns.front() > before.width() / 3, qPrintable(QString::number(columns.front()))); // the older half is empty
    }

    void aFigureThatIsNotKnownIsADash()
    {
        LinkNode link = linkIn(LinkState::Open);
        link.figures.jitter.reset();
        QString words = painted(link);
        QVERIFY2(words.contains(QStringLiteral("Round trip8.4\u00A0ms")), qPrintable(words));
        QVERIFY2(words.contains(QStringLiteral("Jitter\u2014\u00A0ms")), qPrintable(words));
        link = linkIn(LinkState::Open);
        link.figures.roundTrip.reset();
        link.figures.lastHeard.reset();
        words = painted(link);
        QVERIFY2(words.contains(QStringLiteral("Heard ago\u2014Round trip\u2014\u00A0ms")), qPrintable(words));
        QVERIFY2(words.contains(QStringLiteral("Jitter0.7\u00A0ms")), qPrintable(words));
    }
};

QTEST_MAIN(TestLinkCard)
#include "test_link_card.moc"
