// Any bytes as the body of any session message: what is read is written again byte for byte.
#include "fuzz_input.hpp"
#include "fuzz_target.hpp"
#include "protocol/session_messages.hpp"

#include <vector>

using namespace liena::protocol;
using namespace liena::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    FuzzInput input(data, size);
    const std::uint16_t number = input.number<std::uint8_t>();
    const auto body = input.rest();
    const auto maximum = maximumSessionBody(number);
    const auto message = decodeSessionMessage(number, body);
    if (!message)
        return 0;
    expect(maximum.has_value() && body.size() <= *maximum, "what is read has a maximum and is within it");
    expect(numberOf(*message) == number && !nameOf(*message).empty(), "what is read is the message asked for");
    const auto again = encodeSessionMessage(*message);
    expect(std::equal(again.begin(), again.end(), body.begin(), body.end()), "what is read is written again");
    expect(!decodeSessionMessage(number, body.first(body.size() - 1)), "a byte less is another message");
    std::vector<std::byte> longer(body.begin(), body.end());
    longer.push_back(std::byte{0});
    expect(!decodeSessionMessage(number, longer), "a byte more is another message");
    return 0;
}
