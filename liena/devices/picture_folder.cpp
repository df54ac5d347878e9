// A folder of grey pictures: implementation.
#include "picture_folder.hpp"

#include <turbojpeg.h>

#include <boost/outcome/try.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <fstream>
#include <sstream>

namespace liena::devices {

namespace {

constexpr int longestEdge = 4096;

// Skips white space and comments, then reads a number.
std::optional<int> headerNumber(std::string_view& bytes)
{
    while (!bytes.empty() &&
           (bytes.front() == '#' || bytes.front() == ' ' || bytes.front() == '\n' || bytes.front() == '\t' || bytes.front() == '\r'))
        bytes.remove_prefix(bytes.front() == '#' ? std::min(bytes.find('\n'), bytes.size()) : 1);
    int value = 0;
    const auto [end, error] = std::from_chars(bytes.data(), bytes.data() + bytes.size(), value);
    if (error != std::errc{})
        return std::nullopt;
    bytes.remove_prefix(static_cast<std::size_t>(end - bytes.data()));
    return value;
}

Picture emptyPicture(int columns, int rows, int bits)
{
    Picture picture;
    picture.format.rows = static_cast<std::uint16_t>(rows);
    picture.format.columns = static_cast<std::uint16_t>(columns);
    picture.format.bitsStored = static_cast<std::uint8_t>(bits);
    picture.format.source = PictureSource::Recorded;
    picture.format.windowWidth = 1 << bits;
    picture.format.windowCentre = (1 << bits) / 2.0;
    picture.pixels.resize(static_cast<std::size_t>(rows) * columns);
    return picture;
}

Result<std::string> readFile(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (!stream || !(text << stream.rdbuf()))
        return fail(Errc::FileUnreadable, file.string() + ": cannot be read");
    return std::move(text).str();
}

} // namespace

Result<Picture> readPgm(std::string_view bytes, const std::string& name)
{
    const auto refuse = [&](const char* what) { return fail(Errc::InvalidArgument, name + ": " + what); };
    if (!bytes.starts_with("P5"))
        return refuse("is no binary PGM file (P5)");
    bytes.remove_prefix(2);
    const auto columns = headerNumber(bytes);
    const auto rows = headerNumber(bytes);
    const auto most = headerNumber(bytes);
    if (!columns || !rows || !most || *columns < 1 || *columns > longestEdge || *rows < 1 || *rows > longestEdge || *most < 1 ||
        *most > 65535)
        return refuse("its header does not say a size of 1 to 4096 and a greatest value of 1 to 65535");
    if (!bytes.empty())
        bytes.remove_prefix(1);
    Picture picture = emptyPicture(*columns, *rows, std::max(8, static_cast<int>(std::bit_width(static_cast<unsigned>(*most)))));
    const std::size_t width = *most > 255 ? 2 : 1;
    if (bytes.size() < picture.pixels.size() * width)
        return refuse("is cut off; fetch the file again");
    for (std::size_t pixel = 0; pixel < picture.pixels.size(); ++pixel) {
        const auto byte = [&](std::size_t index) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[index])); };
        const unsigned value = width == 1 ? byte(pixel) : byte(2 * pixel) << 8U | byte(2 * pixel + 1);
        picture.pixels[pixel] = static_cast<std::uint16_t>(value);
    }
    return picture;
}

Result<Picture> readJpeg(std::string_view bytes, const std::string& name)
{
    const std::unique_ptr<void, int (*)(tjhandle)> codec(tjInitDecompress(), tjDestroy);
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    int columns = 0;
    int rows = 0;
    int subsampling = 0;
    int colours = 0;
    const auto refuse = [&](const std::string& what) { return fail(Errc::InvalidArgument, name + ": " + what); };
    if (!codec || tjDecompressHeader3(codec.get(), data, bytes.size(), &columns, &rows, &subsampling, &colours) != 0)
        return refuse(std::string("cannot be read as JPEG: ") + tjGetErrorStr2(codec.get()));
    if (columns < 1 || columns > longestEdge || rows < 1 || rows > longestEdge)
        return refuse("is larger than 4096 pixels an edge");
    Picture picture = emptyPicture(columns, rows, 8);
    std::vector<unsigned char> grey(picture.pixels.size());
    if (tjDecompress2(codec.get(), data, bytes.size(), grey.data(), columns, 0, rows, TJPF_GRAY, TJFLAG_STOPONWARNING) != 0)
        return refuse(std::string("cannot be decoded: ") + tjGetErrorStr2(codec.get()));
    std::copy(grey.begin(), grey.end(), picture.pixels.begin());
    return picture;
}

Result<std::unique_ptr<PictureFolder>> PictureFolder::open(const std::filesystem::path& folder)
{
    std::error_code error;
    std::vector<std::filesystem::path> files;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (const auto kind = entry->path().extension(); kind == ".pgm" || kind == ".jpg" || kind == ".jpeg")
            files.push_back(entry->path());
    if (error)
        return fail(Errc::FileUnreadable, folder.string() + ": " + error.message() + "; --images wants a folder");
    if (files.empty())
        return fail(Errc::InvalidArgument, folder.string() + ": holds no .pgm, .jpg or .jpeg file");
    std::sort(files.begin(), files.end());
    std::unique_ptr<PictureFolder> pictures(new PictureFolder);
    pictures->m_folder = folder;
    for (const auto& file : files) {
        BOOST_OUTCOME_TRYV(pictures->add(file));
    }
    return pictures;
}

Result<void> PictureFolder::add(const std::filesystem::path& file)
{
    const auto bytes = readFile(file);
    if (!bytes)
        return bytes.error();
    auto picture = file.extension() == ".pgm" ? readPgm(bytes.value(), file.string()) : readJpeg(bytes.value(), file.string());
    if (!picture)
        return picture.error();
    m_pictures.push_back(std::move(picture.value()));
    const PictureFormat& first = m_pictures.front().format;
    const PictureFormat& last = m_pictures.back().format;
    if (first.rows != last.rows || first.columns != last.columns)
        return fail(Errc::InvalidArgument, file.string() + ": has another size than the pictures before it; one run has one size");
    if (m_pictures.size() * m_pictures.front().pixels.size() * 2 > memoryBound)
        return fail(Errc::InvalidArgument, m_folder.string() + ": needs more than 384 MiB; keep fewer pictures in it");
    return ok();
}

std::string PictureFolder::describe() const
{
    return m_folder.string() + ": " + std::to_string(m_pictures.size()) + " pictures of " +
           std::to_string(m_pictures.front().format.columns) + " x " + std::to_string(m_pictures.front().format.rows);
}

Result<void> PictureFolder::next(const Exposure& exposure, Picture& picture)
{
    picture = m_pictures[m_next];
    m_next = (m_next + exposure.pulses) % m_pictures.size();
    return ok();
}

} // namespace liena::devices
