// The command line, and where the program's own files are.
#include "app/command_line.hpp"

#include "app/language.hpp"
#include "app/preference_store.hpp"

#include <QCommandLineParser>
#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QMap>
#include <QStandardPaths>

#include <cmath>

namespace console {

namespace {

const char* const description =
    R"(The surgeon's console: opens sessions with the devices of a robotic system, shows the live picture and the
robot, and lets a surgeon move it. A research system, not a medical device.

A first try, with the reference devices running on this computer:
  liena-console --topology topologies/cerebrovascular.xml
      --certificate pki/cockpit.crt --key pki/cockpit.key --authority pki/ca.crt

On the screen: F2, then "Open all". Hold F for pictures. "Alarm self-test" (F8) at the top, before each arming: three
colours and three sounds, then say whether they were there. With F down, hold R for 1.5 s to arm; then motion lasts while
F and D are held: up/down and right/left for the guidewire, I/K and J/L for the catheter. Letting go of D stops, and so does
letting go of F. F9 pauses the alarm sound for a minute, F12 holds, Esc is the emergency stop; U, held for 1.5 s, resets it.
After any interruption motion needs a new ARM.

Without a screen: QT_QPA_PLATFORM=offscreen liena-console --unattended 10 --report run.json ...)";

QString defaultAlarmLog() { return QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation) + QStringLiteral("/alarms"); }

