// What liena-console is told on its command line.
#pragma once

#include "link/network_settings.hpp"
#include "model/master_status.hpp"
#include "model/operator_role.hpp"
#include "model/picture_state.hpp"

#include <QSize>
#include <QString>
#include <QStringList>

#include <optional>

namespace console {

struct UnattendedSettings {
    double jogSeconds = 0;
    QString report;     ///< JSON file; empty: none
    QString screenshot; ///< PNG file; empty: none
};

struct Options {
    QString topology;
    QString device;
    QStringList registry;
    QString store;
    QString certificate;
    QString key;
    QString authority;
    QString recording;
    MasterKind master = MasterKind::Keyboard;
    QString vessels;
    QString pictures; ///< folder for saved pictures; empty: the person's own
    QString display;  ///< measurement of the display; empty: not calibrated
    QString user;
    OperatorRole role = OperatorRole::Operator;
    QString patient; ///< and patientId: both or neither
    QString patientId;
    QString alarmLog;    ///< folder; empty: alarms are not kept on the disk
    QString preferences; ///< file; empty: the defaults, and nothing is kept
    QString language;    ///< one of languages(); empty: the system's
    QString watchdog;    ///< program; empty: nobody watches this one
    QString player;      ///< program that sounds its alarms; empty: none
    bool rehearsal = false;
    bool measureOnRequest = false;
    NetworkSettings network;
    PictureProfile profile = PictureProfile::Neuro;
    std::optional<QSize> size;
    std::optional<UnattendedSettings> unattended;
};

struct CommandLine {
    enum class Outcome { Run, Help, Version, Mistake };

    Outcome outcome = Outcome::Run;
    Options options;
    QString text; ///< Help, Version: what to print; Mistake: one line
};

/// `arguments` with the program's name first. Reads no file.
CommandLine readCommandLine(const QStringList& arguments);

/// A file or folder of the project's resources: beside the installed program, else in the source tree it was built from; empty when neither
/// has it.
QString resource(const QString& name);

/// The surgeon's guide, found in the same two places; as seen from the current folder when it lies below it, else whole.
QString guide();

} // namespace console
