// Errors as values: what the library returns when something a caller can meet goes wrong.
#pragma once

#include <boost/outcome/basic_result.hpp>
#include <boost/outcome/policy/throw_bad_result_access.hpp>
#include <boost/outcome/success_failure.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace liena {

/// The kinds of failure a caller may want to tell apart. The sentence for a person is in Error.
enum class Errc : std::uint8_t {
    InvalidArgument = 1, ///< a setting, name or number that cannot be
    FileUnreadable,      ///< also: a key that others may read
    FileUnwritable,      ///< also: it is there already, and stays
    XmlInvalid,          ///< no well-formed XML, or beyond the limits for such files
    MessageSetInvalid,   ///< well-formed, and against the rules of message sets; or none for a device
    TopologyInvalid,     ///< the same of topologies
    CertificateInvalid,  ///< certificate, key, authority or revocation list: damaged, over, or of another device
    AddressUnavailable,  ///< host or port of this device
    NetworkFailure,      ///< another program did not answer, or broke off
    UnknownDevice,       ///< not in the topology
    UnknownMessage,      ///< not in the message set
    NoLink,              ///< in the topology, and not linked to this device
    NotOpen,             ///< the session does not carry this now
    NotYet,              ///< what is needed becomes known with the first session, or its first heartbeat
    StandBy,             ///< a person has to re-open a channel first
    NoIncident,          ///< nothing to re-open or to dismiss
    Busy,                ///< it is done already, or one at a time
    Forbidden,           ///< by the topology, by a budget, or by the operating system
    ValueRefused,        ///< a value outside the bounds of its definition
    QueueFull,           ///< too much waits; later ones may pass
    Stopped,             ///< after stop()
};

std::string_view toString(Errc code);

/// One failure: its kind, and one sentence that names the thing, the place and the remedy.
struct Error {
    Errc code = Errc::InvalidArgument;
    std::string what;

    friend bool operator==(const Error&, const Error&) = default;
};

const std::error_category& errorCategory();
std::error_code make_error_code(Errc code);
inline std::error_code make_error_code(const Error& error) { return make_error_code(error.code); }

/// A value or an Error. `if (!result) use(result.error().what)`; value() on a failure is a bug and throws.
template <typename T = void>
using Result = boost::outcome_v2::basic_result<T, Error, boost::outcome_v2::policy::throw_bad_result_access<Error, void>>;

/// `return fail(Errc::NoLink, "…")` from any function that returns a Result.
inline auto fail(Errc code, std::string what) { return boost::outcome_v2::failure(Error{code, std::move(what)}); }
inline auto ok() { return boost::outcome_v2::success(); }

} // namespace liena

template <>
struct std::is_error_code_enum<liena::Errc> : std::true_type {};
