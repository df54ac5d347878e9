// peer_openigtlink: OpenIGTLink messages on one blocking socket, as its examples do it: commands are a type of their own, frames are
// images.
#include "peers/threaded_link.hpp"
#include "workloads/peer.hpp"

#include <igtlClientSocket.h>
#include <igtlImageMessage.h>
#include <igtlMessageBase.h>
#include <igtlMessageHeader.h>
#include <igtlServerSocket.h>

#include <cstring>
#include <stdexcept>
#include <thread>

namespace liena::compare {

namespace {

constexpr int rowLength = 1024;

/// A body of 64 bytes as they are.
class CommandMessage final : public igtl::MessageBase {
public:
    using Self = CommandMessage;
    using Pointer = igtl::SmartPointer<Self>;
    using ConstPointer = igtl::SmartPointer<const Self>;

    igtlNewMacro(CommandMessage);

    Command command;

protected:
    CommandMessage() { m_DefaultBodyType = "COMPARE"; }
    int GetBodyPackSize() override { return sizeof command; }
    int PackBody() override
    {
        AllocatePack();
        std::memcpy(m_Body, &command, sizeof command);
        return 1;
    }
    int UnpackBody() override
    {
        std::memcpy(&command, m_Body, sizeof command);
        return 1;
    }
};

class IgtlLink final : public ThreadedLink {
public:
    explicit IgtlLink(const Options& options) : ThreadedLink(options), m_image(igtl::ImageMessage::New())
    {
        m_image->SetDimensions(rowLength, static_cast<int>(options.frameBytes / rowLength), 1);
        m_image->SetScalarTypeToUint8();
        m_image->SetDeviceName("frame");
        m_image->AllocateScalars();
    }

    ~IgtlLink() override
    {
        if (m_socket)
            m_socket->CloseSocket();
        if (m_reader.joinable())
            m_reader.join();
    }

    void sendCommand(const Command& command) override
    {
        auto message = CommandMessage::New();
        message->SetDeviceName("command");
        message->command = command;
        message->Pack();
        send(message->GetPackPointer(), message->GetPackSize());
    }

    void sendFrame(const Stamp& stamp) override
    {
        std::memcpy(m_image->GetScalarPointer(), &stamp, sizeof stamp);
        m_image->Pack();
        send(m_image->GetPackPointer(), m_image->GetPackSize());
    }

protected:
    void connect() override
    {
        if (isClient())
            connectToEcho();
        else
            awaitClient();
        if (m_socket)
            m_reader = std::thread([this] { read(); });
    }

private:
    void connectToEcho()
    {
        auto client = igtl::ClientSocket::New();
        while (client->ConnectToServer(options().host.c_str(), options().port) != 0 && !isStopped())
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        m_socket = client;
    }

    void awaitClient()
    {
        m_server = igtl::ServerSocket::New();
        if (m_server->CreateServer(options().port) != 0)
            throw std::runtime_error("cannot listen");
        constexpr unsigned long milliseconds = 100;
        while (!m_socket && !isStopped())
            m_socket = m_server->WaitForConnection(milliseconds);
    }

    void send(const void* bytes, int count)
    {
        const std::lock_guard lock(m_sending);
        m_socket->Send(bytes, count);
    }

    void read()
    {
        auto header = igtl::MessageHeader::New();
        for (;;) {
            header->InitPack();
            if (m_socket->Receive(header->GetPackPointer(), header->GetPackSize()) != header->GetPackSize())
                return;
            header->Unpack();
            const bool whole = std::strcmp(header->GetDeviceType(), "COMPARE") == 0 ? readCommand(header) : readFrame(header);
            if (!whole)
                return;
        }
    }

    /// Checks its CRC, too.
    template <typename Pointer>
    bool readBody(const Pointer& message, const igtl::MessageHeader::Pointer& header)
    {
        message->SetMessageHeader(header);
        message->AllocatePack();
        const auto size = message->GetPackBodySize();
        return m_socket->Receive(message->GetPackBodyPointer(), size) == size &&
               (message->Unpack(1) & igtl::MessageHeader::UNPACK_BODY) != 0;
    }

    bool readCommand(const igtl::MessageHeader::Pointer& header)
    {
        auto message = CommandMessage::New();
        if (!readBody(message, header))
            return false;
        received(message->command);
        return true;
    }

    bool readFrame(const igtl::MessageHeader::Pointer& header)
    {
        auto message = igtl::ImageMessage::New();
        if (!readBody(message, header))
            return false;
        Stamp stamp;
        std::memcpy(&stamp, message->GetScalarPointer(), sizeof stamp);
        received(stamp, static_cast<std::size_t>(message->GetImageSize()));
        return true;
    }

    igtl::ImageMessage::Pointer m_image;
    igtl::ServerSocket::Pointer m_server;
    igtl::Socket::Pointer m_socket;
    std::mutex m_sending;
    std::thread m_reader;
};

} // namespace

} // namespace liena::compare

int main(int argc, char** argv)
{
    using namespace liena::compare;
    runPeer(argc, argv, "OpenIGTLink", [](const Options& options) { return std::make_unique<IgtlLink>(options); });
}
