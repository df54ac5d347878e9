// One sink on the default output, opened anew when the outputs change.
#include "sound/burst_player.hpp"

#include "sound/burst_samples.hpp"

#include <QAudioDevice>
#include <QAudioSink>
#include <QMediaDevices>

namespace console {

BurstPlayer::BurstPlayer() : m_look(this), m_samples(this)
{
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

void BurstPlayer::setWish(std::optional<AlarmPriority> wish) { m_wish = wish ? static_cast<int>(*wish) : silent; }

void BurstPlayer::tell(const QString& trouble)
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
    ++m_served;
}

/// Qt 6.4 never says that the outputs of PulseAudio are others, but what it lists is true.
void BurstPlayer::lookForOutput()
{
    if (QMediaDevices::defaultAudioOutput().id() != m_output)
        openOutput();
}

void BurstPlayer::openOutput()
{
    if (!m_devices) {
        m_devices = std::make_unique<QMediaDevices>();
        connect(m_devices.get(), &QMediaDevices::audioOutputsChanged, this, &BurstPlayer::openOutput);
    }
    const bool cutShort = m_sink && m_sink->state() == QAudio::ActiveState;
    if (m_sink)
        disconnect(m_sink.get(), nullptr, this, nullptr);
    m_sink.reset();
    const auto device = QMediaDevices::defaultAudioOutput();
    m_output = device.id();
    // What the sound server shows where there is no hardware: it takes everything, and nobody hears it.
    if (device.isNull() || device.id() == "auto_null")
        return tell(tr("this computer has no sound output"));
    QAudioFormat format;
    format.setSampleRate(sampleRate);
    format.setChannelCount(1);
    format.setSampleFormat(QAudioFormat::Int16);
    if (!device.isFormatSupported(format))
        return tell(tr("%1 does not take 16 bit at 44.1 kHz").arg(device.description()));
    m_sink = std::make_unique<QAudioSink>(device, format);
    connect(m_sink.get(), &QAudioSink::stateChanged, this, &BurstPlayer::readSink);
    tell({});
    int nothingNewer = followed;
    if (cutShort)
        m_wish.compare_exchange_strong(nothingNewer, m_played);
    playWish();
}

void BurstPlayer::followWish()
{
    lookForOutput();
    playWish();
    ++m_served;
}

void BurstPlayer::playWish()
{
    if (!m_sink)
        return; // the wish waits for an output
    const int wish = m_wish.exchange(followed);
    if (wish == followed)
        return;
    m_played = wish;
    m_sink->stop();
    m_samples.close();
    if (wish == silent)
        return;
    m_samples.setData(burstSamples(static_cast<AlarmPriority>(wish)));
    m_samples.open(QIODevice::ReadOnly);
    // As Qt chooses: 6.4 else asks for what the start before was given, which is less each time, until after some bursts nothing is heard.
    m_sink->setBufferSize(0);
    m_sink->start(&m_samples);
    readSink();
}

/// An underrun is how every burst ends: there is no more to play.
void BurstPlayer::readSink()
{
    switch (m_sink->error()) {
    case QAudio::NoError:
        if (m_sink->state() == QAudio::ActiveState)
            tell({});
        break;
    case QAudio::UnderrunError:
        break;
    case QAudio::OpenError:
        tell(tr("the sound output cannot be opened"));
        break;
    case QAudio::IOError:
        tell(tr("the sound output does not take what is sent to it"));
        break;
    default:
        tell(tr("the sound output has failed"));
        break;
    }
}

} // namespace console
