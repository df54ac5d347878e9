// How much the kernel holds of a connection whose messages must not wait, for what is urgent and for what may be passed.
#pragma once

#include "transport/path_facts.hpp"
#include "transport/patient_buffer.hpp"
#include "transport/prompt_buffer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace liena::transport {

/// Patient: what may be passed, of which the kernel is given little at a time; see PatientBuffer.
enum class Urgency : std::uint8_t { Patient, Urgent };

/// Pure; in bytes. The kernel chooses by itself until begin().
class KernelBuffer {
public:
    /// The kernel takes no more when so many are unsent. Returns the size to tell it.
    int begin(int mostUnsent)
    {
        m_mostUnsent = mostUnsent;
        return m_told = PromptBuffer::smallest;
    }

    bool isOurs() const { return m_told != 0; }

    /// The size to tell the kernel before that is written, if it is another one.
    std::optional<int> fit(Urgency urgency)
    {
        if (!isOurs())
            return std::nullopt;
        const int wanted = urgency == Urgency::Patient ? m_patient.bytes() : std::max(m_urgent, m_patient.bytes());
        return std::exchange(m_told, wanted) != wanted ? std::optional(wanted) : std::nullopt;
    }

    /// A write has to wait.
    void full(Urgency urgency, const PathFacts& facts)
    {
        if (urgency == Urgency::Patient)
            m_patient.full(facts);
        else
            m_urgent = PromptBuffer::next(m_urgent, facts, m_mostUnsent);
    }

    /// Nothing waits to be written.
    void pause() { m_patient.pause(); }

    /// Bytes of a patient write that leave in one piece.
    std::size_t patientWrite() const { return m_patient.write(); }

private:
    int m_told = 0; ///< 0: nothing yet
    int m_mostUnsent = 0;
    int m_urgent = PromptBuffer::smallest;
    PatientBuffer m_patient;
};

} // namespace liena::transport
