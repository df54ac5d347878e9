// peer_asio: a bare Boost.Asio socket.
#include "peers/asio_link.hpp"
#include "workloads/peer.hpp"

namespace liena::compare {

namespace {

class AsioPlain final : public AsioLink<boost::asio::ip::tcp::socket> {
public:
    using AsioLink::AsioLink;

private:
    std::unique_ptr<Socket> secured(Socket socket) override { return std::make_unique<Socket>(std::move(socket)); }
};

} // namespace

} // namespace liena::compare

int main(int argc, char** argv)
{
    using namespace liena::compare;
    runPeer(argc, argv, "Asio", [](const Options& options) { return std::make_unique<AsioPlain>(options); });
}
