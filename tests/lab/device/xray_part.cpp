// The X-ray system of the lab: implementation.
#include "device/xray_part.hpp"

#include "device/line_log.hpp"
#include "device/picture.hpp"

namespace liena::lab {

bool XrayPart::obey(const std::string& verb, std::istringstream& rest)
{
    if (verb != "pictures")
        return false;
    long period = 0;
    rest >> m_size >> period;
    m_period = std::chrono::milliseconds(period);
    m_next = std::chrono::steady_clock::now();
    return true;
}

void XrayPart::tick(std::chrono::steady_clock::time_point now)
{
    if (m_size == 0 || now < m_next)
        return;
    m_next = now + m_period;
    auto picture = m_system.report("XrayFrame").value();
    const auto pixels = pictureOf(++m_frame, m_size);
    picture.set("frame", m_frame).set("pixels", std::span<const std::byte>(pixels));
    tell({"sent-picture", m_frame, m_system.publish(picture)});
}

} // namespace liena::lab
