// One file of tests/corpus: bytes as people read them, and what is said about them; tests/corpus/README.md is the format.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace liena::test {

struct CorpusFile {
    std::string name; ///< without its ending

    /// `# key: value`, from the lines before the first byte.
    std::map<std::string, std::string> remarks;

    /// `name = value` behind bytes, in the order of the file.
    std::vector<std::pair<std::string, std::string>> fields;

    std::vector<std::byte> bytes;

    /// A remark, or an empty text.
    std::string remark(const std::string& key) const;
};

/// Throws std::runtime_error, with file and line, on what the format does not know: a file that is read wrongly tests nothing.
CorpusFile readCorpusFile(const std::filesystem::path& file);

/// Every `.hex` file of a folder, by name.
std::vector<CorpusFile> readCorpus(const std::filesystem::path& folder);

} // namespace liena::test
