// A time as a test's message tells it.
#pragma once

#include <QByteArray>

#include <chrono>

namespace liena::test {

inline QByteArray millisecondsOf(std::chrono::nanoseconds time, const char* what)
{
    return QByteArray::number(static_cast<double>(time.count()) / 1e6) + ' ' + what;
}

} // namespace liena::test
