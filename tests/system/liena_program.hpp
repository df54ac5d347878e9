// The program `liena` as a person runs it, and what came of it.
#pragma once

#include <QProcess>
#include <QString>
#include <QStringList>

#include <filesystem>

namespace liena::test {

inline const QString lienaProgram = QStringLiteral(LIENA_PROGRAM_DIR "/liena");

struct ToolOutcome {
    int status = -1; ///< -1: it did not end by itself
    QString output;
    QString errors;
};

constexpr int longestToolRun = 60'000; ///< milliseconds

/// Waits for its end.
inline ToolOutcome outcomeOf(QProcess& process)
{
    if (!process.waitForFinished(longestToolRun) || process.exitStatus() != QProcess::NormalExit)
        return {};
    return {process.exitCode(), QString::fromUtf8(process.readAllStandardOutput()), QString::fromUtf8(process.readAllStandardError())};
}

inline ToolOutcome runLiena(const QStringList& arguments)
{
    QProcess process;
    process.start(lienaProgram, arguments);
    return outcomeOf(process);
}

inline QString text(const std::filesystem::path& path) { return QString::fromStdString(path.string()); }

} // namespace liena::test
