// Names and the category of the library's errors.
#include "liena/error.hpp"

namespace liena {

std::string_view toString(Errc code)
{
    switch (code) {
    case Errc::InvalidArgument:
        return "invalid argument";
    case Errc::FileUnreadable:
        return "file unreadable";
    case Errc::FileUnwritable:
        return "file unwritable";
    case Errc::XmlInvalid:
        return "XML invalid";
    case Errc::MessageSetInvalid:
        return "message set invalid";
    case Errc::TopologyInvalid:
        return "topology invalid";
    case Errc::CertificateInvalid:
        return "certificate invalid";
    case Errc::AddressUnavailable:
        return "address unavailable";
    case Errc::NetworkFailure:
        return "network failure";
    case Errc::UnknownDevice:
        return "unknown device";
    case Errc::UnknownMessage:
        return "unknown message";
    case Errc::NoLink:
        return "no link";
    case Errc::NotOpen:
        return "not open";
    case Errc::NotYet:
        return "not yet";
    case Errc::StandBy:
        return "stand-by";
    case Errc::NoIncident:
        return "no incident";
    case Errc::Busy:
        return "busy";
    case Errc::Forbidden:
        return "forbidden";
    case Errc::ValueRefused:
        return "value refused";
    case Errc::QueueFull:
        return "queue full";
    case Errc::Stopped:
        return "stopped";
    }
    return "unknown error";
}

namespace {

class Category final : public std::error_category {
public:
    const char* name() const noexcept override { return "liena"; }
    std::string message(int value) const override { return std::string(toString(static_cast<Errc>(value))); }
};

} // namespace

const std::error_category& errorCategory()
{
    static const Category category;
    return category;
}

std::error_code make_error_code(Errc code) { return {static_cast<int>(code), errorCategory()}; }

} // namespace liena
