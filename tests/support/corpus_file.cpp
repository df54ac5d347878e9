// Line by line.
#include "support/corpus_file.hpp"

#include "support/hex.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace liena::test {

namespace {

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(' ');
    return first == std::string_view::npos ? std::string_view() : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The two sides of the first `separator`, when the left one is made of lower-case letters, digits and `also` only.
bool split(std::string_view text, std::string_view separator, char also, std::string& left, std::string& right)
{
    const auto at = text.find(separator);
    if (at == std::string_view::npos || at == 0)
        return false;
    const auto key = text.substr(0, at);
    const auto belongs = [also](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == also; };
    if (!std::all_of(key.begin(), key.end(), belongs))
        return false;
    left = key;
    right = trimmed(text.substr(at + separator.size()));
    return true;
}

bool isHexLine(std::string_view text)
{
    const auto digits = std::count_if(text.begin(), text.end(), [](char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; });
    return digits % 2 == 0 && text.find_first_not_of("0123456789abcdef ") == std::string_view::npos;
}

void readLine(std::string_view line, CorpusFile& corpus)
{
    const auto hash = line.find('#');
    const auto hex = trimmed(line.substr(0, hash));
    const auto comment = hash == std::string_view::npos ? std::string_view() : trimmed(line.substr(hash + 1));
    if (!isHexLine(hex))
        throw std::runtime_error("these are no bytes in lower-case hex: " + std::string(hex));
    const auto bytes = bytesOf(hex);
    corpus.bytes.insert(corpus.bytes.end(), bytes.begin(), bytes.end());
    std::string key;
    std::string value;
    if (!hex.empty() && split(comment, " = ", '_', key, value))
        corpus.fields.emplace_back(key, value);
    else if (hex.empty() && corpus.bytes.empty() && split(comment, ":", ' ', key, value))
        corpus.remarks[key] = value;
}

} // namespace

std::string CorpusFile::remark(const std::string& key) const
{
    const auto found = remarks.find(key);
    return found != remarks.end() ? found->second : std::string();
}

CorpusFile readCorpusFile(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    if (!stream)
        throw std::runtime_error("cannot read " + file.string());
    CorpusFile corpus;
    corpus.name = file.stem().string();
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
        try {
            readLine(line, corpus);
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": " + error.what());
        }
    }
    return corpus;
}

std::vector<CorpusFile> readCorpus(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".hex")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<CorpusFile> corpus;
    for (const auto& file : files)
        corpus.push_back(readCorpusFile(file));
    return corpus;
}

} // namespace liena::test
