// The sound server is pulseaudio, and what records it parec.
#include "sound_room.hpp"

#include "sound_samples.hpp"

#include <QDeadlineTimer>
#include <QFile>
#include <QStandardPaths>
#include <QTest>

#include <sys/prctl.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>

namespace console::test {

namespace {

constexpr int patience = 30000;
constexpr std::size_t window = soundRate / 100;

void endWithTheTest(QProcess& process)
{
    process.setChildProcessModifier([] { ::prctl(PR_SET_PDEATHSIG, SIGKILL); });
}

void end(QProcess& process)
{
    if (process.state() == QProcess::NotRunning)
        return;
    process.kill();
    process.waitForFinished(patience);
}

/// What the server answers; nothing: it has not done it.
std::optional<QString> order(const QStringList& arguments)
{
    QProcess orders;
    orders.start(QStringLiteral("pactl"), arguments);
    if (!orders.waitForFinished(patience) || orders.exitStatus() != QProcess::NormalExit || orders.exitCode() != 0)
        return std::nullopt;
    return QString::fromUtf8(orders.readAllStandardOutput()).trimmed();
}

} // namespace

SoundServer::~SoundServer() { end(m_server); }

QString SoundServer::missing()
{
    for (const auto* program : {"pulseaudio", "pactl", "parec"})
        if (QStandardPaths::findExecutable(QString::fromLatin1(program)).isEmpty())
            return QStringLiteral("there is no %1 on this computer").arg(QString::fromLatin1(program));
    return {};
}

bool SoundServer::start()
{
    // Nothing of the user's own server is asked, read or written; one that is named is not started either.
    qputenv("XDG_RUNTIME_DIR", QFile::encodeName(m_folder.path()));
    qputenv("PULSE_RUNTIME_PATH", QFile::encodeName(path("runtime")));
    qputenv("PULSE_STATE_PATH", QFile::encodeName(path("state")));
    qputenv("PULSE_COOKIE", QFile::encodeName(path("cookie")));
    qputenv("PULSE_SERVER", "unix:" + QFile::encodeName(path("socket")));
    for (const auto* other : {"PULSE_SINK", "PULSE_LATENCY_MSEC", "PULSE_CLIENTCONFIG"})
        qunsetenv(other);
    auto environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("XDG_CONFIG_HOME"), m_folder.path());
    environment.insert(QStringLiteral("DBUS_SESSION_BUS_ADDRESS"), QStringLiteral("unix:path=/nowhere"));
    environment.remove(QStringLiteral("PULSE_SERVER"));
    m_server.setProcessEnvironment(environment);
    endWithTheTest(m_server);
    m_server.setStandardErrorFile(path("said"));
    m_server.start(QStringLiteral("pulseaudio"),
                   {QStringLiteral("-n"), QStringLiteral("--daemonize=no"), QStringLiteral("--exit-idle-time=-1"),
                    QStringLiteral("--disallow-exit"), QStringLiteral("--use-pid-file=no"), QStringLiteral("-L"),
                    QStringLiteral("module-native-protocol-unix auth-anonymous=1 auth-cookie-enabled=0 socket=") + path("socket")});
    if (!m_server.waitForStarted(patience))
        return false;
    const auto over = [this] { return m_server.state() == QProcess::NotRunning || order({QStringLiteral("stat")}); };
    return QTest::qWaitFor(over, patience) && m_server.state() == QProcess::Running;
}

void SoundServer::stop()
{
    end(m_server);
    m_modules.clear();
}

void SoundServer::freeze() { ::kill(static_cast<pid_t>(m_server.processId()), SIGSTOP); }
void SoundServer::thaw() { ::kill(static_cast<pid_t>(m_server.processId()), SIGCONT); }

/// It has a loudspeaker's pace, and takes the bursts as they are.
bool SoundServer::addOutput(const char* name)
{
    const auto called = QString::fromLatin1(name);
    const auto module = order({QStringLiteral("load-module"), QStringLiteral("module-null-sink"), QStringLiteral("rate=44100"),
                               QStringLiteral("channels=1"), QStringLiteral("format=s16ne"), QStringLiteral("sink_name=") + called});
    m_modules.insert(called, module.value_or(QString()));
    return module.has_value();
}

