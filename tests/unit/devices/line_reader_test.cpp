// Typed lines: heard whenever the program holds the terminal, and an end of them is said.
#include "line_reader.hpp"

#include <QTest>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <unistd.h>

using namespace liena;
using namespace liena::devices;
using namespace std::chrono_literals;

namespace {

/// A pipe for a terminal, which the program holds or not.
struct Terminal {
    explicit Terminal(bool held) : isHeld(held)
    {
        if (pipe(ends) != 0)
            qFatal("no pipe");
        reader = std::make_unique<LineReader>(
            [this](std::string_view line) {
                const std::scoped_lock lock(mutex);
                lines.emplace_back(line);
            },
            [this](LogLevel, std::string_view text) {
                const std::scoped_lock lock(mutex);
                log.emplace_back(text);
            },
            LineSource{ends[0],
                       [this] {
                           const bool may = isHeld;
                           refused += may ? 0 : 1;
                           return may;
                       },
                       1ms});
    }
    ~Terminal()
    {
        reader.reset();
        hangUp();
        close(ends[0]);
    }

    bool type(std::string_view text) const { return write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()); }
    void hangUp()
    {
        if (ends[1] >= 0)
            close(ends[1]);
        ends[1] = -1;
    }
    std::vector<std::string> heard()
    {
        const std::scoped_lock lock(mutex);
        return lines;
    }
    std::vector<std::string> said()
    {
        const std::scoped_lock lock(mutex);
        return log;
    }

    std::atomic<bool> isHeld;
    std::atomic<int> refused = 0; ///< how often the reader heard that it may not read
    int ends[2] = {-1, -1};
    std::mutex mutex;
    std::vector<std::string> lines;
    std::vector<std::string> log;
    std::unique_ptr<LineReader> reader;
};

using Lines = std::vector<std::string>;

} // namespace

class LineReaderTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void hearsWhatIsTypedAfterItCameToTheForeground()
    {
        Terminal terminal(false);
        QTRY_VERIFY(terminal.refused > 2);
        QVERIFY(terminal.said().empty());
        terminal.isHeld = true;
        QVERIFY(terminal.type("stop\n"));
        QTRY_COMPARE(terminal.heard(), Lines{"stop"});
    }

    void leavesToOthersWhatIsTypedWhileTheyHoldTheTerminal()
    {
        Terminal terminal(true);
        QVERIFY(terminal.type("wait\n"));
        QTRY_COMPARE(terminal.heard(), Lines{"wait"});
        terminal.isHeld = false;
        QVERIFY(terminal.type("stop\n"));
        QTRY_VERIFY(terminal.refused > 2);
        QCOMPARE(terminal.heard(), Lines{"wait"});
        terminal.isHeld = true; // here nobody has read it meanwhile
        QTRY_COMPARE(terminal.heard(), (Lines{"wait", "stop"}));
        QVERIFY(terminal.said().empty());
    }

    void saysThatTheInputHasEnded()
    {
        Terminal terminal(true);
        QVERIFY(terminal.type("wait\n"));
        terminal.hangUp();
        QTRY_COMPARE(terminal.said(), Lines{"standard input has ended: no typed command is heard any more"});
        QCOMPARE(terminal.heard(), Lines{"wait"});
    }

    void endsWithoutAWordWhenStopped_data()
    {
        QTest::addColumn<bool>("held");
        QTest::newRow("in the foreground") << true;
        QTest::newRow("in the background") << false;
    }

    void endsWithoutAWordWhenStopped()
    {
        QFETCH(bool, held);
        Terminal terminal(held);
        terminal.reader->stop();
        QVERIFY(terminal.type("stop\n"));
        QVERIFY(terminal.heard().empty());
        QVERIFY(terminal.said().empty());
    }
};

QTEST_GUILESS_MAIN(LineReaderTest)
#include "line_reader_test.moc"
