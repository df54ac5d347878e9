// A sound server of a measuring program's own, and what hears its one output.
#pragma once

#include "output_recorder.hpp"
#include "support/sound_room.hpp"

#include <QTest>

#include <memory>

namespace console::test {

/// Before the console, which plays to what is there when it begins. Only where nothing is SoundServer::missing().
class Hearing {
public:
    /// Why nothing is heard; empty: what is played from here on is.
    QString begin()
    {
        if (!m_server.start() || !m_server.addOutput(output))
            return QStringLiteral("the sound server does not serve: %1").arg(m_server.said());
        m_recorder = std::make_unique<OutputRecorder>(output);
        const auto hears = [this] { return m_recorder->silence() > Duration::zero(); };
        return QTest::qWaitFor(hears, patience) ? QString() : QStringLiteral("nothing is recorded: %1").arg(m_server.said());
    }

    OutputRecorder& recorder() { return *m_recorder; }

private:
    static constexpr const char* output = "theatre";
    static constexpr int patience = 30000; ///< ms

    SoundServer m_server; ///< first: it goes last
    std::unique_ptr<OutputRecorder> m_recorder;
};

} // namespace console::test
