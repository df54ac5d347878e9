// peer_asio_tls: a bare Boost.Asio TLS 1.3 stream; both ends show a certificate, as LiENa's do.
#include "peers/asio_link.hpp"
#include "workloads/peer.hpp"

#include <boost/asio/ssl.hpp>

namespace liena::compare {

namespace {

namespace ssl = boost::asio::ssl;

class AsioTls final : public AsioLink<ssl::stream<boost::asio::ip::tcp::socket>> {
public:
    explicit AsioTls(const Options& options) : AsioLink(options), m_context(ssl::context::tlsv13)
    {
        const auto name = options.files / "pki" / (options.role == Role::Client ? "near" : "far");
        m_context.use_certificate_chain_file(name.string() + ".crt");
        m_context.use_private_key_file(name.string() + ".key", ssl::context::pem);
        m_context.load_verify_file((options.files / "pki" / "ca.crt").string());
        m_context.set_verify_mode(ssl::verify_peer | ssl::verify_fail_if_no_peer_cert);
    }

private:
    std::unique_ptr<ssl::stream<Socket>> secured(Socket socket) override
    {
        auto stream = std::make_unique<ssl::stream<Socket>>(std::move(socket), m_context);
        stream->handshake(isClient() ? ssl::stream_base::client : ssl::stream_base::server);
        return stream;
    }

    ssl::context m_context;
};

} // namespace

} // namespace liena::compare

int main(int argc, char** argv)
{
    using namespace liena::compare;
    runPeer(argc, argv, "Asio TLS", [](const Options& options) { return std::make_unique<AsioTls>(options); });
}
