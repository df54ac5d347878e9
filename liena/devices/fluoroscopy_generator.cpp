// Computed fluoroscopy: implementation.
#include "fluoroscopy_generator.hpp"

#include "head_phantom.hpp"

#include <algorithm>
#include <cmath>

namespace liena::devices {

namespace {

constexpr double contrastAttenuation = 0.28; // 1/mm, undiluted
constexpr double referenceValue = 800;       // of 4095, behind the middle of the head
constexpr double fullScale = 4095;
constexpr std::size_t noiseCount = 1U << 16U;

Vector middleOf(const VesselTree& tree)
{
    Vector low = tree.points.front().position;
    Vector high = low;
    for (const auto& point : tree.points) {
        low = {std::min(low.x, point.position.x), std::min(low.y, point.position.y), std::min(low.z, point.position.z)};
        high = {std::max(high.x, point.position.x), std::max(high.y, point.position.y), std::max(high.z, point.position.z)};
    }
    const auto surrounds = [](double from, double to) { return from < 0 && to > 0; };
    if (surrounds(low.x, high.x) && surrounds(low.y, high.y) && surrounds(low.z, high.z))
        return {};
    return (low + high) * 0.5;
}

} // namespace

FluoroscopyGenerator::FluoroscopyGenerator(VesselTree tree, int size, std::uint64_t seed)
    : m_tree(std::move(tree)),
      m_way(m_tree),
      m_isocentre(middleOf(m_tree)),
      m_size(size),
      m_noise(seed),
      m_noiseTable(noiseCount + size),
      m_concentration(m_tree.points.size())
{
    std::generate_n(m_noiseTable.begin(), noiseCount, [this] { return static_cast<float>(m_noise.normal()); });
    std::copy_n(m_noiseTable.begin(), size, m_noiseTable.begin() + noiseCount); // a row may begin anywhere
    const std::size_t pixels = static_cast<std::size_t>(size) * size;
    m_lines.resize(pixels);
    m_quanta.resize(pixels);
    m_smooth.resize(pixels);
}

std::string FluoroscopyGenerator::describe() const
{
    return "computed fluoroscopy, " + std::to_string(m_size) + " x " + std::to_string(m_size) + ", 12 bits, " +
           std::to_string(m_tree.points.size()) + " vessel points";
}

void FluoroscopyGenerator::project(const CArmGeometry& geometry)
{
    if (m_geometry == geometry)
        return;
    m_geometry = geometry;
    m_projection.emplace(geometry, m_isocentre, m_size);
    m_background = headAttenuation(*m_projection, m_isocentre);
    for (float& line : m_background)
        line = std::exp(-line);
    m_crossings = vesselShadow(*m_projection, m_tree);
    collimate();
    control();
}

// Four lead blades just inside the detector's edges; a little comes through them.
void FluoroscopyGenerator::collimate()
{
    constexpr float leak = 0.004F;
    const int blade = std::max(1, m_size / 40);
    for (int row = 0; row < m_size; ++row)
        for (int column = 0; column < m_size; ++column)
            if (std::min({row, column, m_size - 1 - row, m_size - 1 - column}) < blade)
                m_background[static_cast<std::size_t>(row) * m_size + column] *= leak;
}

// What the exposure control and the window are set to: the middle of the picture without instruments and contrast.
void FluoroscopyGenerator::control()
{
    std::vector<float> middle;
    for (int row = m_size / 4; row < m_size * 3 / 4; row += 2)
        for (int column = m_size / 4; column < m_size * 3 / 4; column += 2)
            middle.push_back(m_background[static_cast<std::size_t>(row) * m_size + column]);
    const auto at = [&](double part) {
        const auto place = middle.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(middle.size() - 1));
        std::nth_element(middle.begin(), place, middle.end());
        return static_cast<double>(*place);
    };
    m_reference = std::max(1e-9, at(0.5));
    const double gain = referenceValue / m_reference;
    const double low = 0.35 * at(0.02) * gain; // contrast and wire are darker than anything in the head
    const double high = std::min(fullScale, 1.25 * at(0.98) * gain);
    m_windowWidth = std::max(100.0, high - low);
    m_windowCentre = (high + low) / 2;
}

double FluoroscopyGenerator::quantaPerPixel(AcquisitionMode mode) const
{
    const double spacing = m_projection->pixelSpacing();
    const double perSquareMillimetre = mode == AcquisitionMode::Acquisition ? 9000 : mode == AcquisitionMode::Spin ? 2200 : 900;
    return perSquareMillimetre * spacing * spacing;
}

