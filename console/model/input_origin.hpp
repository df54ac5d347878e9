// Whether the keys and the mouse of this program come from another computer, as far as its session tells.
#pragma once

#include <QProcessEnvironment>
#include <QString>

namespace console {

/// The way by which they come from elsewhere, as `XRDP`; empty when nothing says so. `platform`: QGuiApplication::platformName().
///
/// Known are sessions that a remote desktop made, and displays that are reached over a network, as SSH forwards them. Who looks at the
/// local screen and types into it from elsewhere (screen sharing) leaves no mark in the environment, and cannot be told from here.
/// A platform without a screen takes no input at all, wherever it was started from.
QString remoteInputOf(const QString& platform, const QProcessEnvironment& environment);

} // namespace console
