// A folder of grey pictures, played in the order of their names.
#pragma once

#include "image_source.hpp"

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace liena::devices {

/// Binary PGM (8 to 16 bits) and JPEG files of one size; others in the folder are ignored. Read when opened, within `memoryBound`.
class PictureFolder : public ImageSource {
public:
    static constexpr std::size_t memoryBound = 384U << 20U;

    static Result<std::unique_ptr<PictureFolder>> open(const std::filesystem::path& folder);

    std::string describe() const override;
    double ownRate() const override { return 15; }
    Result<void> next(const Exposure& exposure, Picture& picture) override;

private:
    Result<void> add(const std::filesystem::path& file);

    std::filesystem::path m_folder;
    std::vector<Picture> m_pictures;
    std::size_t m_next = 0;
};

/// One picture from a file's bytes; `name` is for errors.
Result<Picture> readPgm(std::string_view bytes, const std::string& name);
Result<Picture> readJpeg(std::string_view bytes, const std::string& name);

} // namespace liena::devices
