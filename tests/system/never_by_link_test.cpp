// What a link must never be able to do: give motion back when it heals by itself or is re-opened, let a device pass that is not the one it
// was opened to, or change the system that runs. Tried through the console's own window.
#include "never_possible_stage.hpp"
#include "widgets/diagnosis_sheet.hpp"

#include <QApplication>
#include <QFile>
#include <QLabel>
#include <QScopeGuard>

using namespace console;
using console::test::Theatre;
using liena::test::ChildProcess;
using Stage = console::test::NeverStage;

namespace {

constexpr int patience = Theatre::patience;

/// The states that one link went through since this began.
class LinkHistory {
public:
    LinkHistory(Theatre& theatre, const std::string& name)
        : m_watch(QObject::connect(&theatre.models().sessions, &SessionModel::linkStateChanged, &theatre.window(),
                                   [this, id = theatre.files.idOf(name).value()](quint32 peer, LinkState, LinkState to) {
                                       if (peer == id)
                                           m_states.push_back(to);
                                   }))
    {}
    ~LinkHistory() { QObject::disconnect(m_watch); }
    Q_DISABLE_COPY_MOVE(LinkHistory)

    bool has(LinkState state) const { return std::find(m_states.begin(), m_states.end(), state) != m_states.end(); }

private:
    std::vector<LinkState> m_states;
    QMetaObject::Connection m_watch;
};

QByteArray bytesOf(const std::filesystem::path& path)
{
    QFile file(QString::fromStdString(path.string()));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

bool write(const std::filesystem::path& path, const QByteArray& bytes)
{
    QFile file(QString::fromStdString(path.string()));
    return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size();
}

DiagnosisSheet* sheetOf(Theatre& theatre)
{
    auto* sheet = theatre.window().findChild<DiagnosisSheet*>();
    return sheet != nullptr && sheet->isVisible() ? sheet : nullptr;
}

/// The reason of the last re-opening that failed, as the sheet shows it; empty when it shows none. Others' incidents of the same loss may
/// be told before the own.
QString reasonOn(Theatre& theatre)
{
    const auto* sheet = sheetOf(theatre);
    if (sheet == nullptr)
        return {};
    for (const auto& incident : theatre.models().incidents.incidents())
        for (const auto* label : sheet->findChildren<QLabel*>())
            if (!incident.reopenFailure.isEmpty() && label->isVisibleTo(sheet) && label->text() == incident.reopenFailure)
                return label->text();
    return {};
}

/// A robot that is another one by now, though it answers in the same place.
struct Impostor {
    const char* name;
    const char* reason; ///< a word of it
    void (*dress)(Theatre&, QStringList& options);
    void (*afterwards)(Theatre&);
};

void put(QStringList& options, const QString& option, const std::filesystem::path& value)
{
    options[options.indexOf(option) + 1] = QString::fromStdString(value.string());
}

const std::vector<Impostor>& impostors()
{
    static const std::vector<Impostor> all{
        {"another topology", "topology",
         [](Theatre& theatre, QStringList& options) {
             const auto other = theatre.files.folder() / "another.xml";
             write(other, bytesOf(theatre.files.topology()).replace("name=\"test\"", "name=\"another\""));
             put(options, QStringLiteral("--topology"), other);
         },
         [](Theatre&) {}},
        {"a certificate that was revoked", "revoked", [](Theatre&, QStringList&) {},
         [](Theatre& theatre) { theatre.files.revoke({"robot"}); }},
        {"a certificate of another authority", "certificate",
         [](Theatre& theatre, QStringList& options) {
             static liena::test::TestAuthority stranger; // its files outlive every robot
             const auto identity = stranger.identityOf(theatre.files.idOf("robot"), "robot");
             put(options, QStringLiteral("--certificate"), identity.certificate);
             put(options, QStringLiteral("--key"), identity.key);
             put(options, QStringLiteral("--authority"), identity.authority);
         },
         [](Theatre&) {}},
    };
    return all;
}

Theatre::Wishes robotAndXray()
{
    Theatre::Wishes wishes;
    wishes.arm = false;
    return wishes;
}

} // namespace

class NeverByLinkTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_stage = console::test::openStage();
        QVERIFY(m_stage);
    }

    void cleanupTestCase() { m_stage.reset(); }

    // Rule 1.

    void aLinkThatHealsByItselfGivesNoMotionBack_data()
    {
        QTest::addColumn<QString>("device");
        QTest::newRow("robot") << QStringLiteral("robot");
        QTest::newRow("X-ray system") << QStringLiteral("xray");
    }

    void aLinkThatHealsByItselfGivesNoMotionBack()
    {
        QFETCH(QString, device);
        Stage& stage = *m_stage;
        const auto name = device.toStdString();
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story()));
        const LinkHistory history(stage.theatre, name);
        constexpr std::chrono::milliseconds lost{1000}; // after 800; the link is given up two seconds later
        if (name == "robot")
            stage.robot.standStill(lost);
        else
            stage.xray.standStill(lost);
        QTRY_VERIFY2_WITH_TIMEOUT(history.has(LinkState::Reconnecting), qPrintable(stage.theatre.story()), patience);
        const int moved = stage.robot.movements();
        QTRY_VERIFY2_WITH_TIMEOUT(stage.theatre.link(name) == LinkState::Open, qPrintable(stage.theatre.story()), patience);
        QVERIFY2(!history.has(LinkState::StandBy), qPrintable(stage.theatre.story())); // nobody re-opened it
        QVERIFY2(stage.nothingComesBack(), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.movements(), moved);
        stage.theatre.releaseAll();
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story())); // a new ARM does
        stage.theatre.releaseAll();
    }

    // Rules 1 and 8.

    /// ARM is held while the channel is re-opened, and then while the account of it is read.
    void armThatIsHeldThroughAReopeningArmsNothing()
    {
        Stage& stage = *m_stage;
        Theatre& theatre = stage.theatre;
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        stage.robot.standStill(std::chrono::milliseconds(4000));
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.link("robot") == LinkState::StandBy && sheetOf(theatre) != nullptr, qPrintable(theatre.story()),
                                  patience);
        const int moved = stage.robot.movements();
        const int asked = stage.robot.armRequests();
        theatre.hold(Qt::Key_R);
        const auto reopened = [&theatre] {
            if (auto* reopen = theatre.button(QStringLiteral("Re-open channel"), sheetOf(theatre));
                reopen != nullptr && reopen->isEnabled())
                QTest::mouseClick(reopen, Qt::LeftButton); // as often as the robot does not answer yet
            return theatre.link("robot") == LinkState::Open;
        };
        QTRY_VERIFY2_WITH_TIMEOUT(reopened(), qPrintable(theatre.story()), patience);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.models().incidents.empty(), qPrintable(theatre.story()), patience);
        theatre.strike(Qt::Key_F1);
        theatre.hold(Qt::Key_R);
        stage.repeat(Qt::Key_R, 50);
        QVERIFY2(stage.nothingComesBack(), qPrintable(theatre.story()));

        theatre.releaseAll();
        theatre.acknowledgeAlarms();
        theatre.testAlarms();
        theatre.hold(Qt::Key_F);
        const auto& permit = theatre.models().permit;
        QTRY_VERIFY2_WITH_TIMEOUT(permit.unmetCount() == 1 && !permit.checklist().at(std::size_t(Guard::InterruptionRead)).met,
                                  qPrintable(theatre.story()), patience);
        theatre.hold(Qt::Key_R);
        theatre.readAccount();
        stage.repeat(Qt::Key_R, 50);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.models().interruption.settled(), qPrintable(theatre.story()), patience);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(theatre.story()));
        QCOMPARE(stage.robot.armRequests(), asked);
        QCOMPARE(stage.robot.movements(), moved);
        theatre.releaseAll();
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story())); // and then it does
        theatre.releaseAll();
    }

    /// The second press of a double click on Open, wherever it was made.
    void whatOpensAlreadyIsNoFailedOpening()
    {
        const auto front = qScopeGuard([this] { m_stage->comeToTheFront(); });
        Theatre theatre(robotAndXray());
        const auto robot = theatre.files.idOf("robot").value();
        Q_EMIT theatre.window().openRequested(robot);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.link("robot") != LinkState::Closed, qPrintable(theatre.story()), patience);
        Q_EMIT theatre.window().openRequested(robot);
        const auto& failure = theatre.models().sessions.linkTo(robot)->failure;
        QVERIFY2(failure.isEmpty(), qPrintable(failure));
        const auto& lines = theatre.models().log.lines();
        QVERIFY2(
            std::none_of(lines.begin(), lines.end(), [](const LogLine& line) { return line.text.contains(QStringLiteral("already")); }),
            qPrintable(theatre.story()));
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.link("robot") == LinkState::Open, qPrintable(theatre.story()), patience);
    }

    // Rule 13.

    /// This console edits no topology and has nothing that applies one: its only way in is the file, which is read at the start. Tried is
    /// where a program could read it anew, at an opening and under every view; a device that was started with another file is tried below.
    void theTopologyIsReadAtTheStartAndNeverAnew()
    {
        Stage& stage = *m_stage;
        Theatre& theatre = stage.theatre;
        const auto& sessions = theatre.models().sessions;
        const auto robotId = theatre.files.idOf("robot").value();
        const auto hash = sessions.topologyHash();
        const auto before = bytesOf(theatre.files.topology());
        const auto back = qScopeGuard([&] { write(theatre.files.topology(), before); });
        auto changed = before;
        changed.replace("name=\"test\"", "name=\"another\"").replace("reconnect=\"2s\"", "reconnect=\"9s\"");
        QVERIFY(changed != before && write(theatre.files.topology(), changed));
        Q_EMIT theatre.window().closeRequested(robotId);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.link("robot") == LinkState::Closed, qPrintable(theatre.story()), patience);
        const auto opens = [&theatre, robotId] {
            if (theatre.link("robot") == LinkState::Closed)
                Q_EMIT theatre.window().openRequested(robotId);
            return theatre.link("robot") == LinkState::Open;
        };
        // The robot has the file of before, and refuses every other.
        QTRY_VERIFY2_WITH_TIMEOUT(opens(), qPrintable(theatre.story()), patience);
        QCOMPARE(sessions.topologyHash(), hash);
        const LinkHistory robot(theatre, "robot");
        const LinkHistory xray(theatre, "xray");
        for (const auto key : {Qt::Key_F6, Qt::Key_F2, Qt::Key_F6, Qt::Key_F1})
            theatre.strike(key);
        QVERIFY2(stage.staysUnarmed(100), qPrintable(theatre.story()));
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        QCOMPARE(sessions.topologyHash(), hash);
        for (const auto state : {LinkState::Reconnecting, LinkState::StandBy, LinkState::Closed})
            QVERIFY2(!robot.has(state) && !xray.has(state), qPrintable(theatre.story()));
        theatre.releaseAll();
    }

    // Rule 11.

    void thePromptLeadsToNoOtherDevice_data()
    {
        QTest::addColumn<int>("number");
        for (std::size_t i = 0; i < impostors().size(); ++i)
            QTest::newRow(impostors()[i].name) << int(i);
    }

    void thePromptLeadsToNoOtherDevice()
    {
        QFETCH(int, number);
        const auto& impostor = impostors().at(std::size_t(number));
        const auto front = qScopeGuard([this] { m_stage->comeToTheFront(); });
        Theatre theatre(robotAndXray());
        QVERIFY(theatre.openAll());
        theatre.robot->kill();
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.link("robot") == LinkState::StandBy && sheetOf(theatre) != nullptr, qPrintable(theatre.story()),
                                  patience);
        auto options = theatre.files.argumentsOf("robot");
        impostor.dress(theatre, options);
        ChildProcess robot(QStringLiteral("liena-device"), QStringList{QStringLiteral("robot")} + options);
        QVERIFY2(robot.waitForLine(QStringLiteral("listening on")), qPrintable(robot.output()));
        impostor.afterwards(theatre);
        const LinkHistory history(theatre, "robot");
        QVERIFY(theatre.click(QStringLiteral("Re-open channel"), sheetOf(theatre)));
        QTRY_VERIFY2_WITH_TIMEOUT(reasonOn(theatre).contains(QLatin1String(impostor.reason)), qPrintable(theatre.story()), patience);
        QCOMPARE(theatre.link("robot"), LinkState::StandBy);

        // Nothing on the sheet leads round it.
        for (const auto* text : {"Re-open channel", "Re-open all lost", "Run checks", "Silence", "Re-open channel"}) {
            auto* button = theatre.button(QString::fromLatin1(text), sheetOf(theatre));
            if (button == nullptr || !button->isEnabled())
                continue;
            QTest::mouseClick(button, Qt::LeftButton);
            QTRY_VERIFY2_WITH_TIMEOUT(theatre.link("robot") == LinkState::StandBy, qPrintable(theatre.story()), patience);
        }
        theatre.strike(Qt::Key_F1);
        theatre.hold(Qt::Key_F);
        theatre.hold(Qt::Key_R);
        QVERIFY(!QTest::qWaitFor([&theatre] { return theatre.phase() != PermitPhase::Incident; }, 2000)); // ARM takes 1.5 s
        QVERIFY2(!history.has(LinkState::Open), qPrintable(theatre.story()));
        theatre.releaseAll();
    }

private:
    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(NeverByLinkTest)
#include "never_by_link_test.moc"
