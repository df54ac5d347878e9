// Keeps preferences in a file of the user's own.
#pragma once

#include "model/preferences.hpp"

namespace console {

/// GUI thread only. A file that cannot be read, or that says what makes no sense, costs a sentence and the default of that entry; it stays
/// as it is until a person changes something, and then a copy of it is kept beside the new one.
class PreferenceStore {
public:
    static constexpr qint64 mostBytes = 64 * 1024;

    explicit PreferenceStore(QString path);

    struct Reading {
        Preferences preferences;
        QStringList troubles; ///< a sentence each; empty when all is well or there is no file yet
    };
    Reading read();

    /// Replaces the file in one go; what it holds besides preferences stays. A sentence when it could not, else nothing.
    QString write(const Preferences& preferences);

    const QString& path() const { return m_path; }

private:
    QString keepCopy();

    const QString m_path;
    bool m_damaged = false; ///< what stands there was not understood
};

/// `preferences.ini` in the user's folder for settings.
QString preferenceFile();

} // namespace console
