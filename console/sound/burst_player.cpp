// One sink on the default output, opened anew when the outputs change.
#include "sound/burst_player.hpp"

#include "model/alarm_burst.hpp"
#include "sound/burst_samples.hpp"

#include <QAudioDevice>
#include <QAudioSink>
#include <QMediaDevices>

namespace console {

namespace {

constexpr std::chrono::milliseconds onItsWay{200}; ///< to the output, and in it
constexpr std::chrono::milliseconds lookAgain{50};
constexpr std::chrono::milliseconds behind{100}; ///< five times what PulseAudio begins without

QByteArray silenceFor(std::chrono::milliseconds time)
{
    return QByteArray(qsizetype(sizeof(std::int16_t)) * sampleRate * time.count() / 1000, '\0');
}

} // namespace

BurstPlayer::BurstPlayer() : m_look(this), m_end(this), m_samples(this)
{
    m_end.setSingleShot(true);
    connect(&m_end, &QTimer::timeout, this, &BurstPlayer::noteEnd);
    m_look.setInterval(std::chrono::milliseconds(500));
    connect(&m_look, &QTimer::timeout, this, &BurstPlayer::lookForOutput);
}

BurstPlayer::~BurstPlayer()
{
    if (m_sink) {
        disconnect(m_sink.get(), nullptr, this, nullptr);
        m_sink->stop();
    }
}

void BurstPlayer::tell(const SoundTrouble& trouble)
{
    if (m_told == trouble)
        return;
    m_told = trouble;
    Q_EMIT troubleChanged(trouble);
}

void BurstPlayer::open()
{
    openOutput();
    m_look.start();
}

/// Qt 6.4 never says that the outputs of PulseAudio are others, but what it lists is true. Whether it was another, which then plays the
/// wish.
bool BurstPlayer::lookForOutput()
{
    if (QMediaDevices::defaultAudioOutput().id() == m_output)
        return false;
    openOutput();
    return true;
}

void BurstPlayer::openOutput()
{
    if (!m_devices) {
        m_devices = std::make_unique<QMediaDevices>();
        connect(m_devices.get(), &QMediaDevices::audioOutputsChanged, this, &BurstPlayer::openOutput);
    }
    if (m_sink)
        disconnect(m_sink.get(), nullptr, this, nullptr);
    m_sink.reset();
    const auto device = QMediaDevices::defaultAudioOutput();
    m_output = device.id();
    // What the sound server shows where there is no hardware: it takes everything, and nobody hears it.
    if (device.isNull() || device.id() == "auto_null")
        return tell({QT_TR_NOOP("this computer has no sound output"), {}});
    QAudioFormat format;
    format.setSampleRate(sampleRate);
    format.setChannelCount(1);
    format.setSampleFormat(QAudioFormat::Int16);
    if (!device.isFormatSupported(format))
        return tell({QT_TR_NOOP("%1 does not take 16 bit at 44.1 kHz"), device.description().toUtf8()});
    m_sink = std::make_unique<QAudioSink>(device, format);
    connect(m_sink.get(), &QAudioSink::stateChanged, this, &BurstPlayer::readSink);
    play();
}

void BurstPlayer::follow(std::optional<AlarmPriority> wish)
{
    m_wish = wish;
    if (!lookForOutput() && m_sink)
        play();
}

void BurstPlayer::play()
{
    m_sink->stop();
    m_samples.close();
    m_end.stop();
    if (m_wish) {
        // The sound server has room for all of it, and begins when it has all but what is silent, so that what holds up this program holds
        // up no sound. With a small buffer a server that had run dry waited for a whole one again, and the rest of a burst is less.
        const auto sound = burstSamples(*m_wish);
        m_samples.setData(sound + silenceFor(behind));
        m_sink->setBufferSize(2 * sound.size()); // of which PulseAudio gives half, and what it begins without
        m_samples.open(QIODevice::ReadOnly);
        m_sink->start(&m_samples);
        m_end.start(burstLength(*m_wish) + onItsWay);
    } else { // open, and at rest: so it hears that the sound server is gone, which the list of outputs does not tell
        // As Qt chooses: 6.4 else asks for what the start before was given, which is less each time.
        m_sink->setBufferSize(0);
        m_sink->start();
        m_sink->suspend();
    }
    readSink();
}

/// An underrun is how every burst ends: there is no more to play.
void BurstPlayer::readSink()
{
    switch (m_sink->error()) {
    case QAudio::NoError:
        if (m_sink->state() != QAudio::StoppedState)
            tell({});
        break;
    case QAudio::UnderrunError:
        break;
    case QAudio::OpenError:
        tell({QT_TR_NOOP("the sound output cannot be opened"), {}});
        break;
    case QAudio::IOError:
        tell({QT_TR_NOOP("the sound output does not take what is sent to it"), {}});
        break;
    default:
        tell({QT_TR_NOOP("the sound output has failed"), {}});
        break;
    }
}

/// Its samples are handed over long before they are heard.
void BurstPlayer::noteEnd()
{
    if (!m_wish || !m_sink)
        return;
    if (m_sink->state() == QAudio::ActiveState)
        return m_end.start(lookAgain);
    if (m_sink->state() != QAudio::IdleState || !m_samples.atEnd())
        return;
    m_wish.reset();
    Q_EMIT sounded();
}

} // namespace console
