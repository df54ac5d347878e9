// Locks, other sessions and screen savers, told on a bus of the test's own: what is heard of them, and that who is silent, lies or dies
// neither shows what is hidden nor makes anybody wait.
//
// What follows from it for the hand is tried by gui.unseen, and with the whole console by system.never_unseen.
#include "seat/screen_saver.hpp"
#include "seat/seat_watch.hpp"
#include "support/fake_desktop.hpp"
#include "support/private_bus.hpp"

#include <QElapsedTimer>
#include <QTest>

using namespace console;
using namespace console::test;

namespace {

const QString locked = QStringLiteral("Screen is locked");
const QString elsewhere = QStringLiteral("Another session is on this screen");
const QString saved = QStringLiteral("Screen saver is on");
const QString noWord = QStringLiteral("Screen was hidden, no word since: restart the console");
const QString seen = QStringLiteral("seen");

/// One that writes down what it tells, in its order: the reason, or "seen".
class Told {
public:
    explicit Told(const SeatBuses& buses) : m_watch(buses)
    {
        QObject::connect(&m_watch, &SeatWatch::notSeen, &m_watch, [this](const QString& why) { words << why; });
        QObject::connect(&m_watch, &SeatWatch::seen, &m_watch, [this] { words << seen; });
        QObject::connect(&m_watch, &SeatWatch::remarked, &m_watch, [this](const QString& remark) { remarks << remark; });
        m_watch.start();
    }

    QStringList words;
    QStringList remarks;

private:
    SeatWatch m_watch;
};

/// Both buses of a computer, and a watch of a window on its X server.
struct Computer {
    PrivateBus system{ScreenSaver::names() + QStringList{QStringLiteral("org.freedesktop.login1")}};
    PrivateBus session{ScreenSaver::names()};

    SeatBuses buses() const { return {system.address(), session.address(), QStringLiteral(":0.0")}; }
};

} // namespace

class SeatWatchTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        if (const auto missing = PrivateBus::missing(); !missing.isEmpty())
            QSKIP(qPrintable(missing));
    }

    void aLockIsToldAndItsEnd()
    {
        const Computer computer;
        FakeLogind logind(computer.system.address());
        const Told told(computer.buses());
        QTRY_COMPARE(logind.asked(), 2);
        logind.set("LockedHint", true);
        QTRY_COMPARE(told.words, QStringList{locked});
        logind.set("LockedHint", false);
        QTRY_COMPARE(told.words, (QStringList{locked, seen}));
        QVERIFY(told.remarks.isEmpty());
    }

    void aSwitchToAnotherSessionIsToldAndTheWayBack()
    {
        const Computer computer;
        FakeLogind logind(computer.system.address());
        const Told told(computer.buses());
        QTRY_COMPARE(logind.asked(), 2);
        logind.set("Active", false);
        QTRY_COMPARE(told.words, QStringList{elsewhere});
        logind.set("LockedHint", true); // by whoever is there now
        QTRY_COMPARE(told.words, (QStringList{elsewhere, locked}));
        logind.set("LockedHint", false);
        QTRY_COMPARE(told.words, (QStringList{elsewhere, locked, elsewhere}));
        logind.set("Active", true);
        QTRY_COMPARE(told.words.back(), seen);
    }

    /// A desktop may be asked to lock, do so and never tell.
    void aLockThatIsAskedForStandsUntilItIsTakenBack_data()
    {
        QTest::addColumn<QString>("how");
        for (const char* how : {"asked to unlock", "the desktop tells of its lock", "the screen saver goes off"})
            QTest::newRow(how) << QString::fromLatin1(how);
    }

    void aLockThatIsAskedForStandsUntilItIsTakenBack()
    {
        QFETCH(QString, how);
        const Computer computer;
        FakeLogind logind(computer.system.address());
        FakeSaver saver(computer.session.address());
        const Told told(computer.buses());
        QTRY_COMPARE(saver.asked(), 1);
        logind.askToLock();
        QTRY_COMPARE(told.words, QStringList{locked});
        const int asked = logind.asked();
        logind.set("IdleHint", true); // another look at a desktop that has not locked yet
        QTRY_COMPARE(logind.asked(), asked + 1);
        logind.set("Active", false);
        logind.set("Active", true);
        QTRY_COMPARE(logind.asked(), asked + 3);
        if (how == QLatin1String("asked to unlock")) {
            logind.askToUnlock();
        } else if (how == QLatin1String("the desktop tells of its lock")) {
            logind.set("LockedHint", true);
            QTRY_COMPARE(logind.asked(), asked + 4);
            logind.set("LockedHint", false);
        } else {
            saver.turn(true);
            saver.turn(false);
        }
        QTRY_COMPARE(told.words, (QStringList{locked, seen}));
    }

    void aScreenSaverIsTold_data()
    {
        QTest::addColumn<QString>("name");
        for (const auto& name : ScreenSaver::names())
            QTest::newRow(qPrintable(name)) << name;
    }

    void aScreenSaverIsTold()
    {
        QFETCH(QString, name);
        const Computer computer;
        FakeLogind logind(computer.system.address());
        FakeSaver saver(computer.session.address(), name);
        saver.on = true;
        const Told told(computer.buses());
        QTRY_COMPARE(told.words, QStringList{saved});
        saver.turn(false);
        QTRY_COMPARE(told.words, (QStringList{saved, seen}));
    }

    void aScreenSaverThatComesLaterIsHeardAndOneThatEndsSaysNothingMore()
    {
        const Computer computer;
        FakeLogind logind(computer.system.address());
        const Told told(computer.buses());
        QTRY_COMPARE(logind.asked(), 2);
        {
            FakeSaver saver(computer.session.address());
            saver.turn(true);
            QTRY_COMPARE(told.words, QStringList{saved});
        }
        QTRY_COMPARE(told.words, (QStringList{saved, seen}));
    }

    void alsoALogindThatComesLaterIsHeard()
    {
        const Computer computer;
        const Told told(computer.buses());
        QTRY_COMPARE(told.remarks.size(), 1);
        FakeLogind logind(computer.system.address());
        QTRY_COMPARE(logind.asked(), 2);
        logind.set("LockedHint", true);
        QTRY_COMPARE(told.words, QStringList{locked});
    }

    /// Between the two the lock stands.
    void aLogindThatIsStartedAnewIsAskedAnew()
    {
        const Computer computer;
        auto logind = std::make_unique<FakeLogind>(computer.system.address());
        const Told told(computer.buses());
        QTRY_COMPARE(logind->asked(), 2);
        logind->set("LockedHint", true);
        QTRY_COMPARE(told.words, QStringList{locked});
        logind.reset();
        logind = std::make_unique<FakeLogind>(computer.system.address());
        logind->facts.insert(QStringLiteral("LockedHint"), true);
        QTRY_COMPARE(logind->asked(), 2);
        logind->set("LockedHint", false);
        QTRY_COMPARE(told.words, (QStringList{locked, seen}));
    }

    /// Nothing is known there, and that is said once; another session's screen saver is not this one's.
    void whereNoScreenIsNothingIsTold_data()
    {
        QTest::addColumn<QString>("fact");
        QTest::addColumn<QVariant>("value");
        const auto row = [](const char* name, const char* fact, const QVariant& value) {
            QTest::newRow(name) << QString::fromLatin1(fact) << value;
        };
        row("over SSH", "Type", QStringLiteral("tty"));
        row("without a seat", "Seat", seatNamed(QString()));
        row("of nobody", "Class", QStringLiteral("greeter"));
        row("on another X server", "Display", QStringLiteral(":1"));
    }

    void whereNoScreenIsNothingIsTold()
    {
        QFETCH(QString, fact);
        QFETCH(QVariant, value);
        const Computer computer;
        FakeLogind logind(computer.system.address());
        logind.facts.insert(fact, value);
        logind.facts.insert(QStringLiteral("LockedHint"), true);
        logind.facts.insert(QStringLiteral("Active"), false);
        FakeSaver saver(computer.session.address());
        saver.on = true;
        const Told told(computer.buses());
        QTRY_COMPARE(told.remarks, QStringList{QStringLiteral("logind does not tell whether somebody sees this screen: "
                                                              "this program belongs to no session with a screen")});
        const int asked = logind.asked();
        logind.set("IdleHint", true);
        QTRY_COMPARE(logind.asked(), asked + 1);
        QCOMPARE(saver.asked(), 0);
        QVERIFY(told.words.isEmpty() && told.remarks.size() == 1);
    }

    void wherePartsAreMissingTheOthersAreHeard_data()
    {
        QTest::addColumn<QString>("what");
        for (const char* what : {"no system bus", "a system bus that is not there", "no logind", "no session", "a session of no name"})
            QTest::newRow(what) << QString::fromLatin1(what);
    }

    void wherePartsAreMissingTheOthersAreHeard()
    {
        QFETCH(QString, what);
        const Computer computer;
        auto buses = computer.buses();
        std::unique_ptr<FakeLogind> logind;
        if (what == QLatin1String("no system bus"))
            buses.system.clear();
        else if (what == QLatin1String("a system bus that is not there"))
            buses.system = QStringLiteral("unix:path=/nowhere/bus");
        else if (what != QLatin1String("no logind")) {
            logind = std::make_unique<FakeLogind>(computer.system.address());
            logind->session = what == QLatin1String("no session") ? QVariant() : QVariant(42);
        }
        FakeSaver saver(computer.session.address());
        const Told told(buses);
        QTRY_COMPARE(saver.asked(), 1);
        QVERIFY(told.words.isEmpty());
        saver.turn(true);
        QTRY_COMPARE(told.words, QStringList{saved});
        QCOMPARE(told.remarks.size(), 1);
    }

    void withoutAnyBusNothingIsSaid()
    {
        SeatWatch watch({});
        watch.start();
        const Told told({QStringLiteral("unix:path=/nowhere/system"), QStringLiteral("unix:path=/nowhere/session")});
        QTRY_COMPARE(told.remarks.size(), 1);
        QVERIFY(told.words.isEmpty());
    }

    /// What makes no sense changes nothing: neither is it taken for a lock, nor for the end of one.
    void whatMakesNoSenseChangesNothing_data()
    {
        QTest::addColumn<QVariantList>("answer");
        const auto flags = [](const char* name, const QVariant& locked, const QVariant& active) {
            auto facts = inSight();
            facts.insert(QStringLiteral("LockedHint"), locked);
            facts.insert(QStringLiteral("Active"), active);
            QTest::newRow(name) << QVariantList{facts};
        };
        flags("words for flags", QStringLiteral("yes"), QStringLiteral("false"));
        flags("numbers for flags", 1, 0);
        flags("flags in lists", QVariantList{true}, QVariantList{false});
        QTest::newRow("nothing") << QVariantList{};
        QTest::newRow("no facts") << QVariantList{QVariantMap{}};
        QTest::newRow("a list of flags") << QVariantList{QVariantList{true, false}};
        QTest::newRow("one seat in a list") << QVariantList{QVariantMap{{QStringLiteral("Seat"), QStringList{QStringLiteral("seat0")}}}};
    }

    void whatMakesNoSenseChangesNothing()
    {
        QFETCH(QVariantList, answer);
        const Computer computer;
        FakeLogind logind(computer.system.address());
        logind.answered = answer;
        FakeSaver saver(computer.session.address());
        const Told told(computer.buses());
        const auto turns = [&] {
            const int asked = logind.asked();
            logind.set("IdleHint", true);
            return QTest::qWaitFor([&] { return logind.asked() == asked + 1; });
        };
        QTRY_COMPARE(saver.asked(), 1); // so it has been heard, and is not known
        saver.turn(QStringLiteral("on"));
        saver.turn(1);
        QVERIFY(turns());
        QVERIFY(told.words.isEmpty());
        logind.answered.reset();
        logind.set("LockedHint", true);
        QTRY_COMPARE(told.words, QStringList{locked});
        logind.answered = answer;
        QVERIFY(turns());
        logind.answered.reset();
        logind.set("Active", false); // the next good word is of this only
        logind.set("LockedHint", false);
        QTRY_COMPARE(told.words, (QStringList{locked, elsewhere}));
    }

    void whatMakesSenseCountsBesideWhatDoesNot()
    {
        const Computer computer;
        FakeLogind logind(computer.system.address());
        const Told told(computer.buses());
        QTRY_COMPARE(logind.asked(), 2);
        logind.set("Seat", 7);
        logind.set("LockedHint", true);
        QTRY_COMPARE(told.words, QStringList{locked});
    }

    void aBusThatDiesWhileTheScreenIsSeenIsToldOnce()
    {
        Computer computer;
        FakeLogind logind(computer.system.address());
        FakeSaver saver(computer.session.address());
        const Told told(computer.buses());
        QTRY_COMPARE(saver.asked(), 1);
        computer.session.end();
        computer.system.end();
        QTRY_COMPARE(told.remarks.size(), 1);
        QVERIFY(told.remarks.front().endsWith(QStringLiteral("its bus has ended")));
        QVERIFY(told.words.isEmpty());
    }

    void aBusThatDiesWhileTheScreenIsHiddenShowsNothing_data()
    {
        QTest::addColumn<QString>("how");
        for (const char* how : {"locked", "another session", "screen saver"})
            QTest::newRow(how) << QString::fromLatin1(how);
    }

    void aBusThatDiesWhileTheScreenIsHiddenShowsNothing()
    {
        QFETCH(QString, how);
        Computer computer;
        FakeLogind logind(computer.system.address());
        FakeSaver saver(computer.session.address());
        const Told told(computer.buses());
        QTRY_COMPARE(saver.asked(), 1);
        if (how == QLatin1String("locked"))
            logind.set("LockedHint", true);
        else if (how == QLatin1String("another session"))
            logind.set("Active", false);
        else
            saver.turn(true);
        QTRY_COMPARE(told.words.size(), 1);
        (how == QLatin1String("screen saver") ? computer.session : computer.system).end();
        QTRY_COMPARE(told.words.size(), 2);
        QCOMPARE(told.words.back(), noWord);
        (how == QLatin1String("screen saver") ? computer.system : computer.session).end();
        QTRY_COMPARE(told.remarks.size(), 1);
        QCOMPARE(told.words.size(), 2);
    }

    /// Whoever may be started for his name is not.
    void nobodyIsStarted()
    {
        const Computer computer;
        const Told told(computer.buses());
        QTRY_COMPARE(told.remarks.size(), 1);
        FakeLogind logind(computer.system.address());
        QTRY_COMPARE(logind.asked(), 2);
        FakeSaver last(computer.session.address(), ScreenSaver::names().back());
        last.turn(true);
        QTRY_COMPARE(told.words, QStringList{saved});
        QVERIFY(!computer.system.wasStarted() && !computer.session.wasStarted());
    }

    /// And once it does, what was hidden from the start is told.
    void aBusThatDoesNotAnswerKeepsNobodyWaiting()
    {
        Computer computer;
        FakeLogind logind(computer.system.address());
        logind.facts.insert(QStringLiteral("LockedHint"), true);
        computer.system.freeze();
        QElapsedTimer since;
        since.start();
        const Told told(computer.buses());
        QCoreApplication::processEvents();
        QVERIFY2(since.elapsed() < 1000, qPrintable(QString::number(since.elapsed())));
        QVERIFY(told.words.isEmpty() && told.remarks.isEmpty());
        computer.system.thaw();
        QTRY_COMPARE(told.words, QStringList{locked});
    }
};

QTEST_GUILESS_MAIN(SeatWatchTest)
#include "seat_watch_test.moc"