struct Declared {
    QCommandLineParser parser;
    QCommandLineOption topology{QStringLiteral("topology"), QStringLiteral("The system's topology file, the same bytes on every device."),
                                QStringLiteral("FILE")};
    QCommandLineOption device{
        QStringLiteral("device"),
        QStringLiteral("This console in the topology, by name or id. Default: the device with the message set siat-cockpit."),
        QStringLiteral("NAME")};
    QCommandLineOption certificate{QStringLiteral("certificate"), QStringLiteral("This device's certificate, PEM."),
                                   QStringLiteral("FILE")};
    QCommandLineOption key{QStringLiteral("key"), QStringLiteral("Its private key, PEM."), QStringLiteral("FILE")};
    QCommandLineOption authority{QStringLiteral("authority"), QStringLiteral("The site's certificate authority, PEM."),
                                 QStringLiteral("FILE")};
    QCommandLineOption registry{QStringLiteral("registry"),
                                QStringLiteral("Folder with message sets; may be repeated. Default: the register that comes with LiENa."),
                                QStringLiteral("FOLDER")};
    QCommandLineOption store{QStringLiteral("store"), QStringLiteral("Folder for message sets learnt from peers."),
                             QStringLiteral("FOLDER")};
    QCommandLineOption profile{
        QStringLiteral("profile"),
        QStringLiteral("How old a picture may be while instruments move: neuro (250 ms, default) or coronary (400 ms)."),
        QStringLiteral("NAME"), QStringLiteral("neuro")};
    QCommandLineOption user{QStringLiteral("operator"), QStringLiteral("Name of the person, for the screen and the log."),
                            QStringLiteral("NAME")};
    QCommandLineOption role{QStringLiteral("role"),
                            QStringLiteral("operator (default), or observer: sees everything, opens links and stops the robot, but arms "
                                           "nothing, gives no beam and resets no stop."),
                            QStringLiteral("NAME"), QStringLiteral("operator")};
    QCommandLineOption patient{QStringLiteral("patient"),
                               QStringLiteral("The patient's name, for the screen and saved DICOM pictures; needs --patient-id."),
                               QStringLiteral("NAME")};
    QCommandLineOption patientId{QStringLiteral("patient-id"),
                                 QStringLiteral("The patient's number, for the screen and saved DICOM pictures; needs --patient."),
                                 QStringLiteral("ID")};
    QCommandLineOption master{
        QStringLiteral("master"),
        QStringLiteral("What the hand moves by at the start: keyboard (default), spacemouse, gamepad, haptic-simulated, or recorded, "
                       "which needs --recording. Others that are there can be chosen in the window while nothing is armed."),
        QStringLiteral("NAME"), QStringLiteral("keyboard")};
    QCommandLineOption recording{
        QStringLiteral("recording"),
        QStringLiteral(
            "Recorded hand (time,x,y,z,buttons) to move by while the dead-man is held; is --master recorded, if no other is named."),
        QStringLiteral("FILE")};
    QCommandLineOption vessels{QStringLiteral("vessels"), QStringLiteral("Vessel tree for the 3-D scene, SWC."), QStringLiteral("FILE")};
    QCommandLineOption alarmLog{
        QStringLiteral("alarm-log"),
        QStringLiteral(
            "Folder of the alarm log: the last 2000 entries at least (fewer where they are very long), kept over a loss of power. "
            "Default: %1.")
            .arg(defaultAlarmLog()),
        QStringLiteral("FOLDER")};
    QCommandLineOption pictures{
        QStringLiteral("pictures"),
        QStringLiteral("Folder for saved pictures. Default: that of the preferences (Ctrl+,), else liena in the person's folder of "
                       "pictures."),
        QStringLiteral("FOLDER")};
    QCommandLineOption preferences{
        QStringLiteral("preferences"),
        QStringLiteral("File of the person's preferences (Ctrl+,); other options win over it. Default: %1; an unattended run has none.")
            .arg(preferenceFile()),
        QStringLiteral("FILE")};
    QCommandLineOption display{
        QStringLiteral("display"),
        QStringLiteral("The primary screen's measured light, for the grey scale of DICOM PS3.14: lines `level luminance`, "
                       "0 and 255 among them, and `ambient luminance`."),
        QStringLiteral("FILE")};
    QCommandLineOption rehearsal{
        QStringLiteral("rehearsal"),
        QStringLiteral("A recorded picture may stand for the live one. The screen says so. Only where every linked robot is at a loopback "
                       "address: what stands elsewhere may be a real one.")};
    QCommandLineOption measureOnRequest{QStringLiteral("measure-on-request"),
                                        QStringLiteral("Let `liena bench --live` of this user measure the lines of this console.")};
    QCommandLineOption realTimePriority{QStringLiteral("realtime-priority"),
                                        QStringLiteral("SCHED_FIFO priority of the network thread, 1 to 99. Default: none."),
                                        QStringLiteral("N")};
    QCommandLineOption processors{QStringLiteral("processors"),
                                  QStringLiteral("Processors that the network thread may use, as 2,3. Default: all."),
                                  QStringLiteral("LIST")};
    QCommandLineOption lockMemory{QStringLiteral("lock-memory"), QStringLiteral("Keep all memory of the console from being swapped.")};
    QCommandLineOption cardPoll{
        QStringLiteral("card-poll"),
        QStringLiteral("Microseconds that the kernel asks the network card before the network thread sleeps. Default: 0."),
        QStringLiteral("US")};
    QCommandLineOption busyPoll{
        QStringLiteral("busy-poll"),
        QStringLiteral("Microseconds that the network thread looks for work before it sleeps; costs a processor. Default: 0."),
        QStringLiteral("US")};
    QCommandLineOption markCommands{
        QStringLiteral("mark-commands"),
        QStringLiteral("DSCP (RFC 2474) of what is prompt: 0 to 63, 0 for none. Default: 46, expedited forwarding."), QStringLiteral("N")};
    QCommandLineOption markImages{QStringLiteral("mark-images"),
                                  QStringLiteral("DSCP of images that this console sends: 0 to 63, 0 for none. Default: 34, AF41."),
                                  QStringLiteral("N")};
    QCommandLineOption language{
        QStringLiteral("language"),
        QStringLiteral(
            "Language of the screen: %1. Default: the person's preference (Ctrl+,), else the system's where it is one of them, else en; "
            "en with --unattended.")
            .arg(languages().join(QStringLiteral(" or "))),
        QStringLiteral("NAME")};
    QCommandLineOption size{QStringLiteral("size"), QStringLiteral("Window size instead of the whole screen, for example 2560x1440."),
                            QStringLiteral("WxH")};
    QCommandLineOption unattended{
        QStringLiteral("unattended"),
        QStringLiteral("Operates the console by itself: confirms the alarm self-test, opens every session, takes pictures, arms, moves for "
                       "that time by the recorded hand, stops. Status 0 only if all of it worked. For test systems only: it moves the "
                       "robot without a person."),
        QStringLiteral("SECONDS")};
    QCommandLineOption report{QStringLiteral("report"), QStringLiteral("With --unattended: writes what was measured, JSON."),
                              QStringLiteral("FILE")};
    QCommandLineOption screenshot{QStringLiteral("screenshot"), QStringLiteral("With --unattended: writes the window at the end, PNG."),
                                  QStringLiteral("FILE")};
    QCommandLineOption help{{QStringLiteral("h"), QStringLiteral("help")}, QStringLiteral("Shows this text.")};
    QCommandLineOption version{{QStringLiteral("v"), QStringLiteral("version")}, QStringLiteral("Shows the version.")};

