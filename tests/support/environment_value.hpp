// An environment variable with another value for a while.
#pragma once

#include <QByteArray>
#include <QFile>
#include <QString>
#include <QtGlobal>

namespace liena::test {

/// As long as it lives; then the variable is as it was. Made before threads begin that read the environment.
class EnvironmentValue {
public:
    EnvironmentValue(const char* name, const QString& value)
        : m_name(name), m_wasSet(qEnvironmentVariableIsSet(name)), m_before(qgetenv(name))
    {
        qputenv(name, QFile::encodeName(value));
    }

    ~EnvironmentValue()
    {
        if (m_wasSet)
            qputenv(m_name, m_before);
        else
            qunsetenv(m_name);
    }
    Q_DISABLE_COPY_MOVE(EnvironmentValue)

private:
    const char* m_name;
    bool m_wasSet;
    QByteArray m_before;
};

} // namespace liena::test
