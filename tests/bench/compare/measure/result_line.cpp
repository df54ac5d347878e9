// Writing the line.
#include "measure/result_line.hpp"

#include <cstdio>

namespace liena::compare {

ResultLine& ResultLine::add(std::string_view name, std::string_view text)
{
    m_text += (m_text.empty() ? "\"" : ", \"") + std::string(name) + "\": \"" + std::string(text) + "\"";
    return *this;
}

ResultLine& ResultLine::add(std::string_view name, double value)
{
    m_text += (m_text.empty() ? "\"" : ", \"") + std::string(name) + "\": " + std::to_string(value);
    return *this;
}

ResultLine& ResultLine::add(std::string_view name, const std::vector<double>& values)
{
    m_text += (m_text.empty() ? "\"" : ", \"") + std::string(name) + "\": [";
    for (std::size_t i = 0; i < values.size(); ++i)
        m_text += (i > 0 ? "," : "") + std::to_string(values[i]);
    m_text += ']';
    return *this;
}

void ResultLine::print() const
{
    std::printf("{%s}\n", m_text.c_str());
    std::fflush(stdout);
}

} // namespace liena::compare
