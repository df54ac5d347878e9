// What the library says, in the person's language.
#pragma once

#include <liena/error.hpp>
#include <liena/session_state.hpp>

#include <QString>

namespace console {

QString words(liena::RejectReason reason);
QString words(liena::ProbeResult probe);

/// The library's own sentence names addresses, files and fields, and is English. In any other language the kind of failure comes first, and
/// the sentence behind it in brackets, for whoever is asked for help.
QString words(const liena::Error& error);

} // namespace console
