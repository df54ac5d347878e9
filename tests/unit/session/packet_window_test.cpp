// Each number once, in any order within reach.
#include "session/packet_window.hpp"

#include <QTest>

#include <random>
#include <set>

using liena::session::PacketWindow;

class PacketWindowTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void takesEachNumberOnce()
    {
        PacketWindow window;
        QVERIFY(!window.isNew(0)); // numbers start at 1
        QVERIFY(window.isNew(1));
        window.note(1);
        QVERIFY(!window.isNew(1));
        QVERIFY(window.isNew(2));
    }
    void takesWhatComesLateWithinReach()
    {
        PacketWindow window;
        window.note(5000);
        QVERIFY(window.isNew(5000 - 1024));
        QVERIFY(!window.isNew(5000 - 1025));
        window.note(5000 - 1024);
        QVERIFY(!window.isNew(5000 - 1024));
        QVERIFY(!window.isNew(5000));
    }
    void askingMovesNothing()
    {
        PacketWindow window;
        window.note(1);
        QVERIFY(window.isNew(1'000'000));
        QCOMPARE(window.newest(), std::uint64_t{1});
        QVERIFY(window.isNew(2));
    }
    void forgetsOldPlacesWhenItMovesOn()
    {
        PacketWindow window;
        for (std::uint64_t number = 1; number <= 3000; ++number)
            window.note(number);
        window.note(3000 + 2048); // the same places a turn later: all but the newest are new
        for (std::uint64_t number = 3000 + 2048 - 1024; number < 3000 + 2048; ++number)
            QVERIFY(window.isNew(number));
        window.note(1'000'000'000);
        QVERIFY(window.isNew(1'000'000'000 - 1));
        QVERIFY(!window.isNew(1'000'000'000));
    }
    void doesNotWrapAtTheEndOfTheNumbers()
    {
        constexpr auto last = ~std::uint64_t{0};
        PacketWindow window;
        window.note(last);
        QVERIFY(!window.isNew(last));
        QVERIFY(window.isNew(last - 1));
        QVERIFY(!window.isNew(5));
    }
    void agreesWithASetOfAllNumbers()
    {
        std::mt19937_64 random(42);
        PacketWindow window;
        std::set<std::uint64_t> seen;
        std::uint64_t newest = 0;
        for (int i = 0; i < 200'000; ++i) {
            const auto back = random() % 1500;
            const auto ahead = random() % 100 == 0 ? random() % 5000 : random() % 3;
            const auto number = newest + ahead > back ? newest + ahead - back : 1;
            const bool expected = number + 1024 >= newest && !seen.contains(number);
            QCOMPARE(window.isNew(number), expected);
            if (!expected)
                continue;
            window.note(number);
            seen.insert(number);
            newest = std::max(newest, number);
        }
    }
};

QTEST_APPLESS_MAIN(PacketWindowTest)
#include "packet_window_test.moc"
