// From bytes of a peer to a set in the store.
#include "system/set_keeper.hpp"

#include "base/ordinary_thread.hpp"
#include "liena/log.hpp"

#include <boost/asio/post.hpp>

#include <fmt/format.h>

#include <exception>
#include <utility>

namespace liena::system {

namespace asio = boost::asio;
using session::SetStanding;

void SetKeeper::learn(DeviceId peer, const Sha256& hash, std::vector<std::byte> xml, Done done)
{
    try {
        if (!m_thread) {
            auto started = m_start();
            asio::post(*started, base::runAsOrdinaryThread); // a peer's set must not be checked at the network thread's priority
            m_thread = std::move(started);
        }
    } catch (const std::exception& none) {
        asio::post(m_io, [why = fmt::format("no thread can be had to check the message set: {}", none.what()), done = std::move(done)] {
            done({SetStanding::Invalid, why});
        });
        return;
    }
    asio::post(*m_thread, [this, peer, hash, xml = std::move(xml), done = std::move(done)] {
        asio::post(m_io, [heard = keep(peer, hash, xml), done] { done(heard); });
    });
}

void SetKeeper::finish()
{
    if (m_thread)
        m_thread->join();
    m_thread.reset();
}

session::SetHeard SetKeeper::keep(DeviceId peer, const Sha256& hash, const std::vector<std::byte>& xml)
{
    if (Sha256::of(xml) != hash)
        return {SetStanding::Invalid, "the message set's bytes do not have the hash that was announced"};
    const std::string_view text(reinterpret_cast<const char*>(xml.data()), xml.size());
    auto parsed = MessageSet::parse(text, "message set of " + peer.toString());
    if (!parsed)
        return {SetStanding::Invalid, printable(parsed.error().what, 400)};
    if (parsed.value()->deviceType() != peer.deviceType())
        return {SetStanding::Invalid,
                fmt::format("the message set is that of {}, the device is {}", parsed.value()->deviceType().toString(), peer.toString())};
    if (!m_store)
        return {SetStanding::Invalid, "there is no local store to keep the message set in"};
    // Before it is written, so that a set which is not taken leaves nothing behind.
    const auto pin = m_store->pinFor(peer.deviceType());
    if (!pin)
        return {SetStanding::Invalid, pin.error().what};
    if (pin.value() && pin.value()->hash != hash)
        return {SetStanding::Changed, "another message set was accepted for this type of device"};
    if (auto saved = m_store->save(*parsed.value()); !saved)
        return {SetStanding::Invalid, saved.error().what};
    const auto pinned = m_store->pinFirst(peer.deviceType(), hash);
    if (!pinned)
        return {SetStanding::Invalid, pinned.error().what};
    if (pinned.value() != hash)
        return {SetStanding::Changed, "another message set was accepted for this type of device"};
    return {SetStanding::Held, {}};
}

} // namespace liena::system
