// The X-ray system with a ladder: implementation.
#include "device/fluoroscopy_part.hpp"

#include "device/line_log.hpp"

#include <array>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <utility>

namespace liena::lab {

namespace {

/// The same noise, moved on with each picture.
class GreySource : public devices::ImageSource {
public:
    GreySource()
    {
        std::mt19937 random(1);
        std::normal_distribution<double> noise(0, 12);
        for (auto& value : m_noise)
            value = static_cast<int>(noise(random));
    }

    std::string describe() const override { return "grey with noise, for the lab"; }

    Result<void> next(const devices::Exposure& /*exposure*/, devices::Picture& picture) override
    {
        constexpr std::uint16_t edge = 512;
        picture.format.rows = picture.format.columns = edge;
        picture.format.bitsStored = 16;
        picture.format.windowCentre = 2511; // in which the noise is seen, as in a real picture
        picture.format.windowWidth = 1100;
        picture.pixels.resize(std::size_t{edge} * edge);
        m_moved = (m_moved + 977) % m_noise.size();
        for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
            const auto grey = static_cast<int>(2000 + i / edge + i % edge);
            picture.pixels[i] = static_cast<std::uint16_t>(grey + m_noise[(i + m_moved) % m_noise.size()]);
        }
        return ok();
    }

private:
    std::array<int, 65536> m_noise{};
    std::size_t m_moved = 0;
};

} // namespace

FluoroscopyPart::FluoroscopyPart(DistributedSystem& system)
{
    devices::XrayOptions options;
    options.source = std::make_unique<GreySource>();
    auto made = devices::XrayDevice::create(system, std::move(options), [](LogLevel level, std::string_view line) {
        tell({"log", toString(level), line});
    });
    if (!made)
        throw std::runtime_error(made.error().what);
    m_device = std::move(made.value());
}

} // namespace liena::lab
