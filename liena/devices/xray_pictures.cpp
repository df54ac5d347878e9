// The X-ray system as a device: the picture thread.
#include "xray_device.hpp"

#include <algorithm>

namespace liena::devices {

namespace {

// One broken picture of a recording is no reason to end the run, as pictures come before and after it.
constexpr unsigned mostWithoutPicture = 3;

} // namespace

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
        takeOne(lock);
        const auto period = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(1 / m_machine.pulseRate()));
        pulse = std::max(pulse + period, std::chrono::steady_clock::now()); // a pulse that was missed is not made up for
    }
}

void XrayDevice::takeOne(std::unique_lock<std::mutex>& lock)
{
    const bool changed = chooseRung();
    const Exposure exposure{std::chrono::steady_clock::now().time_since_epoch(),
                            m_machine.mode(),
                            m_machine.acquisition(),
                            m_machine.geometry(),
                            m_instruments,
                            m_ladder.rung().divisor};
    m_machine.pulsed();
    const std::uint64_t frame = ++m_books.acquired;
    lock.unlock();
    if (changed)
        tellRung();
    else if (m_ladder.tookTooLong() && !std::exchange(m_saidLeftOut, true))
        m_log(LogLevel::Error,
              "pictures take longer to make here than until the next pulse, and nothing less is permitted: pulses are left out");
    const bool sent = produce(exposure, frame);
    lock.lock();
    ++(sent ? m_books.sent : m_books.withheld);
}

// By what the way to the viewers has carried until now; true when it has changed.
bool XrayDevice::chooseRung()
{
    const auto viewers = m_paths.read(m_links(), std::exchange(m_lost, {}));
    std::uint64_t gone = 0;
    for (const PathReading& viewer : viewers)
        gone = std::max(gone, viewer.withheld);
    gone = std::min(gone, m_books.sent);
    m_books.sent -= gone; // they were taken for sent
    m_books.withheld += gone;
    m_askedRate = m_machine.askedPulseRate();
    const bool changed = m_ladder.update(std::chrono::steady_clock::now(), m_askedRate, viewers);
    m_machine.thinPulses(m_ladder.rung().divisor);
    return changed;
}

void XrayDevice::tellRung()
{
    const bool failed = std::exchange(m_encodingFailed, false);
    const std::string_view why = failed                   ? "the encoding before failed"
                                 : m_ladder.tookTooLong() ? "pictures take longer to make here than until the next pulse"
                                                          : "the way to those who look does not carry more";
    const std::string now = describe(m_ladder.rung(), m_askedRate);
    if (m_ladder.step() == 0)
        m_log(LogLevel::Info, "pictures as asked for again: " + now);
    else
        m_log(LogLevel::Warning, "pictures reduced to " + now + " (step " + std::to_string(m_ladder.step()) + "): " + std::string(why));
}

bool XrayDevice::produce(const Exposure& exposure, std::uint64_t frame)
{
    const Timestamp captured = Timestamp::now();
    const auto begun = std::chrono::steady_clock::now();
    if (const auto taken = m_source->next(exposure, m_picture); !taken) {
        pictureFails(taken.error().what, "pictures cannot be taken");
        return false;
    }
    m_ladder.taken(std::chrono::steady_clock::now() - begun);
    const std::size_t unencoded = m_picture.pixels.size() * (m_picture.format.bitsStored > 8 ? 2 : 1);
    const auto other = m_ladder.toMeasure(std::chrono::steady_clock::now());
    if (other)
        m_spare = m_picture; // an encoding may change it
    m_encoder.use(m_ladder.rung().encoding, m_ladder.rung().quality);
    const auto encoding = std::chrono::steady_clock::now();
    const auto pixels = encode(m_encoder, m_picture);
    const auto now = std::chrono::steady_clock::now();
    if (pixels)
        m_ladder.measured(now, m_ladder.rung(), pixels.value()->size(), unencoded, now - encoding);
    else
        m_ladder.failed(now, m_ladder.rung());
    const bool sent = pixels && deliver(compose(exposure, frame, pixels.value(), captured));
    if (other) // after the picture has left: it makes none later; where none has, it may be the encoding that works
        measure(*other, unencoded);
    if (!pixels)
        encodingFails(pixels.error().what);
    return sent;
}

Result<EncodedPicture> XrayDevice::encode(FrameEncoder& encoder, Picture& picture) const
{
    auto pixels = m_encode(encoder, picture);
    if (pixels && pixels.value()->size() > m_mostBytes)
        return fail(Errc::ValueRefused, "an encoded picture is larger than the " + std::to_string(m_mostBytes) +
                                            " bytes that a message holds; permit lossless or lossy pictures, or choose smaller ones");
    return pixels;
}

// The next pulse is for another rung. Where none works, pulses would give dose and no picture: the run ends.
void XrayDevice::encodingFails(const std::string& what)
{
    complain(what);
    m_encodingFailed = m_ladder.works();
    if (!m_ladder.works())
        m_system.post([this] { endRun("pictures cannot be encoded"); });
}

// Another encoding would not help.
void XrayDevice::pictureFails(const std::string& what, std::string_view reason)
{
    complain(what);
    if (++m_without < mostWithoutPicture)
        return;
    m_without = 0;
    m_system.post([this, reason] { endRun(reason); });
}

Message XrayDevice::compose(const Exposure& exposure, std::uint64_t frame, const EncodedPicture& pixels, Timestamp captured) const
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
    message.set("rung", static_cast<std::uint8_t>(m_ladder.step())).set("rate", m_askedRate / m_ladder.rung().divisor);
    message.set("asked_rate", m_askedRate).set("asked_encoding", m_ladder.rungs().front().encoding);
    message.set("mask", format.mask).lend("pixels", pixels, *pixels);
    return message;
}

void XrayDevice::measure(const PictureRung& rung, std::size_t unencoded)
{
    m_measuring.use(rung.encoding, rung.quality);
    const auto begun = std::chrono::steady_clock::now();
    const auto pixels = encode(m_measuring, m_spare);
    const auto now = std::chrono::steady_clock::now();
    if (pixels)
        m_ladder.measured(now, rung, pixels.value()->size(), unencoded, now - begun);
    else
        m_ladder.failed(now, rung);
}

// To those who look at pictures: the robot on the same network needs none.
bool XrayDevice::deliver(Message message)
{
    if (message.fault()) {
        pictureFails(message.fault()->what, "pictures cannot be sent");
        return false;
    }
    m_without = 0;
    bool sent = false;
    for (const DeviceId viewer : m_viewers) {
        const auto accepted = viewer == m_viewers.back() ? m_system.send(viewer, std::move(message)) : m_system.send(viewer, message);
        sent = sent || static_cast<bool>(accepted);
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
