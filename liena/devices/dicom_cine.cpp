// A recorded X-ray run: implementation on DCMTK.
#include "dicom_cine.hpp"

#include "liena/log.hpp"

#include <boost/outcome/try.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <mutex>

#include "dcmtk/config/osconfig.h"
#include "dcmtk/dcmdata/dctk.h"

#include "dcmtk/dcmdata/dcfcache.h"
#include "dcmtk/dcmdata/dcrledrg.h"
#include "dcmtk/dcmjpeg/djdecode.h"
#include "dcmtk/oflog/oflog.h"

namespace liena::devices {

namespace {

constexpr unsigned mostPixelsAnEdge = 4096;
constexpr std::uint32_t mostFrames = 20'000;
constexpr double usualRate = 15;

void registerDecoders()
{
    static std::once_flag once;
    std::call_once(once, [] {
        OFLog::configure(OFLogger::OFF_LOG_LEVEL); // what is wrong with a file is said once, in our own words
        DJDecoderRegistration::registerCodecs();
        DcmRLEDecoderRegistration::registerCodecs();
    });
}

std::optional<double> number(DcmItem& dataset, const DcmTagKey& tag, unsigned long position = 0)
{
    Float64 value = 0;
    if (dataset.findAndGetFloat64(tag, value, position).good() && std::isfinite(value))
        return value;
    OFString text; // some writers use another representation than the standard's
    if (dataset.findAndGetOFString(tag, text, position).bad() || text.empty())
        return std::nullopt;
    char* end = nullptr;
    const double read = std::strtod(text.c_str(), &end);
    return end != text.c_str() && std::isfinite(read) ? std::optional(read) : std::nullopt;
}

double numberWithin(DcmItem& dataset, const DcmTagKey& tag, double low, double high)
{
    const double value = number(dataset, tag).value_or(0);
    return value >= low && value <= high ? value : 0;
}

std::string text(DcmItem& dataset, const DcmTagKey& tag)
{
    OFString value;
    return dataset.findAndGetOFString(tag, value).good() ? std::string(value.c_str()) : std::string();
}

bool plausibleRate(std::optional<double> rate) { return rate && *rate >= 0.1 && *rate <= 120; }

} // namespace

struct DicomCine::File {
    DcmFileFormat format;
    DcmPixelData* pixels = nullptr;
    Uint32 fragment = 0;        ///< where the next frame in order begins
    std::uint32_t inOrder = 0;  ///< that frame
    std::vector<Uint16> buffer; ///< aligned for 16 bits
    DcmFileCache cache;
};

DicomCine::DicomCine(std::filesystem::path file) : m_path(std::move(file)), m_file(std::make_unique<File>()) {}

DicomCine::~DicomCine() = default;

auto DicomCine::refusal(const std::string& what) const { return fail(Errc::InvalidArgument, m_path.string() + ": " + what); }

Result<std::unique_ptr<DicomCine>> DicomCine::open(const std::filesystem::path& file, std::size_t memory)
{
    registerDecoders();
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        return fail(Errc::FileUnreadable, file.string() + ": is no file; --dicom wants one DICOM file, not a folder");
    std::unique_ptr<DicomCine> cine(new DicomCine(file));
    BOOST_OUTCOME_TRYV(cine->load());
    BOOST_OUTCOME_TRYV(cine->decodeAll(memory));
    return cine;
}

Result<void> DicomCine::load()
{
    const OFCondition loaded = m_file->format.loadFile(OFFilename(m_path.c_str()));
    if (loaded.bad())
        return refusal(std::string("cannot be read as DICOM (") + loaded.text() + "); give a whole DICOM Part 10 file");
    BOOST_OUTCOME_TRYV(findPixels());
    BOOST_OUTCOME_TRYV(readLayout());
    BOOST_OUTCOME_TRYV(readSize());
    BOOST_OUTCOME_TRYV(checkLength());
    readRate();
    readMeaning();
    return ok();
}

Result<void> DicomCine::findPixels()
{
    DcmElement* element = nullptr;
    if (m_file->format.getDataset()->findAndGetElement(DCM_PixelData, element).good())
        m_file->pixels = dynamic_cast<DcmPixelData*>(element);
    return m_file->pixels ? Result<void>(ok()) : Result<void>(refusal("holds no pixel data; choose a file with pictures"));
}

Result<void> DicomCine::readLayout()
{
    DcmItem& dataset = *m_file->format.getDataset();
    const double samples = number(dataset, DCM_SamplesPerPixel).value_or(1);
    const std::string photometric = text(dataset, DCM_PhotometricInterpretation);
    if (samples != 1 || (photometric != "MONOCHROME1" && photometric != "MONOCHROME2"))
        return refusal("its pixels are not greyscale (Photometric Interpretation '" + printable(photometric, 32) +
                       "'); X-ray pictures are MONOCHROME1 or MONOCHROME2: convert it or choose another file");
    const auto allocated = number(dataset, DCM_BitsAllocated).value_or(0);
    const auto stored = number(dataset, DCM_BitsStored).value_or(allocated);
    const auto high = number(dataset, DCM_HighBit).value_or(stored - 1);
    if ((allocated != 8 && allocated != 16) || stored < 1 || stored > allocated || high < stored - 1 || high >= allocated)
        return refusal("its Bits Allocated, Bits Stored and High Bit do not make pixels of 8 to 16 bits; choose another file");
    m_layout = {static_cast<unsigned>(allocated), static_cast<unsigned>(stored), static_cast<unsigned>(high),
                number(dataset, DCM_PixelRepresentation).value_or(0) == 1};
    m_format.bitsStored = static_cast<std::uint8_t>(m_layout.bitsStored);
    m_format.photometric = photometric == "MONOCHROME1" ? Photometric::Monochrome1 : Photometric::Monochrome2;
    m_format.source = PictureSource::Recorded;
    return ok();
}

Result<void> DicomCine::readSize()
{
    DcmItem& dataset = *m_file->format.getDataset();
    const auto rows = number(dataset, DCM_Rows).value_or(0);
    const auto columns = number(dataset, DCM_Columns).value_or(0);
    if (!(rows >= 1 && rows <= mostPixelsAnEdge && columns >= 1 && columns <= mostPixelsAnEdge))
        return refusal("its Rows and Columns are missing or outside 1 to 4096; choose another file");
    const auto frames = number(dataset, DCM_NumberOfFrames).value_or(1);
    if (!(frames >= 1 && frames <= mostFrames))
        return refusal("its Number of Frames is outside 1 to 20000; choose another file");
    m_format.rows = static_cast<std::uint16_t>(rows);
    m_format.columns = static_cast<std::uint16_t>(columns);
    m_frameCount = static_cast<std::uint32_t>(frames);
    return ok();
}

// A file that is cut off announces more than it holds.
Result<void> DicomCine::checkLength()
{
    const DcmXfer syntax(m_file->format.getDataset()->getOriginalXfer());
    m_transferSyntax = syntax.getXferName();
    const std::uint64_t wanted = std::uint64_t{m_format.rows} * m_format.columns * (m_layout.bitsAllocated / 8) * m_frameCount;
    const std::uint64_t held = m_file->pixels->getLengthField();
    if (!syntax.isEncapsulated() && held < wanted)
        return refusal("is cut off: its pixel data hold " + std::to_string(held) + " bytes, its header announces " +
                       std::to_string(wanted) + "; fetch the file again");
    return ok();
}

void DicomCine::readRate()
{
    DcmItem& dataset = *m_file->format.getDataset();
    const auto perMillisecond = [](std::optional<double> time) { return time && *time > 0 ? std::optional(1000 / *time) : std::nullopt; };
    const std::array candidates{number(dataset, DCM_RecommendedDisplayFrameRate), number(dataset, DCM_CineRate),
                                perMillisecond(number(dataset, DCM_FrameTime)), perMillisecond(number(dataset, DCM_FrameTimeVector, 1))};
    const auto found = std::find_if(candidates.begin(), candidates.end(), plausibleRate);
    m_rate = found != candidates.end() ? **found : usualRate;
}

void DicomCine::readMeaning()
{
    DcmItem& dataset = *m_file->format.getDataset();
    const std::string relationship = text(dataset, DCM_PixelIntensityRelationship);
    m_format.relationship = relationship == "LIN"   ? IntensityRelationship::Linear
                            : relationship == "LOG" ? IntensityRelationship::Logarithmic
                                                    : IntensityRelationship::Display;
    m_format.imagerPixelSpacing = numberWithin(dataset, DCM_ImagerPixelSpacing, 0, 10);
    m_format.primaryAngle = numberWithin(dataset, DCM_PositionerPrimaryAngle, -180, 180);
    m_format.secondaryAngle = numberWithin(dataset, DCM_PositionerSecondaryAngle, -90, 90);
    m_format.sourceDetectorDistance = numberWithin(dataset, DCM_DistanceSourceToDetector, 0, 2000);
    m_format.sourceObjectDistance = numberWithin(dataset, DCM_DistanceSourceToPatient, 0, 2000);
    readWindow();
}

void DicomCine::readWindow()
{
    DcmItem& dataset = *m_file->format.getDataset();
    const auto centre = number(dataset, DCM_WindowCenter);
    const auto width = number(dataset, DCM_WindowWidth);
    if (!centre || !width || *width < 1)
        return;
    // The window is meant for the rescaled values; what is sent are the stored ones.
    const double slope = number(dataset, DCM_RescaleSlope).value_or(1);
    const double intercept = number(dataset, DCM_RescaleIntercept).value_or(0);
    const double shift = m_layout.isSigned ? std::ldexp(1.0, static_cast<int>(m_layout.bitsStored) - 1) : 0;
    const double storedCentre = slope > 0 ? (*centre - intercept) / slope + shift : *centre + shift;
    const double storedWidth = slope > 0 ? *width / slope : *width;
    if (storedCentre < -65536 || storedCentre > 131072 || storedWidth < 1 || storedWidth > 131072)
        return;
    m_format.windowCentre = storedCentre;
    m_format.windowWidth = storedWidth;
}

// From the first to the 99th percentile of one frame: a few burnt or empty pixels do not decide.
void DicomCine::chooseWindow(const std::vector<std::uint16_t>& pixels)
{
    std::vector<std::uint16_t> sorted(pixels);
    const auto at = [&](double part) {
        const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(sorted.size() - 1));
        std::nth_element(sorted.begin(), place, sorted.end());
        return static_cast<double>(*place);
    };
    const double low = at(0.01);
    const double high = at(0.99);
    m_format.windowWidth = std::max(1.0, high - low + 1);
    m_format.windowCentre = (low + high + 1) / 2;
}

