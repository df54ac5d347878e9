// Reads a topology and issues a certificate for each of its devices: XML, hashes, OpenSSL and text formatting, all from the package.
#include <liena/certificates.hpp>
#include <liena/system_topology.hpp>
#include <liena/version.hpp>

#include <chrono>
#include <cstdio>

int main(int argc, char** argv)
{
    if (argc != 3)
        return 2;
    const auto topology = liena::SystemTopology::load(argv[1]);
    const auto authority = liena::CertificateAuthority::create(argv[2], "Consumer", std::chrono::hours(72));
    if (!topology || !authority) {
        std::fprintf(stderr, "%s\n", (topology ? authority.error() : topology.error()).what.c_str());
        return 1;
    }
    const std::filesystem::path folder(argv[2]);
    for (const auto& device : topology.value().devices()) {
        const auto issued = authority.value().issue(device.id, device.name, std::chrono::hours(48));
        const auto usable =
            liena::checkIdentity(folder / (device.name + ".crt"), folder / (device.name + ".key"), folder / "ca.crt", device.id);
        if (!issued || !usable)
            return 1;
        std::printf("%s %s\n", device.id.toString().c_str(), device.name.c_str());
    }
    std::printf("liena %s: %zu devices of %s\n", liena::versionText, topology.value().devices().size(), topology.value().name().c_str());
}
