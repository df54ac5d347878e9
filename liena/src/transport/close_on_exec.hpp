// What a program that this one starts does not get.
#pragma once

#include <fcntl.h>

namespace liena::transport {

/// A program that the application starts would hold our port and our connections beyond our end: nobody could listen there again, and the
/// peers' kernels would not hear that we are gone. Asio opens its sockets without this.
inline void closeOnExec(int descriptor) { (void)::fcntl(descriptor, F_SETFD, FD_CLOEXEC); }

} // namespace liena::transport
