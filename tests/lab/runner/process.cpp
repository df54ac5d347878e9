// A program of the lab as a child process: implementation.
#include "runner/process.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>

namespace liena::lab {

namespace {

constexpr int pipeSize = 1 << 20;

std::array<int, 2> makePipe()
{
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
    ::fcntl(ends[1], F_SETPIPE_SZ, pipeSize); // a device never waits for the runner; less is less safe and no error
    return ends;
}

// Between fork and exec: nothing but system calls. Text is for the person who reads the output.
[[noreturn]] void giveUp(const char* what)
{
    const auto length = std::char_traits<char>::length(what);
    (void)!::write(STDERR_FILENO, what, length);
    ::_exit(127);
}

void becomeChild(const ProcessPlan& plan, int input, int output)
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::signal(SIGPIPE, SIG_DFL); // as a program finds it that was started by hand
    if (plan.network && ::setns(*plan.network, CLONE_NEWNET) != 0)
        giveUp("lab: cannot enter the network namespace\n");
    if (!plan.smallDisk.empty()) {
        const bool mounted = ::unshare(CLONE_NEWNS) == 0 && ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                             ::mount("tmpfs", plan.smallDisk.c_str(), "tmpfs", 0, "size=64k") == 0;
        if (!mounted)
            giveUp("lab: cannot mount the small disk\n");
    }
    if (plan.processor) {
        cpu_set_t processors;
        CPU_ZERO(&processors);
        CPU_SET(*plan.processor, &processors);
        ::sched_setaffinity(0, sizeof processors, &processors);
    }
    const sched_param priority{plan.urgency};
    if (plan.urgency > 0)
        ::sched_setscheduler(0, SCHED_RR, &priority);
    ::dup2(input, STDIN_FILENO);
    ::dup2(output, STDOUT_FILENO);
    if (!plan.keepsErrors)
        ::dup2(output, STDERR_FILENO);
    for (const int descriptor : plan.inherited)
        ::fcntl(descriptor, F_SETFD, 0);
}

} // namespace

Process::Process(const ProcessPlan& plan)
{
    const auto input = makePipe();
    const auto output = makePipe();
    std::vector<char*> arguments;
    for (const auto& word : plan.command)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    m_id = ::fork();
    if (m_id < 0)
        throw std::system_error(errno, std::generic_category(), "cannot start " + plan.command.front());
    if (m_id == 0) {
        becomeChild(plan, input[0], output[1]);
        ::execvp(arguments[0], arguments.data());
        giveUp("lab: cannot start the program\n");
    }
    ::close(input[0]);
    ::close(output[1]);
    m_input = input[1];
    m_output = output[0];
}

Process::~Process()
{
    if (!ended()) {
        signal(SIGKILL);
        waitForEnd();
    }
    closeInput();
    ::close(m_output);
}

void Process::say(const std::string& line)
{
    const std::string text = line + "\n";
    if (::write(m_input, text.data(), text.size()) < 0 && errno != EPIPE)
        throw std::system_error(errno, std::generic_category(), "cannot speak to a process of the lab");
}

void Process::closeInput()
{
    if (m_input >= 0)
        ::close(m_input);
    m_input = -1;
}

void Process::signal(int number) const { ::kill(m_id, number); }

std::optional<int> Process::ended()
{
    int status = 0;
    if (!m_status && ::waitpid(m_id, &status, WNOHANG) == m_id)
        m_status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    return m_status;
}

int Process::waitForEnd()
{
    int status = 0;
    if (!m_status && ::waitpid(m_id, &status, 0) == m_id)
        m_status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    return m_status.value_or(-1);
}

void makeUrgent(int urgency)
{
    const sched_param priority{urgency};
    if (::sched_setscheduler(0, SCHED_RR, &priority) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot take a real-time priority");
}

std::pair<int, std::string> runToEnd(const std::vector<std::string>& command, std::optional<int> network)
{
    ProcessPlan plan;
    plan.command = command;
    plan.network = network;
    plan.keepsErrors = false;
    Process process(plan);
    process.closeInput();
    std::string output;
    std::array<char, 4096> buffer{};
    for (;;) {
        const auto count = ::read(process.output(), buffer.data(), buffer.size());
        if (count <= 0)
            break;
        output.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return {process.waitForEnd(), output};
}

} // namespace liena::lab
