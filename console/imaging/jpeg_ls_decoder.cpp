// The coded data of a JPEG-LS picture (ISO 14495-1, annex A) to stored values.
#include "imaging/jpeg_ls_decoder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace console {

namespace {

constexpr int contextCount = 365;
constexpr std::array<int, 32> runLengthBits{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,  2,  3,  3,  3,  3,
                                            4, 4, 5, 5, 6, 6, 7, 7, 8, 9, 10, 11, 12, 13, 14, 15};

// Reads bits up to the next marker. Reading past it gives zeros and is remembered.
class BitReader {
public:
    explicit BitReader(std::span<const std::byte> bytes)
        : m_next(reinterpret_cast<const std::uint8_t*>(bytes.data())), m_end(m_next + bytes.size())
    {}

    bool isExhausted() const { return m_exhausted; }

    // 0 to 32 bits.
    std::uint32_t bits(int count)
    {
        if (m_valid < count)
            fill();
        if (count == 0)
            return 0;
        const auto value = static_cast<std::uint32_t>(m_cache >> (64U - static_cast<unsigned>(count)));
        drop(count);
        return value;
    }

    // Zeros before the next one, which is taken too; `most` + 1 when there are more than `most` (at most 56).
    int zeros(int most)
    {
        if (m_valid <= most)
            fill();
        if (m_valid <= most)
            fill(); // the quick way brings 32 bits only
        const int count = std::min(std::countl_zero(m_cache), most + 1);
        drop(count + 1);
        return count;
    }

    // Only padding is left, and then the end of the image: otherwise lines were lost or added.
    bool endsWithImage()
    {
        for (int before = -1; before != m_valid;) {
            before = m_valid;
            fill();
        }
        return !m_exhausted && m_valid < 16 && m_end - m_next >= 2 && m_next[0] == 0xFF && m_next[1] == 0xD9;
    }

private:
    void drop(int count)
    {
        if (count > m_valid) {
            m_exhausted = true;
            m_cache = 0;
            m_valid = 0;
            return;
        }
        m_cache = count >= 64 ? 0 : m_cache << static_cast<unsigned>(count);
        m_valid -= count;
    }

    void fill()
    {
        if (m_valid <= 32 && !m_afterFull && m_end - m_next >= 4 && takeFour())
            return;
        while (m_valid <= 56 && m_next != m_end) {
            const std::uint8_t byte = *m_next;
            const bool isMarker = byte == 0xFF && (m_end - m_next < 2 || m_next[1] >= 0x80);
            if (isMarker)
                return;
            const int width = m_afterFull ? 7 : 8; // the encoder stuffs a zero bit after 0xFF
            m_cache |= static_cast<std::uint64_t>(byte) << static_cast<unsigned>(64 - m_valid - width);
            m_valid += width;
            m_afterFull = byte == 0xFF;
            ++m_next;
        }
    }

    // Four bytes at once when none of them is 0xFF.
    bool takeFour()
    {
        const std::uint32_t four = static_cast<std::uint32_t>(m_next[0]) << 24U | static_cast<std::uint32_t>(m_next[1]) << 16U |
                                   static_cast<std::uint32_t>(m_next[2]) << 8U | m_next[3];
        if (((~four - 0x01010101U) & four & 0x80808080U) != 0)
            return false;
        m_cache |= static_cast<std::uint64_t>(four) << static_cast<unsigned>(32 - m_valid);
        m_valid += 32;
        m_next += 4;
        return true;
    }

