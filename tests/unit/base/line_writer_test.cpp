// Lines leave in order, and nobody waits for whoever takes them.
#include "base/line_writer.hpp"
#include "liena/log.hpp"

#include <QTest>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#ifndef __has_feature // GCC
#define __has_feature(feature) 0
#endif

using namespace liena;
using namespace std::chrono_literals;
using base::LineWriter;

namespace {

constexpr auto longEnough = 20s; ///< that only a broken program needs

std::string lostText(std::uint64_t count) { return "lost " + std::to_string(count) + "\n"; }

class Pipe {
public:
    Pipe()
    {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0)
            throw std::runtime_error("no pipe");
        out = ends[0];
        in = ends[1];
    }
    ~Pipe()
    {
        closeIn();
        if (m_reader.joinable())
            m_reader.join();
        ::close(out);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    void fill() const
    {
        const std::string some(512, '.');
        ::fcntl(in, F_SETFL, O_NONBLOCK);
        while (::write(in, some.data(), some.size()) > 0) {
        }
        ::fcntl(in, F_SETFL, 0);
    }

    void startReading()
    {
        m_reader = std::thread([this] {
            std::array<char, 4096> some{};
            for (auto got = ::read(out, some.data(), some.size()); got > 0; got = ::read(out, some.data(), some.size()))
                m_text.append(some.data(), static_cast<std::size_t>(got));
        });
    }

    /// All that was written, without what filled it; nothing can be written any more.
    std::string text()
    {
        closeIn();
        if (!m_reader.joinable())
            startReading();
        m_reader.join();
        return m_text.substr(std::min(m_text.find_first_not_of('.'), m_text.size()));
    }

    void closeIn()
    {
        if (in >= 0)
            ::close(std::exchange(in, -1));
    }

    int in = -1;
    int out = -1;

private:
    std::string m_text;
    std::thread m_reader;
};

/// Stderr is the pipe's as long as it lives.
class RedirectedStderr {
public:
    explicit RedirectedStderr(const Pipe& pipe) : m_before(::dup(STDERR_FILENO)) { ::dup2(pipe.in, STDERR_FILENO); }
    ~RedirectedStderr()
    {
        ::dup2(m_before, STDERR_FILENO);
        ::close(m_before);
    }
    RedirectedStderr(const RedirectedStderr&) = delete;
    RedirectedStderr& operator=(const RedirectedStderr&) = delete;

private:
    int m_before;
};

} // namespace

class LineWriterTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void writesInOrder();
    void linesOfSeveralThreadsStayWhole();
    void nobodyWaitsForAPipeThatIsNotRead();
    void endsBesideAPipeThatIsNotRead();
    void writesAllThatWaitsAtTheEnd();
    void aClosedPipeEndsNothing();
    void logsToStderrWithoutWaiting();
    void aForkedChildLogs();
};

void LineWriterTest::writesInOrder()
{
    Pipe pipe;
    std::string expected;
    {
        LineWriter writer(pipe.in);
        for (int i = 0; i < 1000; ++i) {
            writer.put(std::to_string(i) + "\n", lostText);
            expected += std::to_string(i) + "\n";
        }
        QVERIFY(writer.flush(longEnough));
    }
    QCOMPARE(pipe.text(), expected);
}

void LineWriterTest::linesOfSeveralThreadsStayWhole()
{
    Pipe pipe;
    pipe.startReading();
    {
        LineWriter writer(pipe.in);
        std::vector<std::thread> threads;
        for (const char letter : {'a', 'b', 'c', 'd'})
            threads.emplace_back([&writer, letter] {
                for (int i = 0; i < 500; ++i)
                    writer.put(std::string(50, letter) + "\n", lostText);
            });
        for (auto& thread : threads)
            thread.join();
        QVERIFY(writer.flush(longEnough));
    }
    std::map<std::string, int> lines;
    const auto text = pipe.text();
    for (std::size_t at = 0; at < text.size(); at += 51)
        ++lines[text.substr(at, 51)];
    QCOMPARE(lines.size(), std::size_t{4});
    for (const auto& [line, count] : lines)
        QCOMPARE(count, 500);
}