// Between two runs the beam was off for as long as it pleased: an injection may have ended long before this pulse.
void FluoroscopyGenerator::observeContrast(const Exposure& exposure)
{
    const double flow = exposure.instruments.contrastFlow;
    if (m_acquisition == exposure.acquisition)
        m_flow.observe(exposure.time, flow);
    else
        m_flow.observeAfterPause(exposure.time, flow);
}

void FluoroscopyGenerator::addContrast(const InstrumentView& instruments)
{
    if (!m_flow.present())
        return;
    const double tip = instruments.catheter;
    for (std::size_t point = 0; point < m_tree.points.size(); ++point) {
        const bool downstream = m_way.leaves()[point] >= tip;
        m_concentration[point] =
            downstream ? static_cast<float>(m_flow.concentration(m_way.distances()[point] - tip) * contrastAttenuation) : 0;
    }
    for (const VesselCrossing& crossing : m_crossings)
        m_lines[crossing.pixel] += m_concentration[crossing.point] * crossing.thickness;
}

void FluoroscopyGenerator::expose(double quanta)
{
    const auto scale = static_cast<float>(quanta / m_reference);
    for (int row = 0; row < m_size; ++row) {
        const std::size_t start = static_cast<std::size_t>(row) * m_size;
        const float* noise = &m_noiseTable[m_noise.bits() % noiseCount];
        for (int column = 0; column < m_size; ++column) {
            const std::size_t pixel = start + column;
            float expected = m_background[pixel] * scale;
            if (m_lines[pixel] > 0)
                expected *= std::exp(-m_lines[pixel]);
            m_quanta[pixel] = std::max(0.0F, expected + std::sqrt(expected) * noise[column]);
        }
    }
}

// The scintillator spreads each quantum's light over its neighbours: 1 6 1 in both directions.
void FluoroscopyGenerator::blurInto(std::vector<std::uint16_t>& pixels, double gain)
{
    const std::size_t count = m_quanta.size();
    const auto edge = static_cast<std::size_t>(m_size);
    const auto mix = [](float a, float b, float c) { return (a + 6 * b + c) * 0.125F; };
    for (std::size_t pixel = 0; pixel < count; ++pixel)
        m_smooth[pixel] = mix(m_quanta[pixel > 0 ? pixel - 1 : 0], m_quanta[pixel], m_quanta[pixel + 1 < count ? pixel + 1 : pixel]);
    const auto factor = static_cast<float>(gain);
    for (std::size_t pixel = 0; pixel < count; ++pixel) {
        const float above = m_smooth[pixel >= edge ? pixel - edge : pixel];
        const float below = m_smooth[pixel + edge < count ? pixel + edge : pixel];
        const float value = mix(above, m_smooth[pixel], below) * factor + 0.5F;
        pixels[pixel] = static_cast<std::uint16_t>(std::min(value, static_cast<float>(fullScale)));
    }
}

void FluoroscopyGenerator::describePicture(const Exposure& exposure, PictureFormat& format)
{
    if (m_acquisition != exposure.acquisition)
        m_contrastSeen = false;
    m_acquisition = exposure.acquisition;
    m_contrastSeen = m_contrastSeen || m_flow.present();
    format.rows = static_cast<std::uint16_t>(m_size);
    format.columns = static_cast<std::uint16_t>(m_size);
    format.bitsStored = 12;
    format.photometric = Photometric::Monochrome2;
    format.relationship = IntensityRelationship::Linear;
    format.source = PictureSource::Simulated;
    format.imagerPixelSpacing = m_projection->pixelSpacing();
    format.windowCentre = m_windowCentre;
    format.windowWidth = m_windowWidth;
    format.primaryAngle = exposure.geometry.primaryAngle;
    format.secondaryAngle = exposure.geometry.secondaryAngle;
    format.sourceDetectorDistance = exposure.geometry.sourceDetectorDistance;
    format.sourceObjectDistance = exposure.geometry.sourceObjectDistance;
    format.mask = exposure.mode == AcquisitionMode::Acquisition && !m_contrastSeen;
}

Result<void> FluoroscopyGenerator::next(const Exposure& exposure, Picture& picture)
{
    project(exposure.geometry);
    observeContrast(exposure);
    std::fill(m_lines.begin(), m_lines.end(), 0.0F);
    addInstruments(*m_projection, m_way, exposure.instruments, m_lines);
    addContrast(exposure.instruments);
    const double quanta = quantaPerPixel(exposure.mode);
    expose(quanta);
    picture.pixels.resize(m_quanta.size());
    blurInto(picture.pixels, referenceValue / quanta);
    describePicture(exposure, picture.format);
    return ok();
}

} // namespace liena::devices
