// Encoding and decoding of the session-management set by one visitor each way.
#include "protocol/session_messages.hpp"

#include "protocol/byte_reader.hpp"
#include "protocol/byte_writer.hpp"
#include "protocol/information_part.hpp"

#include <algorithm>
#include <utility>

namespace liena::protocol {

namespace {

bool isDeclared(RejectReason reason) { return reason >= RejectReason::UnknownPeer && reason <= RejectReason::NotAdmitted; }
bool isDeclared(SessionState state) { return state >= SessionState::Opening && state <= SessionState::Closing; }
bool isDeclared(LossCause cause) { return cause >= LossCause::HeartbeatLost && cause <= LossCause::LocalStall; }
bool isDeclared(MeasureVerdict verdict) { return verdict >= MeasureVerdict::Granted && verdict <= MeasureVerdict::Ended; }
bool isDeclared(ProbeWay way) { return way >= ProbeWay::Prompt && way <= ProbeWay::Image; }

std::string_view cutUtf8(std::string_view text, std::size_t maximum)
{
    if (text.size() <= maximum)
        return text;
    while (maximum > 0 && (static_cast<unsigned char>(text[maximum]) & 0xC0U) == 0x80U)
        --maximum;
    return text.substr(0, maximum);
}

class Encoder {
public:
    explicit Encoder(std::vector<std::byte>& bytes) : m_writer(bytes) {}

    template <typename T>
    requires std::is_arithmetic_v<T>
    void operator()(T value) { m_writer.write(value); }
    void operator()(bool value) { m_writer.write(static_cast<std::uint8_t>(value ? 1 : 0)); }
    template <typename T>
    requires std::is_enum_v<T>
    void operator()(T value) { m_writer.write(static_cast<std::underlying_type_t<T>>(value)); }
    void operator()(DeviceId id) { m_writer.write(id.value()); }
    void operator()(const Sha256& hash) { m_writer.append(std::as_bytes(std::span(hash.bytes))); }
    template <std::size_t Maximum>
    void operator()(const Text<Maximum>& text)
    {
        const auto cut = cutUtf8(text.value, Maximum);
        m_writer.write(static_cast<std::uint16_t>(cut.size())).append(cut);
    }
    void operator()(const std::vector<std::byte>& bytes)
    {
        m_writer.write(static_cast<std::uint32_t>(bytes.size())).append(std::span(bytes));
    }
    template <std::size_t Maximum>
    void operator()(const Bytes<Maximum>& bytes)
    {
        (*this)(bytes.value);
    }

private:
    ByteWriter<std::vector<std::byte>> m_writer;
};

class Decoder {
public:
    explicit Decoder(std::span<const std::byte> bytes) : m_reader(bytes) {}

    template <typename T>
    requires std::is_arithmetic_v<T>
    void operator()(T& value) { value = m_reader.read<T>(); }
    void operator()(bool& value)
    {
        const auto byte = m_reader.read<std::uint8_t>();
        m_ok = m_ok && byte <= 1;
        value = byte == 1;
    }
    template <typename T>
    requires std::is_enum_v<T>
    void operator()(T& value)
    {
        value = static_cast<T>(m_reader.read<std::underlying_type_t<T>>());
        m_ok = m_ok && isDeclared(value);
    }
    void operator()(DeviceId& id) { id = DeviceId(m_reader.read<std::uint32_t>()); }
    void operator()(Sha256& hash)
    {
        const auto bytes = m_reader.take(hash.bytes.size());
        if (m_reader.ok())
            std::transform(bytes.begin(), bytes.end(), hash.bytes.begin(), [](std::byte b) { return static_cast<std::uint8_t>(b); });
    }
    template <std::size_t Maximum>
    void operator()(Text<Maximum>& text)
    {
        const std::size_t length = m_reader.read<std::uint16_t>();
        m_ok = m_ok && length <= Maximum;
        const auto bytes = m_reader.takeText(m_ok ? length : 0);
        m_ok = m_ok && isUtf8(bytes);
        text.value = bytes;
    }
    void operator()(std::vector<std::byte>& value) { readBytes(value, maximumSetBytes); }
    template <std::size_t Maximum>
    void operator()(Bytes<Maximum>& bytes)
    {
        readBytes(bytes.value, Maximum);
    }