    Declared()
    {
        parser.setApplicationDescription(QString::fromUtf8(description));
        parser.addOptions({topology, device,     certificate, key,      authority,        registry,   store,     profile, user,
                           master,   recording,  vessels,     alarmLog, pictures,         display,    rehearsal, size,    unattended,
                           report,   screenshot, help,        version,  measureOnRequest, preferences});
        parser.addOptions({language, role, patient, patientId});
        parser.addOptions({realTimePriority, processors, lockMemory, cardPoll, busyPoll, markCommands, markImages});
    }
};

CommandLine mistake(const QString& text) { return {CommandLine::Outcome::Mistake, {}, text + QStringLiteral(" (--help shows how)")}; }

std::optional<QSize> sizeFrom(const QString& text)
{
    const auto parts = text.split(QLatin1Char('x'));
    bool wide = false;
    bool high = false;
    if (parts.size() != 2)
        return std::nullopt;
    const QSize size(parts[0].toInt(&wide), parts[1].toInt(&high));
    const bool possible = size.width() >= 800 && size.height() >= 450 && size.width() <= 16384 && size.height() <= 16384;
    return wide && high && possible ? std::optional<QSize>(size) : std::nullopt;
}

QString readMaster(const Declared& declared, Options& options)
{
    static const QMap<QString, MasterKind> names{{QStringLiteral("keyboard"), MasterKind::Keyboard},
                                                 {QStringLiteral("spacemouse"), MasterKind::SpaceMouse},
                                                 {QStringLiteral("gamepad"), MasterKind::GamePad},
                                                 {QStringLiteral("haptic-simulated"), MasterKind::HapticSimulated},
                                                 {QStringLiteral("recorded"), MasterKind::Recorded}};
    const auto name = declared.parser.value(declared.master);
    if (!names.contains(name))
        return QStringLiteral("--master '%1': choose keyboard, spacemouse, gamepad, haptic-simulated or recorded").arg(name);
    const bool byItself = declared.parser.isSet(declared.unattended);
    const bool recorded = byItself || !options.recording.isEmpty();
    options.master = declared.parser.isSet(declared.master) ? names.value(name) : recorded ? MasterKind::Recorded : MasterKind::Keyboard;
    if (options.master == MasterKind::Recorded && !recorded)
        return QStringLiteral("--master recorded: name the recording with --recording FILE");
    if (options.master != MasterKind::Recorded && byItself)
        return QStringLiteral("--master %1: with --unattended only a recorded hand moves").arg(name);
    return {};
}