Result<void> DicomCine::decodeAll(std::size_t memory)
{
    std::vector<std::uint16_t> pixels;
    BOOST_OUTCOME_TRYV(decode(0, pixels));
    if (m_format.windowWidth == 0)
        chooseWindow(pixels);
    const std::uint64_t wanted = std::uint64_t{m_format.rows} * m_format.columns * 2 * m_frameCount;
    if (wanted > memory)
        return ok();
    m_frames.reserve(m_frameCount);
    m_frames.push_back(std::move(pixels));
    for (std::uint32_t index = 1; index < m_frameCount; ++index) {
        BOOST_OUTCOME_TRYV(decode(index, m_frames.emplace_back()));
    }
    m_file.reset();
    return ok();
}

std::uint16_t DicomCine::pixelFrom(std::uint16_t stored) const
{
    const unsigned mask = (1U << m_layout.bitsStored) - 1;
    const unsigned value = stored >> (m_layout.highBit + 1 - m_layout.bitsStored) & mask;
    const unsigned sign = m_layout.isSigned ? 1U << (m_layout.bitsStored - 1) : 0;
    return static_cast<std::uint16_t>(value ^ sign); // two's complement, moved so that the lowest is 0
}

Result<void> DicomCine::decode(std::uint32_t index, std::vector<std::uint16_t>& pixels)
{
    File& file = *m_file;
    const std::size_t count = std::size_t{m_format.rows} * m_format.columns;
    const std::size_t bytes = count * (m_layout.bitsAllocated / 8);
    file.buffer.assign((bytes + 3) / 2, 0);
    if (index != file.inOrder)
        file.fragment = 0;
    OFString colourModel;
    const OFCondition decoded = file.pixels->getUncompressedFrame(m_file->format.getDataset(), index, file.fragment, file.buffer.data(),
                                                                  static_cast<Uint32>(bytes + (bytes & 1U)), colourModel, &file.cache);
    if (decoded.bad())
        return refusal("frame " + std::to_string(index + 1) + " of " + std::to_string(m_frameCount) + " cannot be decoded (" +
                       m_transferSyntax + ": " + decoded.text() + "); fetch the file again or convert it to Explicit VR Little Endian");
    file.inOrder = index + 1;
    pixels.resize(count);
    if (m_layout.bitsAllocated == 16) {
        std::transform(file.buffer.begin(), file.buffer.begin() + static_cast<std::ptrdiff_t>(count), pixels.begin(),
                       [this](Uint16 stored) { return pixelFrom(stored); });
    } else {
        const auto* first = reinterpret_cast<const std::uint8_t*>(file.buffer.data());
        std::transform(first, first + count, pixels.begin(), [this](std::uint8_t stored) { return pixelFrom(stored); });
    }
    return ok();
}

Result<void> DicomCine::frame(std::uint32_t index, std::vector<std::uint16_t>& pixels)
{
    if (index >= m_frameCount)
        return refusal("has no frame " + std::to_string(index + 1));
    if (m_frames.empty())
        return decode(index, pixels);
    pixels = m_frames[index];
    return ok();
}

Result<void> DicomCine::next(const Exposure& exposure, Picture& picture)
{
    picture.format = m_format;
    const std::uint32_t index = m_next;
    m_next = (m_next + exposure.pulses) % m_frameCount;
    return frame(index, picture.pixels);
}

std::string DicomCine::describe() const
{
    return m_path.filename().string() + ": " + std::to_string(m_frameCount) + " frames of " + std::to_string(m_format.columns) + " x " +
           std::to_string(m_format.rows) + ", " + std::to_string(m_format.bitsStored) + " bits, " + m_transferSyntax;
}

} // namespace liena::devices
