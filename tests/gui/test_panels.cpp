// The status strip, the force gauge, the drives, contrast and dose: what they say, and what they do when it is too much or too old.
#include "cockpit_stage.hpp"
#include "shown_texts.hpp"
#include "widgets/axis_panel.hpp"
#include "widgets/dose_panel.hpp"
#include "widgets/force_gauge.hpp"
#include "widgets/hand_block.hpp"
#include "widgets/link_card.hpp"
#include "widgets/status_strip.hpp"
#include "widgets/trends_pane.hpp"

#include <QLabel>

#include <algorithm>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

QString painted(QWidget& widget)
{
    QString all;
    for (const ShownText& shown : textsPaintedBy(widget))
        all += shown.text;
    return all;
}

/// The panel of the instrument whose name begins so.
AxisPanel* axis(const CockpitStage& stage, const QString& name)
{
    for (auto* panel : stage.window.findChildren<AxisPanel*>())
        if (panel->accessibleName() == name)
            return panel;
    return nullptr;
}

QLabel* labelWith(const QWidget& within, const QString& words)
{
    for (auto* label : within.findChildren<QLabel*>())
        if (label->text().contains(words))
            return label;
    return nullptr;
}

/// Columns of the picture's lower third in which the trail is drawn: nothing else there is as bright.
std::vector<int> trailColumns(const QImage& picture)
{
    std::vector<int> columns;
    for (int x = 0; x < picture.width(); ++x)
        for (int y = picture.height() * 2 / 3; y < picture.height(); ++y)
            if (picture.pixelColor(x, y).blue() > 2 * theme::colour::line.blue()) {
                columns.push_back(x);
                break;
            }
    return columns;
}

/// How many columns there are, at most, between two in which a course is drawn: nothing else in the trends is violet.
int widestHole(const QImage& picture)
{
    int widest = 0;
    int last = -1;
    for (int x = 0; x < picture.width(); ++x)
        for (int y = 0; y < picture.height(); ++y)
            if (const QColor seen = picture.pixelColor(x, y); seen.blue() - seen.green() > 30) {
                widest = last < 0 ? 0 : std::max(widest, x - last);
                last = x;
                break;
            }
    return widest;
}

/// A panel at its usual size, of an instrument at `position` with 5 mm between its limits.
QImage axisAt(double position, Freshness freshness, const InstrumentTravel& travel = {{0, 630}, {-5, 635}})
{
    AxisReading reading;
    reading.freshness = freshness;
    reading.position = position;
    reading.travel = travel;
    AxisPanel panel(QStringLiteral("Guidewire"), icons::Icon::Guidewire);
    panel.resize(panel.sizeHint());
    panel.setReading(reading);
    return panel.grab().toImage().convertToFormat(QImage::Format_RGB32);
}

/// The rows in which two pictures differ, of each column of the lower half, where the bar is.
std::vector<std::vector<int>> differingRows(const QImage& one, const QImage& other)
{
    std::vector<std::vector<int>> columns(std::size_t(one.width()));
    for (int x = 0; x < one.width(); ++x)
        for (int y = one.height() / 2; y < one.height(); ++y)
            if (one.pixel(x, y) != other.pixel(x, y))
                columns[std::size_t(x)].push_back(y);
    return columns;
}

} // namespace