QString readUnattended(const Declared& declared, Options& options)
{
    const auto& parser = declared.parser;
    if (!parser.isSet(declared.unattended)) {
        const bool alone = parser.isSet(declared.report) || parser.isSet(declared.screenshot);
        return alone ? QStringLiteral("--report and --screenshot belong to --unattended") : QString();
    }
    UnattendedSettings settings;
    bool good = false;
    settings.jogSeconds = parser.value(declared.unattended).toDouble(&good);
    if (!good || !std::isfinite(settings.jogSeconds) || settings.jogSeconds < 1 || settings.jogSeconds > 86400)
        return QStringLiteral("--unattended '%1': give 1 to 86400 seconds").arg(parser.value(declared.unattended));
    settings.report = parser.value(declared.report);
    settings.screenshot = parser.value(declared.screenshot);
    options.unattended = settings;
    if (!parser.isSet(declared.preferences))
        options.preferences.clear(); // what it measures does not depend on who starts it
    return {};
}

QString readPeople(const Declared& declared, Options& options)
{
    const auto& parser = declared.parser;
    options.user = parser.value(declared.user);
    const auto role = parser.value(declared.role);
    if (role != QLatin1String("operator") && role != QLatin1String("observer"))
        return QStringLiteral("--role '%1': choose operator or observer").arg(role);
    options.role = role == QLatin1String("operator") ? OperatorRole::Operator : OperatorRole::Observer;
    if (options.role == OperatorRole::Observer && parser.isSet(declared.unattended))
        return QStringLiteral("--role observer: an unattended run arms; leave one of the two out");
    options.patient = parser.value(declared.patient);
    options.patientId = parser.value(declared.patientId);
    if (options.patient.isEmpty() != options.patientId.isEmpty())
        return QStringLiteral("--patient and --patient-id belong together: a patient is named by two identifiers");
    constexpr int most = 32; // characters; it is shown whole, whatever stands beside it
    if (options.patientId.size() > most)
        return QStringLiteral("--patient-id: %1 characters, at most %2 can be shown whole").arg(options.patientId.size()).arg(most);
    return {};
}

/// Leaves `value` alone where the option was not given.
QString readNumber(const Declared& declared, const QCommandLineOption& option, int least, int most, int& value)
{
    if (!declared.parser.isSet(option))
        return {};
    bool good = false;
    const auto text = declared.parser.value(option);
    value = text.toInt(&good);
    return good && value >= least && value <= most
               ? QString()
               : QStringLiteral("--%1 '%2': give %3 to %4").arg(option.names().constFirst(), text).arg(least).arg(most);
}

QString readProcessors(const Declared& declared, QList<int>& processors)
{
    if (!declared.parser.isSet(declared.processors))
        return {};
    const auto text = declared.parser.value(declared.processors);
    for (const auto& word : text.split(QLatin1Char(','))) {
        bool good = false;
        processors.append(word.toInt(&good));
        if (!good || processors.constLast() < 0)
            return QStringLiteral("--processors '%1': give their numbers, as 2,3").arg(text);
    }
    return {};
}

QString readNetwork(const Declared& declared, NetworkSettings& network)
{
    constexpr int longest = 1'000'000;
    constexpr int highestMark = 63;
    network.lockMemory = declared.parser.isSet(declared.lockMemory);
    for (const auto& wrong :
         {readNumber(declared, declared.realTimePriority, 1, 99, network.realTimePriority), readProcessors(declared, network.processors),
          readNumber(declared, declared.cardPoll, 0, longest, network.cardPollUs),
          readNumber(declared, declared.busyPoll, 0, longest, network.busyPollUs),
          readNumber(declared, declared.markCommands, 0, highestMark, network.commandMark),
          readNumber(declared, declared.markImages, 0, highestMark, network.imageMark)})
        if (!wrong.isEmpty())
            return wrong;
    return {};
}

