// A program of the lab as a child process in a network namespace, with its input and output as pipes.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace liena::lab {

struct ProcessPlan {
    std::vector<std::string> command;
    std::vector<int> inherited;   ///< descriptors that stay open in it
    std::optional<int> network;   ///< descriptor of its namespace; absent: ours
    std::optional<int> processor; ///< it runs on this one only
    int urgency = 0;              ///< its real-time priority (round robin); 0: as the runner
    std::string smallDisk;        ///< a folder that is a full-able disk of 64 KiB for it alone
    bool keepsErrors = true;      ///< stderr is ours; else it goes with the output
};

/// Is killed with the object, and by the kernel when the runner dies. Start it from the main thread.
class Process {
public:
    /// Throws std::system_error.
    explicit Process(const ProcessPlan& plan);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    pid_t id() const { return m_id; }
    int output() const { return m_output; }

    void say(const std::string& line);
    void closeInput();
    void signal(int number) const;

    /// The exit status when it has ended; 128 + n by signal n.
    std::optional<int> ended();
    int waitForEnd();

private:
    pid_t m_id = -1;
    int m_input = -1;
    int m_output = -1;
    std::optional<int> m_status;
};

/// The calling thread and those it starts from now on. Throws std::system_error.
void makeUrgent(int urgency);

/// Status and output (both kinds) of a program that ends by itself.
std::pair<int, std::string> runToEnd(const std::vector<std::string>& command, std::optional<int> network);

} // namespace liena::lab
