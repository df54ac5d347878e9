// Pictures as an X-ray system sends them, at their rate.
#include "film.hpp"

#include <charls/charls.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace console::test {

namespace {

std::vector<std::byte> rawBytes(const Film& film, unsigned seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 0.01);
    const double largest = (1 << film.bits) - 1;
    std::vector<std::byte> raw;
    for (int y = 0; y < film.edge; ++y)
        for (int x = 0; x < film.edge; ++x) {
            const double share = 0.5 + 0.3 * std::sin(x / 90.0) * std::cos(y / 70.0) + noise(random);
            const auto value = static_cast<unsigned>(std::clamp(share, 0.0, 1.0) * largest);
            raw.push_back(static_cast<std::byte>(value & 0xFFU));
            if (film.bits > 8)
                raw.push_back(static_cast<std::byte>(value >> 8U));
        }
    return raw;
}

std::vector<std::byte> filmBytes(const Film& film, unsigned seed)
{
    const auto raw = rawBytes(film, seed);
    if (film.encoding == PixelEncoding::Raw)
        return raw;
    charls::jpegls_encoder encoder;
    const auto edge = static_cast<std::uint32_t>(film.edge);
    encoder.frame_info({edge, edge, film.bits, 1});
    std::vector<std::byte> bytes(encoder.estimated_destination_size());
    encoder.destination(bytes.data(), bytes.size());
    bytes.resize(encoder.encode(raw.data(), raw.size()));
    return bytes;
}

} // namespace

XrayGeometry filmGeometry() { return XrayGeometry{0, 0, 1100, 750, {}}; }

XrayFrame filmFrame(const Film& film, unsigned seed)
{
    const auto bytes = std::make_shared<const std::vector<std::byte>>(filmBytes(film, seed));
    XrayFrame frame;
    frame.rows = frame.columns = film.edge;
    frame.bitsStored = film.bits;
    frame.encoding = film.encoding;
    frame.source = PictureSource::Simulated;
    frame.windowCentre = 1 << (film.bits - 1);
    frame.windowWidth = 1 << film.bits;
    frame.imagerPixelSpacing = 300.0 / film.edge;
    frame.geometry = filmGeometry();
    frame.owner = bytes;
    frame.pixels = *bytes;
    return frame;
}

FilmSender::FilmSender(const Film& film, FrameSink& sink, std::optional<Duration> span)
    : m_period(std::chrono::nanoseconds(std::chrono::seconds(1)) / film.framesPerSecond),
      m_pictures{filmFrame(film, 7), filmFrame(film, 8)},
      m_span(span),
      m_sink(sink),
      m_thread([this] { run(); })
{}

FilmSender::~FilmSender()
{
    m_ending = true;
    m_thread.join();
}

void FilmSender::run()
{
    const Instant begun = std::chrono::steady_clock::now();
    Instant due = begun;
    for (quint32 number = 1; !m_span || due < begun + *m_span; ++number, due += m_period) {
        std::this_thread::sleep_until(due);
        if (m_ending)
            return;
        auto frame = std::make_shared<XrayFrame>(m_pictures[number % 2]);
        frame->frame = number;
        frame->captureNs = static_cast<quint64>(m_period.count()) * number;
        frame->arrival = std::chrono::steady_clock::now();
        frame->ageAtArrival = Duration::zero();
        m_sink.showFrame(std::move(frame));
    }
}

} // namespace console::test