/// The first thing that is wrong, or nothing.
QString readOptions(const Declared& declared, Options& options)
{
    const auto& parser = declared.parser;
    if (!parser.isSet(declared.topology))
        return QStringLiteral("--topology is missing: name the system's topology file");
    options.topology = parser.value(declared.topology);
    options.device = parser.value(declared.device);
    options.registry = parser.values(declared.registry);
    options.store = parser.value(declared.store);
    options.certificate = parser.value(declared.certificate);
    options.key = parser.value(declared.key);
    options.authority = parser.value(declared.authority);
    options.recording = parser.value(declared.recording);
    options.alarmLog = parser.isSet(declared.alarmLog) ? parser.value(declared.alarmLog) : defaultAlarmLog();
    if (options.alarmLog.isEmpty())
        return QStringLiteral("--alarm-log is empty: name a folder");
    options.watchdog = QCoreApplication::applicationDirPath() + QStringLiteral("/liena-console-watchdog");
    options.player = QCoreApplication::applicationDirPath() + QStringLiteral("/liena-console-player");
    options.vessels = parser.value(declared.vessels);
    options.pictures = parser.value(declared.pictures);
    options.display = parser.value(declared.display);
    options.preferences = parser.isSet(declared.preferences) ? parser.value(declared.preferences) : preferenceFile();
    options.rehearsal = parser.isSet(declared.rehearsal);
    options.measureOnRequest = parser.isSet(declared.measureOnRequest);
    const auto profile = parser.value(declared.profile);
    if (profile != QLatin1String("neuro") && profile != QLatin1String("coronary"))
        return QStringLiteral("--profile '%1': choose neuro or coronary").arg(profile);
    options.profile = profile == QLatin1String("neuro") ? PictureProfile::Neuro : PictureProfile::Coronary;
    if (parser.isSet(declared.language)) {
        options.language = parser.value(declared.language);
        if (!languages().contains(options.language))
            return QStringLiteral("--language '%1': choose %2").arg(options.language, languages().join(QStringLiteral(" or ")));
    }
    if (parser.isSet(declared.size)) {
        options.size = sizeFrom(parser.value(declared.size));
        if (!options.size)
            return QStringLiteral("--size '%1': write WIDTHxHEIGHT, at least 800x450").arg(parser.value(declared.size));
    }
    if (const auto wrong = readPeople(declared, options); !wrong.isEmpty())
        return wrong;
    if (const auto wrong = readNetwork(declared, options.network); !wrong.isEmpty())
        return wrong;
    if (const auto wrong = readMaster(declared, options); !wrong.isEmpty())
        return wrong;
    return readUnattended(declared, options);
}

/// Where an installation beside this program has `name`.
QString installed(const QString& name) { return QCoreApplication::applicationDirPath() + QStringLiteral("/../share/") + name; }

/// The first of them that exists; empty when none does.
QString firstOf(const QString& one, const QString& other)
{
    for (const auto& place : {one, other})
        if (QFileInfo::exists(place))
            return QDir::cleanPath(place);
    return {};
}

} // namespace

CommandLine readCommandLine(const QStringList& arguments)
{
    Declared declared;
    if (!declared.parser.parse(arguments))
        return mistake(declared.parser.errorText());
    if (declared.parser.isSet(declared.help))
        return {CommandLine::Outcome::Help, {}, declared.parser.helpText()};
    if (declared.parser.isSet(declared.version))
        return {CommandLine::Outcome::Version, {}, QStringLiteral("liena-console %1\n").arg(QCoreApplication::applicationVersion())};
    if (!declared.parser.positionalArguments().isEmpty())
        return mistake(QStringLiteral("'%1' is not an option").arg(declared.parser.positionalArguments().constFirst()));
    CommandLine line;
    const auto wrong = readOptions(declared, line.options);
    return wrong.isEmpty() ? line : mistake(wrong);
}

QString resource(const QString& name)
{
    return firstOf(installed(QStringLiteral("liena/") + name), QStringLiteral(LIENA_RESOURCE_DIR "/") + name);
}

QString guide()
{
    const auto page = QStringLiteral("console/GUIDE.md");
    const auto found = firstOf(installed(QStringLiteral("doc/liena/") + page), QStringLiteral(LIENA_RESOURCE_DIR "/../") + page);
    const auto here = QDir::current().relativeFilePath(found);
    return found.isEmpty() || here.startsWith(QStringLiteral("..")) ? found : here;
}

} // namespace console