bool SoundServer::removeOutput(const char* name)
{
    return order({QStringLiteral("unload-module"), m_modules.take(QString::fromLatin1(name))}).has_value();
}

QString SoundServer::said() const
{
    QFile file(path("said"));
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

void startRecording(QProcess& recorder, const char* output)
{
    endWithTheTest(recorder);
    recorder.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    // The latency is also that in which the output takes what it plays; without one it takes two seconds at a time.
    recorder.start(QStringLiteral("parec"), {QStringLiteral("--raw"), QStringLiteral("--format=s16ne"), QStringLiteral("--rate=44100"),
                                             QStringLiteral("--channels=1"), QStringLiteral("--latency-msec=10"),
                                             QStringLiteral("--device=%1.monitor").arg(QString::fromLatin1(output))});
}

SoundRecord::SoundRecord(const char* output)
{
    QObject::connect(&m_recorder, &QProcess::readyReadStandardOutput, &m_recorder, [this] { read(); });
    startRecording(m_recorder, output);
}

SoundRecord::~SoundRecord() { end(m_recorder); }

/// The clock of the record: the sample that came with the least delay says when its first one was mixed.
void SoundRecord::read()
{
    const auto now = std::chrono::steady_clock::now();
    m_rest += m_recorder.readAllStandardOutput();
    const auto count = std::size_t(m_rest.size()) / sizeof(std::int16_t);
    const auto before = m_samples.size();
    m_samples.resize(before + count);
    std::memcpy(m_samples.data() + before, m_rest.constData(), count * sizeof(std::int16_t));
    m_rest.remove(0, qsizetype(count * sizeof(std::int16_t)));
    if (count > 0)
        m_begun = std::min(m_begun, now - durationOf(m_samples.size()));
}

double SoundRecord::length() const { return milliseconds(durationOf(m_samples.size())); }

std::vector<HeardPulse> SoundRecord::pulsesSince(double start) const
{
    std::vector<HeardPulse> pulses;
    std::size_t end = 0; ///< of the last one
    for (auto at = place(start); at + window <= m_samples.size(); at += window) {
        if (loudness(m_samples.data() + at, window) < loud)
            continue;
        if (pulses.empty() || at != end)
            pulses.push_back({milliseconds(durationOf(at)), 0});
        end = at + window;
        pulses.back().end = milliseconds(durationOf(end));
    }
    return pulses;
}

bool SoundRecord::hasFallenSilent(double start, double quiet) const
{
    const auto pulses = pulsesSince(start);
    return !pulses.empty() && length() - pulses.back().end >= quiet;
}

double SoundRecord::pitchOf(const HeardPulse& pulse) const
{
    const auto* first = m_samples.data() + place(pulse.start);
    double most = 0;
    double pitch = 0;
    for (double frequency = 100; frequency <= 1000; ++frequency) {
        const double found = power(first, place(pulse.end) - place(pulse.start), frequency);
        pitch = found > most ? frequency : pitch;
        most = std::max(most, found);
    }
    return pitch;
}

std::optional<Instant> SoundRecord::firstSound(double start) const
{
    const auto found = std::find_if(m_samples.begin() + std::ptrdiff_t(place(start)), m_samples.end(), isSound);
    return found == m_samples.end() ? std::nullopt : std::optional(timeOf(std::size_t(found - m_samples.begin())));
}

std::optional<Instant> SoundRecord::lastSound(double start) const
{
    const auto end = m_samples.rend() - std::ptrdiff_t(place(start));
    const auto found = std::find_if(m_samples.rbegin(), end, isSound);
    return found == end ? std::nullopt : std::optional(timeOf(std::size_t(m_samples.rend() - found)));
}

std::size_t SoundRecord::place(double time) const { return std::min(m_samples.size(), std::size_t(std::lround(time * soundRate / 1000))); }

Instant SoundRecord::timeOf(std::size_t place) const { return m_begun + durationOf(place); }

} // namespace console::test
