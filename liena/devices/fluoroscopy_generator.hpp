// Computed fluoroscopy: a head, its vessels filling with contrast, and the instruments where the robot reports them.
#pragma once

#include "contrast_flow.hpp"
#include "image_source.hpp"
#include "noise.hpp"
#include "vessel_shadow.hpp"
#include "vessel_tree.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace liena::devices {

/// Beer and Lambert's law along each ray, quantum noise that follows the dose, the detector's blur, and an exposure control that keeps the
/// brightness behind the head; 12 bits, linear to the intensity. Head and vessels are projected once per geometry. The same seed and the
/// same exposures give the same pictures.
class FluoroscopyGenerator : public ImageSource {
public:
    FluoroscopyGenerator(VesselTree tree, int size, std::uint64_t seed);

    std::string describe() const override;
    Result<void> next(const Exposure& exposure, Picture& picture) override;

    /// The centre of what is shown: the origin when the vessels surround it, else their middle.
    Vector isocentre() const { return m_isocentre; }

private:
    void project(const CArmGeometry& geometry);
    void collimate();
    void control();
    void observeContrast(const Exposure& exposure);
    void addContrast(const InstrumentView& instruments);
    void expose(double quanta);
    void blurInto(std::vector<std::uint16_t>& pixels, double gain);
    double quantaPerPixel(AcquisitionMode mode) const;
    void describePicture(const Exposure& exposure, PictureFormat& format);

    VesselTree m_tree;
    VesselWay m_way;
    Vector m_isocentre;
    int m_size;
    NoiseSource m_noise;
    std::vector<float> m_noiseTable;

    std::optional<CArmGeometry> m_geometry;
    std::optional<CArmProjection> m_projection;
    std::vector<float> m_background; ///< part of the beam that passes head and collimator
    std::vector<VesselCrossing> m_crossings;
    double m_reference = 1; ///< the part that exposure control looks at
    double m_windowCentre = 0;
    double m_windowWidth = 0;

    ContrastFlow m_flow;
    std::vector<float> m_concentration; ///< per point of the tree
    std::vector<float> m_lines;         ///< attenuation beyond the background's
    std::vector<float> m_quanta;
    std::vector<float> m_smooth;
    std::optional<std::uint32_t> m_acquisition;
    bool m_contrastSeen = false; ///< in this acquisition
};

} // namespace liena::devices
