// The stage of the tests of what must never be possible: the console's own window, with a robot and an X-ray system that lie.
#pragma once

#include "puppet_theatre.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/stop_button.hpp"
#include "widgets/theme.hpp"

#include <QAbstractSlider>
#include <QApplication>
#include <QDeadlineTimer>
#include <QPointer>
#include <QTest>

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

namespace console::test {

struct NeverStage : PuppetTheatre {
    static constexpr int patience = Theatre::patience;

    using PuppetTheatre::PuppetTheatre;

    std::unique_ptr<QWidget> other; ///< another window, in front

    bool open() { return theatre.openAll(); }
    PermitPhase phase() const { return theatre.phase(); }
    bool mayMove() const { return theatre.mayMove(); }

    /// Waits until it is so, or motion has ended. Whether it is so and motion goes on.
    template <typename Condition>
    bool whileItMayMove(Condition condition)
    {
        return QTest::qWaitFor([&] { return condition() || !mayMove(); }, patience) && condition() && mayMove();
    }

    /// Makes the attempt, which sets what it is given at its end, again where motion ended before: a busy computer paints too late, or
    /// stands still. What must never be is looked for each time. Whether one came to its end.
    template <typename Try>
    bool tryWhileItMoves(Try attempt)
    {
        const QDeadlineTimer deadline(3 * patience);
        bool over = false;
        while (!over && !deadline.hasExpired() && !QTest::currentTestFailed())
            attempt(over);
        return over;
    }

    /// Waits for so many of the robot's turns, ten milliseconds each; false when the console was armed at any time between.
    bool staysUnarmed(std::uint64_t turns)
    {
        bool armed = mayMove();
        const auto watch = QObject::connect(
            &theatre.models().permit, &PermitModel::phaseChanged, &theatre.window(),
            [&armed](PermitPhase, PermitPhase to) { armed = armed || to == PermitPhase::Armed || to == PermitPhase::Engaged; });
        const auto begun = robot.turns();
        const bool passed = QTest::qWaitFor([&] { return robot.turns() >= begun + turns; }, patience);
        QObject::disconnect(watch);
        return passed && !armed;
    }

    /// A key that the keyboard repeats while it is held.
    void repeat(Qt::Key key, int times)
    {
        for (int i = 0; i < times; ++i) {
            QKeyEvent up(QEvent::KeyRelease, key, Qt::NoModifier, QString(), true);
            QCoreApplication::sendEvent(theatre.keyTarget(), &up);
            QKeyEvent down(QEvent::KeyPress, key, Qt::NoModifier, QString(), true);
            QCoreApplication::sendEvent(theatre.keyTarget(), &down);
        }
    }

    HoldButton* holdButton(const QString& name)
    {
        for (auto* button : theatre.window().findChildren<HoldButton*>())
            if (button->isVisible() && button->accessibleName().startsWith(name))
                return button;
        return nullptr;
    }

    HoldButton* arm() { return holdButton(QStringLiteral("Arm:")); }
    HoldButton* pedal() { return holdButton(QStringLiteral("X-ray pedal:")); }
    HoldButton* inject() { return holdButton(QStringLiteral("Inject contrast:")); }

    /// Waits for so many of the robot's turns; whether no further injection was asked of it.
    bool staysDry(std::uint64_t turns)
    {
        const int before = robot.injections();
        const auto begun = robot.turns();
        return QTest::qWaitFor([&] { return robot.turns() >= begun + turns; }, patience) && robot.injections() == before;
    }

    /// The hand has its keys again.
    void comeToTheFront()
    {
        theatre.window().activateWindow();
        (void)QTest::qWaitForWindowActive(&theatre.window());
        theatre.strike(Qt::Key_F1);
    }

    /// What a hand does that holds every key but ARM, and presses again what moves.
    bool nothingComesBack()
    {
        const int moved = robot.movements();
        theatre.hold(Qt::Key_F);
        theatre.hold(Qt::Key_D);
        theatre.hold(Qt::Key_Up);
        if (!staysUnarmed(150))
            return false;
        theatre.release(Qt::Key_D);
        theatre.hold(Qt::Key_D);
        return staysUnarmed(50) && robot.movements() == moved;
    }

    /// Waits until what was under way when motion ended has arrived: a command lives no longer.
    bool settles()
    {
        const auto ended = robot.turns();
        return QTest::qWaitFor([&] { return robot.turns() > ended + 10; }, patience);
    }
};

/// The one that all slots of a test share, its channels open; null when they do not open.
inline std::unique_ptr<NeverStage> openStage(const Theatre::Wishes& wishes = puppetWishes())
{
    theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance()));
    auto stage = std::make_unique<NeverStage>(wishes);
    return stage->open() ? std::move(stage) : nullptr;
}

/// The share of the set velocity that motion may have at most, after so long of engagement.
inline double rampAt(std::chrono::nanoseconds engagedFor)
{
    const double seconds = std::chrono::duration<double>(engagedFor).count();
    return std::min(1.0, 0.25 + 0.75 * seconds / 2);
}

/// Something that is done to the cockpit, and how it is undone.
struct Attempt {
    const char* name;
    void (*make)(NeverStage&);
    void (*undo)(NeverStage&);
};

inline void addRows(const std::vector<Attempt>& attempts)
{
    QTest::addColumn<int>("number");
    for (std::size_t i = 0; i < attempts.size(); ++i)
        QTest::newRow(attempts[i].name) << int(i);
}

/// What a person can press or turn, but the robot's own: those that are held, and the stop.
inline std::vector<QPointer<QWidget>> controlsOf(const QWidget& window)
{
    std::vector<QPointer<QWidget>> found;
    for (auto* widget : window.findChildren<QWidget*>()) {
        const bool control = qobject_cast<QAbstractButton*>(widget) != nullptr || qobject_cast<QAbstractSlider*>(widget) != nullptr;
        const bool own = qobject_cast<HoldButton*>(widget) != nullptr || qobject_cast<StopButton*>(widget) != nullptr;
        if (control && !own && widget->isVisible() && widget->isEnabled())
            found.emplace_back(widget);
    }
    return found;
}

inline bool logTells(const Theatre& theatre, const QString& start)
{
    const auto& lines = theatre.models().log.lines();
    return std::any_of(lines.begin(), lines.end(), [&start](const LogLine& line) { return line.text.startsWith(start); });
}

} // namespace console::test
