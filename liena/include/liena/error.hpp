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
    InvalidArgument = 1,
    FileUnreadable,
    FileUnwritable,
    XmlInvalid,
    MessageSetInvalid,
    TopologyInvalid,
    CertificateInvalid,
    AddressUnavailable,
    NetworkFailure,
    UnknownDevice,
    UnknownMessage,
    NoLink,
    NotOpen,
    NotYet,
    StandBy,
    NoIncident,
    Busy,
    Forbidden,
    ValueRefused,
    QueueFull,
    Stopped,
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
