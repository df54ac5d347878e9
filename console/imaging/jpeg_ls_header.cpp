// The marker segments of a JPEG-LS picture (ISO 14495-1) up to its coded data.
#include "imaging/jpeg_ls_header.hpp"

#include <QCoreApplication>

#include <algorithm>

namespace console {

namespace {

// Markers, all after 0xFF.
constexpr int startOfImage = 0xD8;
constexpr int startOfFrame = 0xF7;
constexpr int parameters = 0xF8;
constexpr int startOfScan = 0xDA;
constexpr int restartInterval = 0xDD;
constexpr int comment = 0xFE;
constexpr int firstApplication = 0xE0;
constexpr int lastApplication = 0xEF;

constexpr int largestReset = 255;
constexpr int largestNear = 255;

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::JpegLsHeader)
};

// One marker segment without its length.
class Segment {
public:
    explicit Segment(std::span<const std::byte> bytes) : m_bytes(bytes) {}

    std::size_t size() const { return m_bytes.size(); }
    int byte(std::size_t at) const { return at < m_bytes.size() ? std::to_integer<int>(m_bytes[at]) : 0; }
    int word(std::size_t at) const { return byte(at) * 256 + byte(at + 1); }

private:
    std::span<const std::byte> m_bytes;
};

class HeaderReader {
public:
    HeaderReader(std::span<const std::byte> bytes, JpegLsHeader& header) : m_bytes(bytes), m_header(header) {}

    QString read()
    {
        if (marker() != startOfImage)
            return Text::tr("the bytes are no JPEG-LS picture");
        for (;;) {
            const int kind = marker();
            const std::span<const std::byte> body = segment();
            if (kind < 0 || !m_complete)
                return Text::tr("the JPEG-LS header is cut off");
            const QString refusal = take(kind, Segment(body));
            if (!refusal.isEmpty() || kind == startOfScan)
                return refusal;
        }
    }

private:
    int marker()
    {
        if (m_place + 2 > m_bytes.size() || m_bytes[m_place] != std::byte{0xFF})
            return -1;
        m_place += 2;
        return std::to_integer<int>(m_bytes[m_place - 1]);
    }

    std::span<const std::byte> segment()
    {
        const auto length = static_cast<std::size_t>(Segment(m_bytes.subspan(std::min(m_place, m_bytes.size()))).word(0));
        m_complete = length >= 2 && m_place + length <= m_bytes.size();
        if (!m_complete)
            return {};
        m_place += length;
        return m_bytes.subspan(m_place - length + 2, length - 2);
    }

    QString take(int kind, const Segment& body)
    {
        switch (kind) {
        case startOfFrame:
            return takeFrame(body);
        case parameters:
            return takeParameters(body);
        case startOfScan:
            return takeScan(body);
        case restartInterval:
            return Text::tr("the JPEG-LS picture has restart intervals, which are not supported");
        default:
            break;
        }
        if (kind == comment || (kind >= firstApplication && kind <= lastApplication))
            return {};
        return Text::tr("the JPEG-LS header has an unknown marker 0x%1").arg(kind, 2, 16, QLatin1Char('0'));
    }

    QString takeFrame(const Segment& body)
    {
        if (m_header.bits != 0 || body.size() < 6)
            return Text::tr("the JPEG-LS frame header is damaged");
        if (body.byte(5) != 1)
            return Text::tr("the JPEG-LS picture has %1 components instead of one").arg(body.byte(5));
        m_header.bits = body.byte(0);
        m_header.rows = body.word(1);
        m_header.columns = body.word(3);
        if (body.size() != 9 || m_header.bits < 2 || m_header.bits > 16 || m_header.rows < 1 || m_header.columns < 1)
            return Text::tr("the JPEG-LS frame header is damaged");
        return {};
    }

    QString takeParameters(const Segment& body)
    {
        if (body.byte(0) != 1 || body.size() != 11)
            return Text::tr("the JPEG-LS picture uses an extension that is not supported");
        m_header.maximum = body.word(1);
        m_header.threshold1 = body.word(3);
        m_header.threshold2 = body.word(5);
        m_header.threshold3 = body.word(7);
        m_header.reset = body.word(9);
        return {};
    }

    QString takeScan(const Segment& body)
    {
        if (m_header.bits == 0 || body.size() != 6 || body.byte(0) != 1)
            return Text::tr("the JPEG-LS scan header is damaged");
        if (body.byte(2) != 0 || body.byte(4) != 0 || body.byte(5) != 0)
            return Text::tr("the JPEG-LS picture uses an extension that is not supported");
        m_header.near = body.byte(3);
        m_header.coded = m_bytes.subspan(m_place);
        return completeParameters();
    }

    // Zero stands for the standard's default (C.2.4.1.1).
    QString completeParameters()
    {
        const int largest = (1 << m_header.bits) - 1;
        if (m_header.maximum == 0)
            m_header.maximum = largest;
        if (m_header.reset == 0)
            m_header.reset = 64;
        const int maximum = m_header.maximum;
        const int near = m_header.near;
        if (maximum > largest || near > std::min(largestNear, maximum / 2) || m_header.reset < 3 || m_header.reset > largestReset)
            return Text::tr("the JPEG-LS coding parameters are out of range");
        int basic1 = 0;
        int basic2 = 0;
        int basic3 = 0;
        if (maximum >= 128) {
            const int factor = (std::min(maximum, 4095) + 128) / 256;
            basic1 = factor + 2 + 3 * near;
            basic2 = factor * 4 + 3 + 5 * near;
            basic3 = factor * 17 + 4 + 7 * near;
        } else {
            const int factor = 256 / (maximum + 1);
            basic1 = std::max(2, 3 / factor + 3 * near);
            basic2 = std::max(3, 7 / factor + 5 * near);
            basic3 = std::max(4, 21 / factor + 7 * near);
        }
        fill(m_header.threshold1, basic1, near + 1);
        fill(m_header.threshold2, basic2, m_header.threshold1);
        fill(m_header.threshold3, basic3, m_header.threshold2);
        const bool inOrder = m_header.threshold1 > near && m_header.threshold1 <= m_header.threshold2 &&
                             m_header.threshold2 <= m_header.threshold3 && m_header.threshold3 <= maximum;
        return inOrder ? QString() : Text::tr("the JPEG-LS coding parameters are out of range");
    }

    void fill(int& threshold, int basic, int lowest) const
    {
        if (threshold == 0)
            threshold = basic > m_header.maximum || basic < lowest ? lowest : basic;
    }

    std::span<const std::byte> m_bytes;
    JpegLsHeader& m_header;
    std::size_t m_place = 0;
    bool m_complete = true;
};

} // namespace

QString readJpegLsHeader(std::span<const std::byte> bytes, JpegLsHeader& header)
{
    header = {};
    return HeaderReader(bytes, header).read();
}

} // namespace console
