// The X-ray system as a device: the picture thread.
#include "xray_device.hpp"

#include <algorithm>

namespace liena::devices {

XrayDevice::~XrayDevice()
{
    {
        const std::unique_lock lock(m_mutex);
        m_stopping = true;
    }
    m_wake.notify_one();
    if (m_thread.joinable())
        m_thread.join();
}

void XrayDevice::takePictures()
{
    std::unique_lock lock(m_mutex);
    SteadyTime pulse;
    while (!m_stopping) {
        if (!m_machine.beamOn()) {
            m_wake.wait(lock, [this] { return m_stopping || m_machine.beamOn(); });
            pulse = std::chrono::steady_clock::now();
            continue;
        }
        if (m_wake.wait_until(lock, pulse, [this] { return m_stopping || !m_machine.beamOn(); }))
            continue;
        const auto period = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(1 / m_machine.pulseRate()));
        pulse = std::max(pulse + period, std::chrono::steady_clock::now()); // a pulse that was missed is not made up for
        takeOne(lock);
    }
}

void XrayDevice::takeOne(std::unique_lock<std::mutex>& lock)
{
    const Exposure exposure{std::chrono::steady_clock::now().time_since_epoch(), m_machine.mode(), m_machine.acquisition(),
                            m_machine.geometry(), m_instruments};
    m_machine.pulsed();
    const std::uint64_t frame = ++m_books.acquired;
    lock.unlock();
    const bool sent = produce(exposure, frame);
    lock.lock();
    ++(sent ? m_books.sent : m_books.withheld);
}

bool XrayDevice::produce(const Exposure& exposure, std::uint64_t frame)
{
    const Timestamp captured = Timestamp::now();
    if (const auto taken = m_source->next(exposure, m_picture); !taken) {
        complain(taken.error().what);
        return false;
    }
    const auto pixels = m_encoder.encode(m_picture);
    if (!pixels) {
        complain(pixels.error().what);
        return false;
    }
    return deliver(compose(exposure, frame, pixels.value(), captured));
}

Message XrayDevice::compose(const Exposure& exposure, std::uint64_t frame, std::span<const std::byte> pixels, Timestamp captured) const
{
    const PictureFormat& format = m_picture.format;
    Message message = m_system.report("XrayFrame").value();
    message.set("frame", static_cast<std::uint32_t>(frame)).set("acquisition", exposure.acquisition).set("capture_ns", captured.ns);
    message.set("source", format.source).set("rows", format.rows).set("columns", format.columns).set("bits_stored", format.bitsStored);
    message.set("photometric", format.photometric).set("encoding", m_encoder.encoding()).set("quality", m_encoder.quality());
    message.set("pixel_intensity_relationship", format.relationship).set("imager_pixel_spacing", format.imagerPixelSpacing);
    message.set("window_centre", format.windowCentre).set("window_width", format.windowWidth);
    message.set("primary_angle", format.primaryAngle).set("secondary_angle", format.secondaryAngle);
    message.set("source_detector_distance", format.sourceDetectorDistance).set("source_object_distance", format.sourceObjectDistance);
    message.set("mask", format.mask).set("pixels", pixels);
    return message;
}

// To those who look at pictures: the robot on the same network needs none.
bool XrayDevice::deliver(Message message)
{
    bool sent = false;
    for (const DeviceId viewer : m_viewers) {
        const auto accepted = viewer == m_viewers.back() ? m_system.send(viewer, std::move(message)) : m_system.send(viewer, message);
        sent = sent || static_cast<bool>(accepted);
        if (!accepted && accepted.error().code == Errc::ValueRefused)
            complain(accepted.error().what);
    }
    return sent;
}

// Once per cause, not once per picture.
void XrayDevice::complain(const std::string& what)
{
    if (std::exchange(m_lastComplaint, what) != what)
        m_log(LogLevel::Error, what);
}

} // namespace liena::devices
