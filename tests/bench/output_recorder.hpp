// Hears one output of a sound server, whatever the program does beside.
#pragma once

#include "heard_sound.hpp"

#include <QProcess>
#include <QThread>

#include <array>
#include <mutex>

namespace console::test {

/// What the server plays is read on a thread of its own: a block that waited for a window to be painted would have a time that is too late.
/// Any thread may ask.
class OutputRecorder {
public:
    explicit OutputRecorder(const char* output);
    ~OutputRecorder();
    Q_DISABLE_COPY_MOVE(OutputRecorder)

    Duration silence() const; ///< up to the last block
    Onsets onsets() const;
    void forget();

private:
    void read();

    QThread m_thread;
    QProcess m_process; ///< lives on the thread
    QByteArray m_rest;  ///< half a sample
    mutable std::mutex m_mutex;
    HeardSound m_heard;
};

} // namespace console::test