class TestPanels : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void theSecondIdentifierIsWholeHoweverLongTheNameIs_data()
    {
        QTest::addColumn<QSize>("screen");
        for (const QSize& size : {QSize(2560, 1440), QSize(1920, 1080), QSize(1366, 768)})
            QTest::addRow("%d", size.height()) << size;
    }

    void theSecondIdentifierIsWholeHoweverLongTheNameIs()
    {
        QFETCH(QSize, screen);
        CockpitStage stage(screen);
        QVERIFY(stage.ready());
        const QString name = QStringLiteral("Maximiliana <b>Konstantina</b> Freifrau von und zu Hohenstein-Wittgenstein-Berleburg");
        stage.window.setPatient(name, QStringLiteral("PID-2026-0004711"));
        stage.window.setOperator(QStringLiteral("Prof. Dr. Dr. Anneliese Schmidt-Rottluff"));
        stage.refresh();
        auto* label = stage.named<NameLabel>(QStringLiteral("Patient: PID-2026-0004711 \u00B7 ") + name);
        QVERIFY(label != nullptr);
        QVERIFY(label->toolTip().contains(name.toHtmlEscaped()));
        QTRY_VERIFY2(painted(*label).startsWith(QStringLiteral("PID-2026-0004711 \u00B7 Max")), qPrintable(painted(*label)));
        QVERIFY(painted(*label).endsWith(QChar(0x2026)));
        for (const ShownText& shown : textsPaintedBy(*label))
            QVERIFY2(shown.ink.right() <= label->width() + 1.5, qPrintable(shown.text));
        const auto* strip = stage.window.findChild<StatusStrip*>();
        for (const QWidget* mark :
             {static_cast<QWidget*>(strip->findChild<XrayMark*>()), static_cast<QWidget*>(strip->findChild<ModeMark*>())})
            QVERIFY2(mark->width() >= mark->sizeHint().width(), mark->metaObject()->className());
    }

    void aShortNameIsWhole()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.window.setPatient(QStringLiteral("Invented, Eva"), QStringLiteral("4711"));
        stage.refresh();
        auto* label = stage.named<NameLabel>(QStringLiteral("Patient: 4711 \u00B7 Invented, Eva"));
        QVERIFY(label != nullptr);
        QTRY_COMPARE(painted(*label), QStringLiteral("4711 \u00B7 Invented, Eva"));
    }

    void eachDriveShowsItsOwnWarmthAndCurrent()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.window.refresh(stage.cockpit.now);
        const auto shows = [&stage](const QString& instrument, const QString& advance, const QString& turn) {
            auto* panel = axis(stage, instrument);
            const QString words = painted(*panel);
            return words.contains(advance) && words.contains(turn) && panel->accessibleDescription().contains(advance);
        };
        QTRY_VERIFY(shows(QStringLiteral("Guidewire"), QStringLiteral("38\u00A0\u00B0C \u00B7 0.4\u00A0A"),
                          QStringLiteral("36\u00A0\u00B0C \u00B7 0.2\u00A0A")));
        QTRY_VERIFY(shows(QStringLiteral("Catheter"), QStringLiteral("41\u00A0\u00B0C \u00B7 0.5\u00A0A"),
                          QStringLiteral("35\u00A0\u00B0C \u00B7 0.1\u00A0A")));
    }

    void theAngleIsShownOnEveryScreen_data() { theSecondIdentifierIsWholeHoweverLongTheNameIs_data(); }

    void theAngleIsShownOnEveryScreen()
    {
        QFETCH(QSize, screen);
        CockpitStage stage(screen);
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.window.refresh(stage.cockpit.now);
        auto* panel = axis(stage, QStringLiteral("Guidewire"));
        QTRY_VERIFY2(painted(*panel).contains(QStringLiteral("134\u00B0")), qPrintable(painted(*panel)));
        if (screen.height() >= 1080)
            QVERIFY2(painted(*panel).contains(QStringLiteral("turned 134\u00B0")), qPrintable(painted(*panel)));
    }

    /// Where motion ends by itself is seen, though it is 5 mm of 640.
    void theZonesOfTheSoftLimitsAreWideEnoughToBeSeen()
    {
        const auto columns = differingRows(axisAt(315, Freshness::Fresh), axisAt(315, Freshness::Fresh, {{-5, 635}, {-5, 635}}));
        std::vector<int> marked;
        for (int x = 0; x < int(columns.size()); ++x)
            if (!columns[std::size_t(x)].empty())
                marked.push_back(x);
        QVERIFY(marked.size() > 2);
        const auto gap = std::adjacent_find(marked.begin(), marked.end(), [](int a, int b) { return b - a > 40; });
        QVERIFY2(gap != marked.end(), "the two ends were not told apart");
        QVERIFY2(*gap - marked.front() >= 7, qPrintable(QString::number(*gap - marked.front())));
        QVERIFY2(marked.back() - *(gap + 1) >= 7, qPrintable(QString::number(marked.back() - *(gap + 1))));
    }

    /// Hatching is the limits': an old position is an empty bar, the same in each of its columns.
    void anOldPositionIsNotHatched()
    {
        const auto columns = differingRows(axisAt(60, Freshness::Stale), axisAt(570, Freshness::Stale));
        std::vector<int> marked;
        for (int x = 0; x < int(columns.size()); ++x)
            if (!columns[std::size_t(x)].empty())
                marked.push_back(x);
        QVERIFY(marked.size() > 60);
        const int from = marked.front() + (marked.back() - marked.front()) / 3;
        const int to = marked.front() + (marked.back() - marked.front()) * 2 / 3;
        for (int x = from; x <= to; ++x)
            QVERIFY2(columns[std::size_t(x)] == columns[std::size_t(from)], qPrintable(QString::number(x)));
        QVERIFY(!columns[std::size_t(from)].empty());
    }

    void theTrailIsBrokenWhereNothingWasHeard()
    {
        InstrumentState instrument;
        const Instant now = std::chrono::steady_clock::now();
        RobotStatus status;
        status.guidewireForce = 0.8;
        for (Duration ago = 10s; ago >= 0ms; ago -= 50ms)
            if (ago > 7s || ago < 3s) // four seconds of silence
                instrument.receiveRobot(status, now - ago);
        ForceGauge gauge;
        gauge.resize(350, 350);
        gauge.setState(instrument, now);
        const auto columns = trailColumns(gauge.grab().toImage());
        const auto between = [&columns](int from, int to) {
            return std::count_if(columns.begin(), columns.end(), [from, to](int x) { return x > from && x < to; });
        };
        QVERIFY(between(20, 95) > 60);
        QCOMPARE(between(120, 230), 0);
        QVERIFY(between(260, 345) > 60);
    }

    void theLastInjectionSaysHowItEndedAndWhen()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        auto& instrument = stage.cockpit.models.instrument;
        const auto* panel = stage.window.findChild<DosePanel*>();
        const Instant now = stage.cockpit.now;
        instrument.receiveInjection({9, 2.1, InjectionProgress::Stopped, QStringLiteral("HOLD")}, now - 65s);
        stage.window.refresh(now);
        const auto* outcome = labelWith(*panel, QStringLiteral("stopped, 1:05 ago"));
        QVERIFY(outcome != nullptr);
        QCOMPARE(outcome->palette().color(QPalette::WindowText), theme::colour::bright); // unlike one that was given whole
        const auto* amount = labelWith(*panel, QStringLiteral("2.1\u00A0mL"));
        QVERIFY(amount != nullptr);
        QCOMPARE(amount->palette().color(QPalette::WindowText), theme::colour::bright);
        stage.window.refresh(now + 3s); // the robot is not heard any more
        QVERIFY(amount->palette().color(QPalette::WindowText) != theme::colour::bright);
        instrument.receiveInjection({10, 5, InjectionProgress::Done, {}}, now);
        stage.window.refresh(now + 7s);
        const auto* done = labelWith(*panel, QStringLiteral("done, 0:07 ago"));
        QVERIFY(done != nullptr);
        QCOMPARE(done->palette().color(QPalette::WindowText), theme::colour::secondary);
    }

    void contrastLeftIsCountedInInjectionsWithTheirRate()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        const auto* panel = stage.window.findChild<DosePanel*>();
        stage.window.refresh(stage.cockpit.now);
        QVERIFY(labelWith(*panel, QStringLiteral("\u2248 15 injections \u00B7 2 mL/s")) != nullptr);
        stage.window.refresh(stage.cockpit.now + 3s); // and by then some may have been given
        QVERIFY(labelWith(*panel, QStringLiteral("\u2248 15")) == nullptr);
        QVERIFY(labelWith(*panel, QStringLiteral("\u2248 \u2014 injections")) != nullptr);
    }

    void trendsDrawNothingWhereTheConsoleStoodStill_data()
    {
        QTest::addColumn<int>("stood"); // seconds
        QTest::addColumn<int>("span");
        QTest::newRow("a minute, none") << 0 << int(TrendSpan::Minute);
        QTest::newRow("a minute, 20 s") << 20 << int(TrendSpan::Minute);
        QTest::newRow("ten minutes, none") << 0 << int(TrendSpan::TenMinutes);
        QTest::newRow("ten minutes, 200 s") << 200 << int(TrendSpan::TenMinutes);
    }

    void trendsDrawNothingWhereTheConsoleStoodStill()
    {
        QFETCH(int, stood);
        QFETCH(int, span);
        TrendBook book;
        const Duration all = length(TrendSpan(span));
        const Instant start = Instant{} + 1h;
        for (Duration at{}; at <= all; at += 100ms) {
            if (at > all / 3 && at < all / 3 + std::chrono::seconds(stood))
                continue;
            TrendReading reading;
            reading.roundTripMs = 4;
            book.note(reading, start + at);
        }
        TrendsPane pane(book);
        pane.resize(900, 300);
        pane.setSpan(TrendSpan(span));
        pane.refresh({}, start + all);
        const int hole = widestHole(pane.grab().toImage());
        QVERIFY2(stood > 0 ? hole > 120 : hole < 60, qPrintable(QString::number(hole)));
    }

    void theHandSaysWhatItsScaleWasBefore()
    {
        HandState hand;
        HandReading reading{true, false, false, 0.8, {}};
        const InstrumentState instrument;
        HandBlock block;
        block.resize(block.sizeHint());
        const auto shown = [&] {
            hand.set(reading);
            block.setState(hand, instrument, {}, {});
            return painted(block);
        };
        QVERIFY2(!shown().contains(QStringLiteral("was")), qPrintable(shown()));
        reading.scaleBefore = 1.0;
        QVERIFY2(shown().contains(QStringLiteral("0.80 : 1, was 1.00")), qPrintable(shown()));
        QVERIFY(block.accessibleDescription().contains(QStringLiteral("scale 0.80 : 1, was 1.00")));
        reading.scaleBefore.reset();
        QVERIFY(!shown().contains(QStringLiteral("was")));
    }

    void aDeadManOfAnotherConsoleIsNeverShownAsOurs()
    {
        const HandState hand;
        InstrumentState instrument;
        const Instant now = Instant{} + 1h;
        RobotStatus status;
        status.state = RobotState::Engaged;
        status.engaged = true;
        instrument.receiveRobot(status, now);
        HandBlock block;
        block.resize(block.sizeHint());
        const auto show = [&](const QString& owner, Duration later) {
            block.setState(hand, instrument, owner, now + later);
            return painted(block);
        };
        const auto looksPressed = [&block] {
            const QImage seen = block.grab().toImage();
            for (int y = 0; y < seen.height(); ++y)
                for (int x = 0; x < seen.width(); ++x)
                    if (seen.pixelColor(x, y) == theme::colour::armed)
                        return true;
            return false;
        };
        QVERIFY(show({}, 0ms).contains(QStringLiteral("At the robot")));
        QVERIFY(painted(block).contains(QStringLiteral("console only"))); // in that column: the clutch is not the robot's
        QVERIFY(looksPressed());
        const QString other = QStringLiteral("Console <2>");
        QString words = show(other, 0ms);
        QVERIFY2(words.contains(QStringLiteral("Of Con")) && words.contains(QStringLiteral("pressed")), qPrintable(words));
        QVERIFY2(!words.contains(QStringLiteral("At the robot")), qPrintable(words));
        QVERIFY(!looksPressed());
        QVERIFY(block.accessibleDescription().contains(QStringLiteral("at the robot pressed (that of Console <2>)")));
        QVERIFY(block.toolTip().contains(other.toHtmlEscaped()));
        words = show(other, 1s); // the robot is not heard: nor is whose it is
        QVERIFY2(words.contains(QStringLiteral("At the robot")) && !words.contains(QStringLiteral("pressed")), qPrintable(words));
        QVERIFY(block.toolTip().isEmpty());
    }

    void theBarTellsWhoHasTheRobot()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        const auto* block = stage.window.findChild<HandBlock*>();
        const auto atRobot = [&](quint32 owner) {
            RobotStatus status = stage.cockpit.status(RobotState::Engaged);
            status.owner = owner;
            stage.cockpit.models.instrument.receiveRobot(status, stage.cockpit.now);
            stage.window.refresh(stage.cockpit.now);
            return block->accessibleDescription();
        };
        QVERIFY2(atRobot(cockpitId).contains(QStringLiteral("at the robot pressed, ")), qPrintable(block->accessibleDescription()));
        QVERIFY2(atRobot(0x40018209).contains(QStringLiteral("at the robot pressed (that of 0x40018209), ")),
                 qPrintable(block->accessibleDescription()));
        QVERIFY2(atRobot(0).contains(QStringLiteral("at the robot pressed, ")), qPrintable(block->accessibleDescription()));
    }

    /// An open link is as old as it was when it was read, or a healthy one would look late. When readings stop, or it is not heard in time,
    /// it grows older with each look at it.
    void aLinkWasHeardAsLongAgoAsIsTrue()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll(); // heard 12 ms before the figures were read
        auto* card = stage.window.findChild<LinkCard*>();
        QVERIFY(card != nullptr);
        const auto shownAfter = [&](Duration since) {
            stage.window.refresh(stage.cockpit.now + since);
            return painted(*card);
        };
        QVERIFY2(shownAfter(0ms).contains(QStringLiteral("ago12\u00A0ms")), qPrintable(painted(*card)));
        QVERIFY2(shownAfter(100ms).contains(QStringLiteral("ago12\u00A0ms")), qPrintable(painted(*card)));
        QVERIFY2(shownAfter(350ms).contains(QStringLiteral("ago362\u00A0ms")), qPrintable(painted(*card)));
        QVERIFY2(shownAfter(5s).contains(QStringLiteral("ago5.0\u00A0s")), qPrintable(painted(*card)));
        for (const auto state : {LinkState::Suspect, LinkState::Reconnecting, LinkState::StandBy}) {
            stage.cockpit.models.sessions.setLinkState(card->peer(), state, stage.cockpit.now);
            QVERIFY2(shownAfter(100ms).contains(QStringLiteral("ago112\u00A0ms")), qPrintable(painted(*card)));
        }
    }

    /// What does not fit is not just missing: an ellipsis says that there is more, and the tool tip has all of it.
    void keysWithoutRoomEndInAnEllipsis()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        const QString keys = QStringLiteral("invented keys of a hand ").repeated(12).trimmed();
        stage.window.setKeyLegend(keys);
        stage.refresh();
        auto* label = labelWith(stage.window, QStringLiteral("invented keys"));
        QVERIFY(label != nullptr);
        QTRY_VERIFY2(painted(*label).startsWith(QStringLiteral("invented")) && painted(*label).endsWith(QChar(0x2026)),
                     qPrintable(painted(*label)));
        for (const ShownText& shown : textsPaintedBy(*label))
            QVERIFY2(shown.ink.right() <= label->width() + 1.5, qPrintable(shown.text));
        QCOMPARE(label->toolTip(), keys);
        stage.window.setKeyLegend(QStringLiteral("X key"));
        QTRY_COMPARE(painted(*label), QStringLiteral("X key"));
    }

    /// As near to its value as can be, and apart from what stands above.
    void aCaptionBelongsToTheValueBeneathIt()
    {
        CockpitStage stage({2560, 1440});
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.refresh();
        const auto* panel = stage.window.findChild<DosePanel*>();
        QVERIFY(labelWith(*panel, QStringLiteral("Repeated from the X-ray system, ")) != nullptr);
        const auto* caption = labelWith(*panel, QStringLiteral("Air kerma"));
        const auto* value = labelWith(*panel, QStringLiteral("mGy"));
        const auto* above = labelWith(*panel, QStringLiteral("injections"));
        QVERIFY(caption && value && above);
        QVERIFY(value->font().pixelSize() >= 24);
        QTRY_VERIFY2(caption->y() - above->geometry().bottom() > 2 * (value->y() - caption->geometry().bottom()),
                     qPrintable(QStringLiteral("%1 above, %2 below")
                                    .arg(caption->y() - above->geometry().bottom())
                                    .arg(value->y() - caption->geometry().bottom())));
    }
};

QTEST_MAIN(TestPanels)
#include "test_panels.moc"
