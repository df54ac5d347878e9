// What a process may ask of the scheduler, and the network thread's way to wait.
#include "system/real_time.hpp"

#include "base/ordinary_thread.hpp"
#include "support/no_more_threads.hpp"

#include <QTest>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace liena;
using namespace liena::system;
using namespace std::chrono_literals;

namespace {

constexpr auto grantedToAll = "somebody grants this in the kernel's place";

/// What `say` says in a process of its own.
QByteArray saidByAnother(const std::function<std::string()>& say)
{
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0)
        return {};
    const pid_t child = ::fork();
    if (child == 0) {
        const auto said = say();
        (void)!::write(pipe[1], said.data(), said.size());
        ::_exit(0);
    }
    ::close(pipe[1]);
    QByteArray said(4096, '\0');
    const auto size = ::read(pipe[0], said.data(), static_cast<std::size_t>(said.size()));
    ::close(pipe[0]);
    (void)::waitpid(child, nullptr, 0);
    return said.left(static_cast<int>(std::max<ssize_t>(size, 0)));
}

/// What a user is told who has neither rights nor limits: tried in a process that gives both up.
QByteArray toldWithoutRights(const RealTimeOptions& options, rlim_t memory = 0)
{
    return saidByAnother([&options, memory]() -> std::string {
        constexpr uid_t nobody = 65534;
        const rlimit none{0, 0};
        const rlimit some{memory, memory};
        const bool stripped = ::setrlimit(RLIMIT_RTPRIO, &none) == 0 && ::setrlimit(RLIMIT_MEMLOCK, &some) == 0 &&
                              (::geteuid() != 0 || ::setuid(nobody) == 0);
        const auto done = prepareRealTime(options);
        return !stripped ? "it kept its rights" : done ? "permitted" : done.error().what;
    });
}

/// Of this process, as the kernel says.
long lockedKiB()
{
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word && word != "VmLck:") {
    }
    long size = 0;
    status >> size;
    return size;
}

} // namespace

class RealTimeTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void asksForNothingByDefault()
    {
        QVERIFY(prepareRealTime({}));
        QCOMPARE(::sched_getscheduler(0), SCHED_OTHER);
    }

    void refusesWhatCannotBe_data()
    {
        QTest::addColumn<int>("priority");
        QTest::addColumn<int>("processor");
        QTest::addColumn<int>("searchUs");
        QTest::addColumn<QString>("says");
        QTest::newRow("priority too high") << 100 << 0 << 0 << "real-time priority 100 is not 0 to 99";
        QTest::newRow("priority negative") << -1 << 0 << 0 << "real-time priority -1";
        QTest::newRow("no such number of a processor") << 0 << 5000 << 0 << "processor 5000 is not";
        QTest::newRow("processor that is not here") << 0 << 1000 << 0 << "none of the chosen processors";
        QTest::newRow("search too long") << 0 << 0 << 2'000'000 << "a search of 2000000 us is not";
        QTest::newRow("search negative") << 0 << 0 << -1 << "a search of -1 us is not";
    }

    void refusesWhatCannotBe()
    {
        QFETCH(int, priority);
        QFETCH(int, processor);
        QFETCH(int, searchUs);
        QFETCH(QString, says);
        const auto done = prepareRealTime({priority, {processor}, false, std::chrono::microseconds(searchUs)});
        QVERIFY(!done);
        QVERIFY2(QString::fromStdString(done.error().what).contains(says), done.error().what.c_str());
    }

    void namesTheProcessorThatIsNotHereBesideOneThatIs()
    {
        RealTimeOptions options;
        options.processors = {::sched_getcpu(), 1000};
        const auto done = prepareRealTime(options);
        QVERIFY(!done);
        QVERIFY2(done.error().what.find("processor 1000 may not be used here") != std::string::npos, done.error().what.c_str());
    }

    void saysHowToPermitWhatIsNotPermitted()
    {
        const auto priority = toldWithoutRights({50, {}, false, 0us});
        QVERIFY2(priority.contains("real-time priority 50 is not permitted") && priority.contains("rtprio") &&
                     priority.contains("LimitRTPRIO="),
                 priority.constData());
        QCOMPARE(toldWithoutRights({}), QByteArray("permitted"));
        const auto memory = toldWithoutRights({0, {}, true, 0us});
        QVERIFY2(memory.contains("memory cannot be locked") && memory.contains("memlock") && memory.contains("LimitMEMLOCK="),
                 memory.constData());
        const auto some = toldWithoutRights({0, {}, true, 0us}, rlim_t{64} * 1024);
        QVERIFY2(some.contains("no more than 64 KiB of it") && some.contains("LimitMEMLOCK="), some.constData());
    }

    void refusesToLookForWorkOnTheOnlyProcessor()
    {
        const auto told = saidByAnother([]() -> std::string {
            cpu_set_t one;
            CPU_ZERO(&one);
            CPU_SET(::sched_getcpu(), &one);
            if (::sched_setaffinity(0, sizeof one, &one) != 0)
                return "it is not bound to one";
            const auto done = prepareRealTime({0, {}, false, 50us});
            return done ? "permitted" : done.error().what;
        });
        QVERIFY2(told.contains("may use one only") && told.contains("search of 50 us") && told.contains("taskset"), told.constData());
    }

    void saysThatNoThreadCanBeHad()
    {
        const test::NoMoreThreads none;
        const auto done = prepareRealTime({});
        QVERIFY(!done);
        QVERIFY2(done.error().what.find("no thread can be had") != std::string::npos, done.error().what.c_str());
    }

    void tryingLeavesTheCallersThreadAsItWas()
    {
        cpu_set_t before;
        cpu_set_t after;
        QCOMPARE(::sched_getaffinity(0, sizeof before, &before), 0);
        QVERIFY(prepareRealTime({0, {0}, false, 0us}));
        QCOMPARE(::sched_getaffinity(0, sizeof after, &after), 0);
        QVERIFY(CPU_EQUAL(&before, &after) != 0);
    }

    void networkThreadRunsOnItsProcessors()
    {
        boost::asio::io_context context;
        int processors = 0;
        boost::asio::post(context, [&] {
            cpu_set_t set;
            if (::sched_getaffinity(0, sizeof set, &set) == 0 && CPU_ISSET(0, &set) != 0)
                processors = CPU_COUNT(&set);
            context.stop();
        });
        liena::tasks::Attention attention;
        std::thread([&] { runNetworkThread(context, {0, {0}, false, 0us}, attention); }).join();
        QCOMPARE(processors, 1);
    }

    void networkThreadHasItsPriorityAndWorkersHaveNone()
    {
        RealTimeOptions options;
        options.priority = 7;
        if (const auto permitted = prepareRealTime(options); !permitted)
            QSKIP(permitted.error().what.c_str());
        const auto ownPolicy = [] {
            sched_param parameters{};
            int policy = -1;
            ::pthread_getschedparam(::pthread_self(), &policy, &parameters);
            return std::pair(policy, parameters.sched_priority);
        };
        boost::asio::io_context context;
        auto network = ownPolicy();
        auto worker = ownPolicy();
        boost::asio::post(context, [&] {
            network = ownPolicy();
            std::thread([&] { // inherits it
                base::runAsOrdinaryThread();
                worker = ownPolicy();
            })
                .join();
            context.stop();
        });
        std::thread([&] {
            tasks::Attention attention;
            runNetworkThread(context, options, attention);
        }).join();
        QCOMPARE(network, std::pair(SCHED_FIFO, 7));
        QCOMPARE(worker, std::pair(SCHED_OTHER, 0));
        QCOMPARE(ownPolicy().first, SCHED_OTHER);
    }

    /// In a process of its own: this one goes on with others.
    void lockedMemoryIsLocked()
    {
        const auto told = saidByAnother([]() -> std::string {
            if (::mlockall(MCL_CURRENT) == 0 && lockedKiB() == 0)
                return grantedToAll;
            (void)::munlockall();
            RealTimeOptions options;
            options.lockMemory = true;
            const auto done = prepareRealTime(options);
            return done ? std::to_string(lockedKiB()) : done.error().what;
        });
        if (told == grantedToAll)
            QSKIP("a sanitizer answers mlockall() in the kernel's place");
        if (told.contains("memory cannot be locked"))
            QSKIP(told.constData());
        QVERIFY2(told.toLongLong() > 0, told.constData());
    }

    void searchingThreadWorksSleepsAndEnds()
    {
        boost::asio::io_context context;
        boost::asio::steady_timer timer(context);
        auto work = boost::asio::make_work_guard(context);
        std::atomic<int> done = 0;
        liena::tasks::Attention attention;
        std::thread thread([&] { runNetworkThread(context, {0, {}, false, 200us}, attention); });
        boost::asio::post(context, [&] { ++done; });
        timer.expires_after(20ms); // it sleeps long before
        timer.async_wait([&](const boost::system::error_code&) {
            ++done;
            boost::asio::post(context, [&] {
                ++done;
                context.stop();
            });
        });
        thread.join();
        QCOMPARE(done.load(), 3);
    }

    /// Else the kernel would stop it. It looks for longer than this takes.
    void threadOfRealTimePriorityThatLooksForWorkSleepsNowAndThen()
    {
        RealTimeOptions options;
        options.priority = 7;
        options.search = 1s;
        if (const auto permitted = prepareRealTime(options); !permitted)
            QSKIP(permitted.error().what.c_str());
        std::ifstream limit("/proc/sys/kernel/sched_rt_runtime_us");
        if (long runtime = 0; limit >> runtime && runtime < 0)
            QSKIP("this kernel is told not to limit threads of real-time priority");
        boost::asio::io_context context;
        boost::asio::steady_timer timer(context);
        long sleeps = 0;
        timer.expires_after(100ms);
        timer.async_wait([&](const boost::system::error_code&) {
            rusage usage{};
            ::getrusage(RUSAGE_THREAD, &usage);
            sleeps = usage.ru_nvcsw;
            context.stop();
        });
        long sleepsBefore = 0;
        std::thread([&] {
            tasks::Attention attention;
            rusage usage{};
            ::getrusage(RUSAGE_THREAD, &usage);
            sleepsBefore = usage.ru_nvcsw;
            runNetworkThread(context, options, attention);
        }).join();
        QVERIFY2(sleeps > sleepsBefore, qPrintable(QString::number(sleeps)));
    }

    void attentiveThreadWorksSleepsAgainAndEnds_data()
    {
        QTest::addColumn<std::vector<int>>("processors");
        QTest::addColumn<bool>("staysAwake");
        QTest::newRow("all processors") << std::vector<int>{} << true;
        QTest::newRow("one, on which it always sleeps") << std::vector<int>{0} << true;
        QTest::newRow("all processors, told to sleep always") << std::vector<int>{} << false;
    }

    /// Where it sleeps, it judges only when it is woken, and is found awake then; unless the computer kept it from its work for longer than
    /// the dialogue may pause: then another dialogue tells.
    void attentiveThreadWorksSleepsAgainAndEnds()
    {
        QFETCH(const std::vector<int>, processors);
        QFETCH(const bool, staysAwake);
        const bool sleeps = !staysAwake || processors.size() == 1;
        constexpr int mostDialogues = 20;
        boost::asio::io_context context;
        boost::asio::steady_timer timer(context);
        liena::tasks::Attention attention;
        int steps = 0;
        int dialogues = 0;
        bool awakeWhenDue = false;
        std::function<void()> answer = [&] { // a step each, as messages that follow each other at once
            ++steps;
            if (!attention.isAwake()) {
                attention.heard();
                return boost::asio::post(context, answer);
            }
            ++dialogues;
            timer.expires_after(50ms);
            timer.async_wait([&](const boost::system::error_code&) {
                awakeWhenDue = attention.isAwake();
                if (awakeWhenDue || !sleeps || dialogues == mostDialogues)
                    context.stop();
                else
                    boost::asio::post(context, answer);
            });
        };
        boost::asio::post(context, answer);
        std::thread([&] { runNetworkThread(context, {0, processors, false, 0us, 0us, staysAwake}, attention); }).join();
        QVERIFY(steps > liena::tasks::Attention::enough);
        QCOMPARE(awakeWhenDue, sleeps);
        QVERIFY(!attention.isAwake());
    }
};

QTEST_GUILESS_MAIN(RealTimeTest)
#include "real_time_test.moc"