/// Each put() that waited would wait for ever here.
void LineWriterTest::nobodyWaitsForAPipeThatIsNotRead()
{
    constexpr int sent = 2000;
    Pipe pipe;
    pipe.fill();
    {
        LineWriter writer(pipe.in, 4096);
        for (int i = 0; i < sent; ++i)
            writer.put(std::to_string(i) + "\n", lostText);
        QVERIFY(!writer.flush(1ms));
        pipe.startReading();
        QVERIFY(writer.flush(longEnough));
        writer.put("after\n", lostText);
        QVERIFY(writer.flush(longEnough));
    }
    const auto text = QString::fromStdString(pipe.text()).split(u'\n', Qt::SkipEmptyParts);
    const auto kept = text.size() - 2;
    QVERIFY2(kept > 100 && kept < sent, qPrintable(QString::number(kept)));
    for (qsizetype i = 0; i < kept; ++i)
        QCOMPARE(text[i], QString::number(i));
    QCOMPARE(text[kept], QStringLiteral("lost %1").arg(sent - kept)); // in the place where they are missing
    QCOMPARE(text[kept + 1], QStringLiteral("after"));
}

void LineWriterTest::endsBesideAPipeThatIsNotRead()
{
    static auto* const pipe = new Pipe; // stays: the thread may be in the midst of its write for longer than this test
    pipe->fill();
    {
        LineWriter writer(pipe->in);
        writer.put("never written\n", lostText);
        writer.finish(1ms);
        writer.put("neither\n", lostText);
    }
    ::close(std::exchange(pipe->out, ::open("/dev/null", O_RDONLY | O_CLOEXEC))); // lets the thread go
}

void LineWriterTest::writesAllThatWaitsAtTheEnd()
{
    Pipe pipe;
    pipe.startReading();
    {
        LineWriter writer(pipe.in);
        for (int i = 0; i < 1000; ++i)
            writer.put("line\n", lostText);
        writer.finish(longEnough);
        writer.put("afterwards\n", lostText);
    }
    const auto text = pipe.text();
    QCOMPARE(text.size(), std::size_t{1000 * 5 + 11});
    QVERIFY(text.ends_with("line\nafterwards\n"));
}

/// SIGPIPE would end this process.
void LineWriterTest::aClosedPipeEndsNothing()
{
    Pipe pipe;
    ::close(std::exchange(pipe.out, ::open("/dev/null", O_RDONLY | O_CLOEXEC)));
    LineWriter writer(pipe.in);
    writer.put("to nobody\n", lostText);
    QVERIFY(writer.flush(longEnough));
}

void LineWriterTest::logsToStderrWithoutWaiting()
{
    Pipe pipe;
    pipe.fill();
    {
        const RedirectedStderr redirected(pipe);
        const auto log = stderrLog(LogLevel::Info);
        log(LogLevel::Debug, "not said");
        for (int i = 0; i < 20000; ++i)
            log({LogLevel::Warning, "the disk hangs and the line " + std::to_string(i) + " is not read"});
        pipe.startReading();
        QVERIFY(base::stderrWriter().flush(longEnough));
    }
    const auto text = pipe.text();
    QVERIFY(text.find("not said") == std::string::npos);
    QVERIFY(text.find("warning the disk hangs and the line 0 is not read\n") != std::string::npos);
    QVERIFY(text.find("lines of this log were lost") != std::string::npos);
}

void LineWriterTest::aForkedChildLogs()
{
#ifdef __SANITIZE_THREAD__
    QSKIP("ThreadSanitizer lets no forked child make threads");
#endif
    if (__has_feature(thread_sanitizer))
        QSKIP("ThreadSanitizer lets no forked child make threads");
    Pipe pipe;
    {
        const RedirectedStderr redirected(pipe);
        const auto log = stderrLog();
        log(LogLevel::Info, "of the parent");
        QVERIFY(base::stderrWriter().flush(longEnough));
        const auto child = ::fork();
        if (child == 0) {
            log(LogLevel::Info, "of the child");
            ::_exit(base::stderrWriter().flush(longEnough) ? 0 : 1);
        }
        int status = 0;
        QCOMPARE(::waitpid(child, &status, 0), child);
        QCOMPARE(status, 0);
    }
    const auto text = QString::fromStdString(pipe.text());
    QCOMPARE(text.count(QStringLiteral("of the parent\n")), 1);
    QCOMPARE(text.count(QStringLiteral("of the child\n")), 1);
}

QTEST_APPLESS_MAIN(LineWriterTest)
#include "line_writer_test.moc"
