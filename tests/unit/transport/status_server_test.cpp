// The status socket's requests: one bounded line where they are taken, and nothing is read where they are not.
#include "transport/status_server.hpp"

#include <QTemporaryDir>
#include <QTest>

#include <atomic>
#include <mutex>

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

using namespace liena;
using namespace liena::transport;

namespace {

class Watcher {
public:
    explicit Watcher(const std::filesystem::path& file) : m_socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0))
    {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        const auto name = file.string();
        std::copy(name.begin(), name.end(), address.sun_path);
        if (::connect(m_socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
            throw std::runtime_error("cannot connect");
    }
    ~Watcher() { ::close(m_socket); }
    Watcher(const Watcher&) = delete;
    Watcher& operator=(const Watcher&) = delete;

    void say(const std::string& text) { QVERIFY(::send(m_socket, text.data(), text.size(), MSG_NOSIGNAL) >= 0); }

    /// Until a line holds `text`; false when the server let us go first, or never said it.
    bool hears(const std::string& text)
    {
        while (m_heard.find(text) == std::string::npos) {
            pollfd wait{m_socket, POLLIN, 0};
            char bytes[512];
            if (::poll(&wait, 1, 20'000) <= 0)
                return false;
            const auto count = ::recv(m_socket, bytes, sizeof bytes, 0);
            if (count <= 0)
                return false;
            m_heard.append(bytes, static_cast<std::size_t>(count));
        }
        return true;
    }
    bool isLetGo() { return !hears("nobody says this"); }

private:
    int m_socket;
    std::string m_heard;
};

struct Stage {
    QTemporaryDir folder;
    std::filesystem::path socket = std::filesystem::path(folder.path().toStdString()) / "status" / "device.sock";
    std::mutex mutex;
    std::vector<std::string> asked;
    std::atomic<int> gone = 0;

    std::unique_ptr<StatusServer> open(bool takesRequests)
    {
        StatusServer::Requests requests;
        if (takesRequests)
            requests = [this](const std::string& line, const StatusServer::Reply& reply) {
                const std::lock_guard lock(mutex);
                asked.push_back(line);
                reply("you said " + line);
                return [this] { ++gone; };
            };
        auto opened = StatusServer::open(
            socket, [] { return std::string("a status"); }, requests);
        if (!opened)
            throw std::runtime_error(opened.error().what);
        return std::move(opened.value());
    }
};

} // namespace

class StatusServerTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void answersOneLineBesideTheStatus()
    {
        Stage stage;
        const auto server = stage.open(true);
        {
            Watcher watcher(stage.socket);
            QVERIFY(watcher.hears("a status\n"));
            watcher.say("measure ");
            watcher.say("this\n");
            QVERIFY(watcher.hears("you said measure this\n"));
            QCOMPARE(stage.gone.load(), 0);
        }
        QTRY_COMPARE(stage.gone.load(), 1);
    }

    void aSecondRequestOrATooLongOneEndsIt()
    {
        Stage stage;
        const auto server = stage.open(true);
        Watcher twice(stage.socket);
        twice.say("one\n");
        QVERIFY(twice.hears("you said one\n"));
        twice.say("two\n");
        QVERIFY(twice.isLetGo());
        QTRY_COMPARE(stage.gone.load(), 1);
        Watcher endless(stage.socket);
        endless.say(std::string(300, 'x'));
        QVERIFY(endless.isLetGo());
        const std::lock_guard lock(stage.mutex);
        QCOMPARE(stage.asked.size(), std::size_t{1});
    }

    void whereNoneAreTakenNothingIsRead()
    {
        Stage stage;
        const auto server = stage.open(false);
        Watcher watcher(stage.socket);
        QVERIFY(watcher.hears("a status\n"));
        for (int i = 0; i < 100; ++i)
            watcher.say(std::string(300, 'x') + "\n");
        QVERIFY(watcher.hears("a status\na status\n")); // and it goes on
    }
};

QTEST_GUILESS_MAIN(StatusServerTest)
#include "status_server_test.moc"
