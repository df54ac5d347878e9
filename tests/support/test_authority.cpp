// Certificates for tests, issued on demand.
#include "support/test_authority.hpp"

#include <stdexcept>

namespace liena::test {

namespace {

constexpr auto oneDay = std::chrono::hours(24); // sessions open with more than that

} // namespace

TestAuthority::TestAuthority()
{
    auto made = CertificateAuthority::create(folder(), "Test site", 3 * oneDay);
    if (!made)
        throw std::runtime_error(made.error().what);
    m_authority = std::move(made.value());
}

IdentityFiles TestAuthority::identityOf(DeviceId device, const std::string& name)
{
    IdentityFiles files{folder() / (name + ".crt"), folder() / (name + ".key"), certificate()};
    if (std::filesystem::exists(files.certificate))
        return files;
    if (const auto issued = m_authority->issue(device, name, 2 * oneDay); !issued)
        throw std::runtime_error(issued.error().what);
    return files;
}

} // namespace liena::test