    const std::uint8_t* m_next;
    const std::uint8_t* m_end;
    std::uint64_t m_cache = 0;
    int m_valid = 0;
    bool m_afterFull = false;
    bool m_exhausted = false;
};

struct Context {
    int a = 0;
    int b = 0;
    int c = 0;
    int n = 1;
};

struct RunContext {
    int a = 0;
    int n = 1;
    int negative = 0;
};

int golombParameter(int n, int a)
{
    int k = 0;
    while ((n << k) < a)
        ++k;
    return k;
}

int predicted(int left, int above, int aboveLeft)
{
    const int low = std::min(left, above);
    const int high = std::max(left, above);
    if (aboveLeft >= high)
        return low;
    if (aboveLeft <= low)
        return high;
    return left + above - aboveLeft;
}

class Decoder {
public:
    explicit Decoder(const JpegLsHeader& header)
        : m_header(header),
          m_step(2 * header.near + 1),
          m_range((header.maximum + 2 * header.near) / m_step + 1),
          m_rangeBits(std::bit_width(static_cast<unsigned>(m_range - 1))),
          m_limit(2 * (pixelBits(header) + std::max(8, pixelBits(header)))),
          m_reader(header.coded),
          m_regions(static_cast<std::size_t>(2 * header.maximum + 1))
    {
        const int start = std::max(2, (m_range + 32) / 64);
        for (Context& context : m_contexts)
            context.a = start;
        for (RunContext& context : m_runContexts)
            context.a = start;
        for (int difference = -header.maximum; difference <= header.maximum; ++difference)
            m_regions[static_cast<std::size_t>(difference + header.maximum)] = region(difference);
    }

    template <typename Stored>
    bool decode(cv::Mat& stored)
    {
        const auto width = static_cast<std::size_t>(m_header.columns);
        std::vector<int> lines(2 * (width + 2), 0);
        int* above = lines.data() + 1;
        int* line = above + width + 2;
        for (int row = 0; row < m_header.rows; ++row) {
            above[width] = above[width - 1];
            line[-1] = above[0];
            decodeLine(line, above);
            if (m_damaged || m_reader.isExhausted())
                return false;
            std::transform(line, line + width, stored.ptr<Stored>(row), [](int value) { return static_cast<Stored>(value); });
            std::swap(line, above);
        }
        return m_reader.endsWithImage();
    }

private:
    static int pixelBits(const JpegLsHeader& header)
    {
        return std::max(2, static_cast<int>(std::bit_width(static_cast<unsigned>(header.maximum))));
    }

    std::int8_t region(int difference) const
    {
        const int size = std::abs(difference);
        int index = 4;
        if (size <= m_header.near)
            index = 0;
        else if (size < m_header.threshold1)
            index = 1;
        else if (size < m_header.threshold2)
            index = 2;
        else if (size < m_header.threshold3)
            index = 3;
        return static_cast<std::int8_t>(difference < 0 ? -index : index);
    }

    int regionOf(int difference) const { return m_regions[static_cast<std::size_t>(difference + m_header.maximum)]; }

    void decodeLine(int* line, const int* above)
    {
        int column = 0;
        while (column < m_header.columns && !m_damaged) {
            const int left = line[column - 1];
            const int up = above[column];
            const int upLeft = above[column - 1];
            const int context = 81 * regionOf(above[column + 1] - up) + 9 * regionOf(up - upLeft) + regionOf(upLeft - left);
            if (context == 0)
                column = decodeRun(line, above, column);
            else
                line[column++] = decodeRegular(context, predicted(left, up, upLeft));
        }
    }

    // A mapped error above the range cannot come from an encoder; without this check the contexts would grow without bound.
    int mappedError(int k, int limit)
    {
        const int most = limit - m_rangeBits - 1;
        const int zeros = m_reader.zeros(most);
        std::int64_t value = 0;
        if (zeros < most)
            value = (static_cast<std::int64_t>(zeros) << k) + m_reader.bits(k);
        else if (zeros == most)
            value = static_cast<std::int64_t>(m_reader.bits(m_rangeBits)) + 1;
        else
            m_damaged = true;
        if (value > m_range) {
            m_damaged = true;
            return 0;
        }
        return static_cast<int>(value);
    }