    bool complete() const { return m_ok && m_reader.atEnd(); }

private:
    void readBytes(std::vector<std::byte>& value, std::size_t maximum)
    {
        const std::size_t length = m_reader.read<std::uint32_t>();
        m_ok = m_ok && length <= maximum;
        const auto bytes = m_reader.take(m_ok ? length : 0);
        value.assign(bytes.begin(), bytes.end());
    }

    ByteReader m_reader;
    bool m_ok = true;
};

/// Adds up the largest size of each field.
class Measure {
public:
    template <typename T>
    void operator()(const T&)
    {
        if constexpr (std::is_same_v<T, Sha256>)
            size += 32;
        else if constexpr (std::is_same_v<T, std::vector<std::byte>>)
            size += 4 + maximumSetBytes;
        else
            size += sizeof(T);
    }
    template <std::size_t Maximum>
    void operator()(const Text<Maximum>&)
    {
        size += 2 + Maximum;
    }
    template <std::size_t Maximum>
    void operator()(const Bytes<Maximum>&)
    {
        size += 4 + Maximum;
    }
    std::size_t size = 0;
};

/// Calls `use(T{})` for the session message type T with that number, if there is one.
template <typename Use, std::size_t... I>
void withType(std::uint16_t number, Use&& use, std::index_sequence<I...> /*types*/)
{
    const auto tryOne = [&]<typename T>(T&& candidate) {
        if (std::remove_cvref_t<T>::number == number)
            use(std::forward<T>(candidate));
    };
    (tryOne(std::variant_alternative_t<I, SessionMessage>{}), ...);
}

using EveryType = std::make_index_sequence<std::variant_size_v<SessionMessage>>;

} // namespace

std::uint16_t numberOf(const SessionMessage& message)
{
    return std::visit([](const auto& m) { return m.number; }, message);
}

std::string_view nameOf(const SessionMessage& message)
{
    static constexpr std::array<std::string_view, std::variant_size_v<SessionMessage>> names{"Attach",
                                                                                             "Handshake",
                                                                                             "HandshakeCommit",
                                                                                             "MessageSetRequest",
                                                                                             "MessageSet",
                                                                                             "ChannelOpened",
                                                                                             "Rejected",
                                                                                             "Heartbeat",
                                                                                             "Disengagement",
                                                                                             "DisengagementCommit",
                                                                                             "ChannelClosed",
                                                                                             "DiagnosisHandshake",
                                                                                             "DiagnosisHandshakeCommit",
                                                                                             "ChannelReOpened",
                                                                                             "StandBy",
                                                                                             "StandByReport",
                                                                                             "IncidentDismissed",
                                                                                             "LinkReport",
                                                                                             "Abandon",
                                                                                             "MeasureRequest",
                                                                                             "MeasureAnswer",
                                                                                             "Probe",
                                                                                             "ProbeEcho"};
    return names[message.index()];
}

std::optional<std::size_t> maximumSessionBody(std::uint16_t number)
{
    std::optional<std::size_t> size;
    withType(
        number,
        [&](auto message) {
            Measure measure;
            message.visit(measure);
            size = measure.size;
        },
        EveryType{});
    return size;
}

std::vector<std::byte> encodeSessionMessage(const SessionMessage& message)
{
    std::vector<std::byte> bytes;
    bytes.reserve(64);
    std::visit([&](auto copy) { copy.visit(Encoder(bytes)); }, message);
    return bytes;
}

std::optional<SessionMessage> decodeSessionMessage(std::uint16_t number, std::span<const std::byte> body)
{
    std::optional<SessionMessage> result;
    withType(
        number,
        [&](auto message) {
            Decoder decoder(body);
            message.visit(decoder);
            if (decoder.complete())
                result = std::move(message);
        },
        EveryType{});
    return result;
}

} // namespace liena::protocol
