// A recorded X-ray run: a DICOM file with one or more greyscale frames, played in a loop.
#pragma once

#include "image_source.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace liena::devices {

/// Reads little and big endian, deflated, RLE, JPEG baseline, extended and lossless files of 8 to 16 bits. (Not JPEG-LS: DCMTK's
/// decoder for it and CharLS, which encodes our frames, define the same symbols and cannot live in one program.) Runs that need at
/// most `memoryBound` decoded are decoded when opened, so that a defective frame is told then; longer ones frame by frame.
///
/// Signed pixels are shifted to unsigned ones, and the window with them. The rate is the first present of Recommended Display Frame Rate,
/// Cine Rate, Frame Time and Frame Time Vector, else 15 a second.
class DicomCine : public ImageSource {
public:
    static constexpr std::size_t memoryBound = 384U << 20U;

    /// Errors name the file, what is wrong and what to do.
    static Result<std::unique_ptr<DicomCine>> open(const std::filesystem::path& file, std::size_t memory = memoryBound);

    ~DicomCine() override;

    std::string describe() const override;
    double ownRate() const override { return m_rate; }
    Result<void> next(const Exposure& exposure, Picture& picture) override;

    const PictureFormat& format() const { return m_format; }
    std::uint32_t frameCount() const { return m_frameCount; }
    unsigned bitsAllocated() const { return m_layout.bitsAllocated; }

    /// Frame from 0.
    Result<void> frame(std::uint32_t index, std::vector<std::uint16_t>& pixels);

private:
    struct File;
    struct Layout {
        unsigned bitsAllocated = 8;
        unsigned bitsStored = 8;
        unsigned highBit = 7;
        bool isSigned = false;
    };
    explicit DicomCine(std::filesystem::path file);

    Result<void> load();
    Result<void> findPixels();
    Result<void> readLayout();
    Result<void> readSize();
    Result<void> checkLength();
    void readRate();
    void readMeaning();
    void readWindow();
    void chooseWindow(const std::vector<std::uint16_t>& pixels);
    Result<void> decodeAll(std::size_t memory);
    Result<void> decode(std::uint32_t index, std::vector<std::uint16_t>& pixels);
    std::uint16_t pixelFrom(std::uint16_t stored) const;
    auto refusal(const std::string& what) const;

    std::filesystem::path m_path;
    std::unique_ptr<File> m_file;
    PictureFormat m_format;
    Layout m_layout;
    std::uint32_t m_frameCount = 1;
    double m_rate = 15;
    std::string m_transferSyntax;
    std::vector<std::vector<std::uint16_t>> m_frames; ///< decoded; empty when the run is decoded frame by frame
    std::uint32_t m_next = 0;
};

} // namespace liena::devices
