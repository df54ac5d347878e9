// A thread, and on it the process that records.
#include "output_recorder.hpp"

#include "support/sound_room.hpp"

#include <cstring>

namespace console::test {

OutputRecorder::OutputRecorder(const char* output)
{
    QObject::connect(&m_process, &QProcess::readyReadStandardOutput, &m_process, [this] { read(); });
    m_process.moveToThread(&m_thread);
    m_thread.start();
    QMetaObject::invokeMethod(&m_process, [this, output] { startRecording(m_process, output); });
}

OutputRecorder::~OutputRecorder()
{
    const auto stop = [this] {
        m_process.kill();
        m_process.waitForFinished();
    };
    QMetaObject::invokeMethod(&m_process, stop, Qt::BlockingQueuedConnection);
    m_thread.quit();
    m_thread.wait();
}

/// The time is taken when the bytes are here: one that was taken before could be earlier than what came while they were read.
void OutputRecorder::read()
{
    m_rest += m_process.readAllStandardOutput();
    const auto arrived = std::chrono::steady_clock::now();
    std::vector<std::int16_t> block(std::size_t(m_rest.size()) / sizeof(std::int16_t));
    if (block.empty())
        return;
    const auto whole = qsizetype(block.size() * sizeof(std::int16_t));
    std::memcpy(block.data(), m_rest.constData(), std::size_t(whole));
    m_rest.remove(0, whole);
    const std::lock_guard lock(m_mutex);
    m_heard.add(block, arrived);
}

Duration OutputRecorder::silence() const
{
    const std::lock_guard lock(m_mutex);
    return m_heard.silence();
}

Onsets OutputRecorder::onsets() const
{
    const std::lock_guard lock(m_mutex);
    return m_heard.onsets();
}

void OutputRecorder::forget()
{
    const std::lock_guard lock(m_mutex);
    m_heard.forget();
}

} // namespace console::test
