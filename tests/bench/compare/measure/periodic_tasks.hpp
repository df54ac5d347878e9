// Tasks in a fixed rhythm for transports that wait in poll(): a timer descriptor each.
#pragma once

#include "measure/stamp.hpp"

#include <cstddef>
#include <functional>
#include <vector>

namespace liena::compare {

class PeriodicTasks {
public:
    PeriodicTasks() = default;
    ~PeriodicTasks();
    PeriodicTasks(const PeriodicTasks&) = delete;
    PeriodicTasks& operator=(const PeriodicTasks&) = delete;

    void add(Nanoseconds period, std::function<void()> task);
    void start();

    std::size_t count() const { return m_tasks.size(); }
    int descriptor(std::size_t place) const { return m_tasks[place].descriptor; }

    /// When the descriptor can be read.
    void expire(std::size_t place);

private:
    struct Task {
        int descriptor;
        Nanoseconds period;
        Instant due;
        std::function<void()> run;
    };

    static void arm(Task& task);

    std::vector<Task> m_tasks;
};

} // namespace liena::compare
