// Starting the system, and the ways of a hand on the window.
#include "theatre.hpp"

#include "app/preference_store.hpp"

#include <QApplication>
#include <QDeadlineTimer>
#include <QTest>

#include <algorithm>
#include <stdexcept>

namespace console::test {

using liena::test::ChildProcess;
namespace reference = liena::test::reference;

namespace {

/// With the titles that people know, as in topologies/cerebrovascular.xml.
std::vector<liena::test::DeviceSpec> devicesOf(const Theatre::Wishes& wishes)
{
    const auto titled = [](liena::test::DeviceSpec spec, const std::string& title, const std::string& site) {
        spec.place = "title=\"" + title + "\" site=\"" + site + "\"";
        return spec;
    };
    std::vector<liena::test::DeviceSpec> devices{titled(reference::cockpit, wishes.title, "surgeon"),
                                                 titled(reference::robot, "Vascular robot", "patient"),
                                                 titled(reference::xray, "C-arm X-ray", "patient")};
    devices[1].host = wishes.robotHost;
    if (wishes.arm)
        devices.push_back(titled(reference::arm, "Robotic arm", "patient"));
    if (wishes.rival)
        devices.push_back(titled({"cockpit-2", "0x40018209", reference::cockpit.set}, "Second cockpit", "surgeon"));
    if (wishes.secondXray)
        devices.push_back(titled({"xray-2", "0x20010209", reference::xray.set}, "Second C-arm", "patient"));
    return devices;
}

std::vector<std::string> linksOf(const Theatre::Wishes& wishes)
{
    const auto pictures = wishes.pictureTiming.empty() ? std::string() : '|' + wishes.pictureTiming;
    std::vector<std::string> links{"cockpit robot", "cockpit xray" + pictures, "xray robot" + pictures};
    if (wishes.arm)
        links.insert(links.end(), {"cockpit arm", "arm robot"});
    if (wishes.rival)
        links.push_back("cockpit-2 robot");
    if (wishes.secondXray)
        links.push_back("cockpit xray-2");
    return links;
}

Options optionsOf(liena::test::TestSystem& files, const Theatre::Wishes& wishes)
{
    const auto text = [](const std::filesystem::path& path) { return QString::fromStdString(path.string()); };
    auto options = cockpitOptions(files);
    options.alarmLog = text(files.folder() / "alarms");
    options.preferences = text(files.folder() / "preferences.ini");
    options.watchdog = wishes.watchdog;
    options.player = wishes.player;
    options.size = wishes.window;
    options.profile = wishes.profile;
    options.master = wishes.master;
    options.user = wishes.user;
    return options;
}

} // namespace

Options cockpitOptions(liena::test::TestSystem& files)
{
    const auto settings = files.settingsOf("cockpit");
    const auto text = [](const std::filesystem::path& path) { return QString::fromStdString(path.string()); };
    Options options;
    options.topology = text(settings.topology);
    options.device = QStringLiteral("cockpit");
    options.registry = {text(settings.registry.front())};
    options.store = text(settings.store);
    options.certificate = text(settings.certificate);
    options.key = text(settings.key);
    options.authority = text(settings.authority);
    return options;
}

Theatre::Theatre(const Wishes& wishes) : files(devicesOf(wishes), linksOf(wishes), wishes.system), m_wishes(wishes)
{
    if (wishes.devices) {
        robot = start("robot");
        if (wishes.arm)
            armDevice = start("arm");
        xray = start("xray", {QStringLiteral("--size"), QString::number(wishes.pictureSize)});
    }
    startConsole();
}

void Theatre::startConsole()
{
    const auto options = optionsOf(files, m_wishes);
    if (const auto trouble = PreferenceStore(options.preferences).write(m_wishes.preferences); !trouble.isEmpty())
        throw std::runtime_error(trouble.toStdString());
    cockpit = std::make_unique<CockpitApplication>(options);
    if (m_wishes.voice != nullptr)
        cockpit->setVoice(*m_wishes.voice);
    if (!m_wishes.remoteInput.isEmpty())
        cockpit->setInputOrigin(m_wishes.remoteInput);
    if (!m_wishes.seat.system.isEmpty())
        cockpit->setSeat(m_wishes.seat);
    QString error;
    if (!cockpit->prepare(&error))
        throw std::runtime_error(error.toStdString());
    cockpit->show();
}

void Theatre::restartConsole()
{
    cockpit.reset();
    startConsole();
}

std::unique_ptr<ChildProcess> Theatre::start(const std::string& role, const QStringList& options)
{
    auto process = std::make_unique<ChildProcess>(QStringLiteral("liena-device"),
                                                  QStringList{QString::fromStdString(role)} + files.argumentsOf(role) + options);
    if (!process->waitForLine(QStringLiteral("listening on")))
        throw std::runtime_error(process->output().toStdString());
    return process;
}

QAbstractButton* Theatre::button(const QString& text, const QWidget* within) const
{
    const QWidget* place = within != nullptr ? within : &cockpit->window();
    for (auto* candidate : place->findChildren<QAbstractButton*>())
        if (candidate->isVisible() && candidate->text().remove(QLatin1Char('&')).startsWith(text))
            return candidate;
    return nullptr;
}

bool Theatre::click(const QString& text, const QWidget* within)
{
    QAbstractButton* found = nullptr;
    if (!QTest::qWaitFor([&] { return (found = button(text, within)) != nullptr && found->isEnabled(); }, patience))
        return false;
    QTest::mouseClick(found, Qt::LeftButton);
    return true;
}

bool Theatre::openAll()
{
    if (!QTest::qWaitForWindowActive(&window()))
        return false;
    strike(Qt::Key_F2);
    if (!click(QStringLiteral("Open all")) || !QTest::qWaitFor([this] { return models().sessions.allOpen(); }, patience))
        return false;
    strike(Qt::Key_F1);
    return true;
}

QWidget* Theatre::keyTarget()
{
    auto* focus = QApplication::focusWidget();
    return focus != nullptr ? focus : &window();
}

void Theatre::hold(int key) { QTest::keyPress(keyTarget(), static_cast<Qt::Key>(key)); }

void Theatre::release(int key) { QTest::keyRelease(keyTarget(), static_cast<Qt::Key>(key)); }

void Theatre::strike(int key)
{
    hold(key);
    release(key);
}

void Theatre::releaseAll()
{
    for (const int key : {Qt::Key_Up, Qt::Key_D, Qt::Key_R, Qt::Key_G, Qt::Key_F})
        release(key);
}

bool Theatre::reaches(PermitPhase wanted, int time)
{
    return QTest::qWaitFor([&] { return phase() == wanted; }, time);
}

Theatre::Hand Theatre::keyboardHand()
{
    return {[this] { hold(Qt::Key_D); }, [this] { hold(Qt::Key_Up); }, [] {}};
}

bool Theatre::readyOnce(const Hand& hand)
{
    releaseAll();
    hand.letGo();
    // Without pictures the permit is back at its conditions; one that is still there from before would be armed on a run that just begins.
    const auto isBack = [this] { return phase() < PermitPhase::Ready || phase() > PermitPhase::Engaged; };
    if (!QTest::qWaitFor(isBack, patience))
        return false;
    acknowledgeAlarms();
    readAccount();
    const auto run = [this] {
        const auto& newest = models().picture.newest();
        return newest ? std::optional(newest->acquisition) : std::nullopt;
    };
    const auto before = run();
    hold(Qt::Key_F); // pictures must be live for a second, which passes while the alarms are tested
    testAlarms();
    hold(Qt::Key_F); // unheard before where the keys were elsewhere: a click on the test gives them back to the hand
    // What was still on its way of the run before is live as that was, until the first picture of this one and the next look at it.
    if (!QTest::qWaitFor([&] { return run() != before; }, patience))
        return false;
    const auto begun = std::chrono::steady_clock::now();
    const auto isReady = [&] { return phase() == PermitPhase::Ready && models().permit.state().since > begun; };
    return QTest::qWaitFor(isReady, patience);
}

bool Theatre::armOnce(const Hand& hand)
{
    if (!readyOnce(hand))
        return false;
    hold(Qt::Key_R);
    const bool armed = reaches(PermitPhase::Armed);
    release(Qt::Key_R);
    return armed;
}

bool Theatre::makeReady()
{
    const QDeadlineTimer deadline(3 * patience);
    while (!readyOnce(keyboardHand()))
        if (deadline.hasExpired())
            return false;
    return true;
}

bool Theatre::arm()
{
    const QDeadlineTimer deadline(3 * patience);
    while (!armOnce(keyboardHand()))
        if (deadline.hasExpired())
            return false;
    return true;
}

bool Theatre::armAndMove(const Hand& hand)
{
    const QDeadlineTimer deadline(3 * patience);
    if (!QTest::qWaitFor([this] { return models().instrument.robot().known(); }, patience))
        return false; // a place that is not known yet is none to have moved from
    const auto before = robotStatus().guidewirePosition;
    const auto moved = [&] { return phase() == PermitPhase::Engaged && robotStatus().guidewirePosition > before + 0.5; };
    while (!moved()) {
        if (deadline.hasExpired())
            return false;
        if (!armOnce(hand))
            continue;
        hand.press();
        if (!reaches(PermitPhase::Engaged))
            continue;
        hand.move();
        (void)QTest::qWaitFor([&] { return moved() || phase() != PermitPhase::Engaged; }, patience);
    }
    return true;
}

bool Theatre::heldByThisComputer() const
{
    const QStringList late{word(HoldCause::Stalled), word(HoldCause::GateClosed), QStringLiteral("Picture"),
                           QStringLiteral("No recent robot report")};
    const auto isLate = [&late](const QString& reason) {
        return std::any_of(late.begin(), late.end(), [&reason](const QString& one) { return reason.startsWith(one); });
    };
    const auto& reasons = models().permit.holdReasons();
    return !mayMove() && !reasons.isEmpty() && std::all_of(reasons.begin(), reasons.end(), isLate);
}

void Theatre::testAlarms()
{
    const auto& test = models().selfTest;
    auto* begin = button(QStringLiteral("Alarm self-test"));
    if (begin == nullptr)
        return;
    QTest::mouseClick(begin, Qt::LeftButton);
    if (!m_wishes.listens)
        cockpit->skipTestSignals();
    if (!QTest::qWaitFor([&] { return !test.signal().has_value(); }, patience))
        return;
    if (auto* right = button(QStringLiteral("Test seen")); right != nullptr)
        QTest::mouseClick(right, Qt::LeftButton);
}

void Theatre::readAccount()
{
    if (models().interruption.settled())
        return;
    QAbstractButton* read = nullptr; // comes when stand-by has ended, which is told after the last incident's end
    if (QTest::qWaitFor([&] { return (read = button(QStringLiteral("I have read this"))) != nullptr && read->isEnabled(); }))
        QTest::mouseClick(read, Qt::LeftButton);
}

void Theatre::acknowledgeAlarms()
{
    constexpr int most = 16;
    for (int i = 0; i < most && models().alarms.unacknowledgedHigh(); ++i)
        if (auto* acknowledge = button(QStringLiteral("Acknowledge")); acknowledge != nullptr && acknowledge->isEnabled())
            QTest::mouseClick(acknowledge, Qt::LeftButton);
}

QString Theatre::story() const
{
    constexpr std::size_t most = 20; // a failure's text is cut at about a thousand letters
    QString text = word(phase()) + QStringLiteral(": ") + models().permit.unmetText(9) + QLatin1Char('\n');
    for (const auto& alarm : models().alarms.alarms())
        text += word(alarm.priority) + QStringLiteral(": ") + alarm.text + QLatin1Char('\n');
    const auto& lines = models().log.lines();
    for (std::size_t i = lines.size() - std::min(most, lines.size()); i < lines.size(); ++i)
        text += lines[i].text + QLatin1Char('\n');
    return text;
}

} // namespace console::test
