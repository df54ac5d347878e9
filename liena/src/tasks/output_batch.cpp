// Gathering.
#include "tasks/output_batch.hpp"

namespace liena::tasks {

void OutputBatch::append(const protocol::Segment& segment, const std::shared_ptr<const void>& owner)
{
    m_size += segment.size();
    if (!m_refers || owner == nullptr || segment.body.size() < longBody)
        return protocol::appendTo(m_own, segment);
    m_own.insert(m_own.end(), segment.header.begin(), segment.header.end());
    m_own.insert(m_own.end(), segment.lead.begin(), segment.lead.end());
    m_pieces.push_back({m_own.size() - m_listed, segment.body});
    m_listed = m_own.size();
    if (m_owners.empty() || m_owners.back() != owner)
        m_owners.push_back(owner);
}

void OutputBatch::clear()
{
    m_size = 0;
    m_listed = 0;
    m_own.clear();
    m_pieces.clear();
    m_owners.clear();
}

std::span<const std::span<const std::byte>> OutputBatch::parts()
{
    m_parts.clear();
    std::span<const std::byte> own = m_own;
    for (const auto& piece : m_pieces) {
        m_parts.push_back(own.first(piece.own));
        m_parts.push_back(piece.foreign);
        own = own.subspan(piece.own);
    }
    if (!own.empty())
        m_parts.push_back(own);
    return {m_parts.data(), m_parts.size()};
}

} // namespace liena::tasks