    int decodeRegular(int signedContext, int prediction)
    {
        const int sign = signedContext < 0 ? -1 : 1;
        Context& context = m_contexts[static_cast<std::size_t>(std::abs(signedContext))];
        const int corrected = std::clamp(prediction + sign * context.c, 0, m_header.maximum);
        const int k = golombParameter(context.n, context.a);
        const int mapped = mappedError(k, m_limit);
        int error = (mapped & 1) != 0 ? -((mapped + 1) / 2) : mapped / 2;
        if (m_header.near == 0 && k == 0 && 2 * context.b <= -context.n)
            error = -(error + 1);
        update(context, error);
        return reconstructed(corrected, sign * error);
    }

    void update(Context& context, int error) const
    {
        context.b += error * m_step;
        context.a += std::abs(error);
        if (context.n == m_header.reset) {
            context.a >>= 1;
            context.b = context.b >= 0 ? context.b >> 1 : -((1 - context.b) >> 1);
            context.n >>= 1;
        }
        ++context.n;
        if (context.b <= -context.n) {
            context.b = std::max(context.b + context.n, 1 - context.n);
            context.c = std::max(context.c - 1, -128);
        } else if (context.b > 0) {
            context.b = std::min(context.b - context.n, 0);
            context.c = std::min(context.c + 1, 127);
        }
    }

    int reconstructed(int prediction, int error) const
    {
        int value = prediction + error * m_step;
        if (value < -m_header.near)
            value += m_range * m_step;
        else if (value > m_header.maximum + m_header.near)
            value -= m_range * m_step;
        return std::clamp(value, 0, m_header.maximum);
    }

    // Returns the column after the run and the pixel that ended it.
    int decodeRun(int* line, const int* above, int column)
    {
        const int value = line[column - 1];
        const int end = column + runLength(m_header.columns - column);
        std::fill(line + column, line + end, value);
        if (end == m_header.columns || m_damaged)
            return end;
        line[end] = decodeInterruption(value, above[end]);
        m_runIndex = std::max(m_runIndex - 1, 0);
        return end + 1;
    }

    int runLength(int room)
    {
        int length = 0;
        while (m_reader.bits(1) != 0) {
            const int segment = 1 << runLengthBits[static_cast<std::size_t>(m_runIndex)];
            if (segment <= room - length)
                m_runIndex = std::min(m_runIndex + 1, 31);
            length = std::min(length + segment, room);
            if (length == room)
                return room;
        }
        length += static_cast<int>(m_reader.bits(runLengthBits[static_cast<std::size_t>(m_runIndex)]));
        if (length >= room) {
            m_damaged = true;
            return 0;
        }
        return length;
    }

    int decodeInterruption(int left, int above)
    {
        const int same = std::abs(left - above) <= m_header.near ? 1 : 0;
        RunContext& context = m_runContexts[static_cast<std::size_t>(same)];
        const int k = golombParameter(context.n, context.a + same * (context.n >> 1));
        const int mapped = mappedError(k, m_limit - runLengthBits[static_cast<std::size_t>(m_runIndex)] - 1);
        const int shifted = mapped + same;
        const bool odd = (shifted & 1) != 0;
        const int size = (shifted + 1) / 2;
        const int error = (k != 0 || 2 * context.negative >= context.n) == odd ? -size : size;
        if (error < 0)
            ++context.negative;
        context.a += (mapped + 1 - same) >> 1;
        if (context.n == m_header.reset) {
            context.a >>= 1;
            context.n >>= 1;
            context.negative >>= 1;
        }
        ++context.n;
        const int sign = same == 0 && left > above ? -1 : 1;
        return reconstructed(same != 0 ? left : above, sign * error);
    }

    const JpegLsHeader& m_header;
    int m_step;
    int m_range;
    int m_rangeBits;
    int m_limit;
    BitReader m_reader;
    std::vector<std::int8_t> m_regions;
    std::array<Context, contextCount> m_contexts;
    std::array<RunContext, 2> m_runContexts;
    int m_runIndex = 0;
    bool m_damaged = false;
};

} // namespace

bool decodeJpegLs(const JpegLsHeader& header, cv::Mat& stored)
{
    Decoder decoder(header);
    return stored.type() == CV_8UC1 ? decoder.decode<std::uint8_t>(stored) : decoder.decode<std::uint16_t>(stored);
}

} // namespace console
