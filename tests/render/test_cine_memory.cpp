// How much memory the last minute of frames may take: a quarter of the computer's, within bounds.
#include "imaging/cine_ring.hpp"

#include <QTest>

#include <cstddef>
#include <optional>
#include <span>

#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

using namespace console;

namespace {

constexpr std::size_t mebibyte = std::size_t(1) << 20U;

std::optional<long> pagesTold; ///< of the computer's memory; nothing: as it is

/// The computer has that much; below zero: the system does not know.
void tell(int mebibytes)
{
    const long each = ::sysconf(_SC_PAGESIZE);
    pagesTold = mebibytes < 0 ? -1L : static_cast<long>(mebibyte) / each * mebibytes;
}

} // namespace

// Stands before the system's own, which the ring asks.
extern "C" long sysconf(int name) noexcept
{
    using Ask = long (*)(int);
    static const auto ask = reinterpret_cast<Ask>(::dlsym(RTLD_NEXT, "sysconf"));
    return name == _SC_PHYS_PAGES && pagesTold ? *pagesTold : ask(name);
}

class TestCineMemory : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void cleanup() { pagesTold.reset(); }

    void isAQuarterOfTheComputersWithinBounds_data()
    {
        QTest::addColumn<int>("computer"); // MiB
        QTest::addColumn<int>("ring");     // MiB
        QTest::newRow("not known") << -1 << 512;
        QTest::newRow("very little") << 256 << 512;
        QTest::newRow("so little that the least is a quarter") << 2048 << 512;
        QTest::newRow("a little more") << 2052 << 513;
        QTest::newRow("usual") << 8192 << 2048;
        QTest::newRow("so much that a minute fits") << 14400 << 3600;
        QTest::newRow("so much that the most is a quarter") << 16384 << 4096;
        QTest::newRow("a little more than that") << 16388 << 4096;
        QTest::newRow("very much") << 262144 << 4096;
    }

    void isAQuarterOfTheComputersWithinBounds()
    {
        QFETCH(int, computer);
        QFETCH(int, ring);
        tell(computer);
        QCOMPARE(CineRing::usualBytes(), static_cast<std::size_t>(ring) * mebibyte);
    }

    /// Of 1024 x 1024 pixels of 16 bits, at thirty pictures a second.
    void aWholeMinuteFitsWhereThereIsMemory()
    {
        constexpr std::size_t picture = std::size_t(1024) * 1024 * 2;
        constexpr std::size_t minute = picture * 30 * static_cast<std::size_t>(CineRing::longest.count());
        tell(16384);
        QVERIFY(CineRing::usualBytes() >= minute);
    }

    void thisComputersMemoryIsKnown()
    {
        const std::size_t bytes = CineRing::usualBytes();
        QVERIFY(bytes >= 512 * mebibyte && bytes <= 4096 * mebibyte);
    }

    /// A frame that is larger than the whole ring is not kept: nothing of it is read.
    void aRingIsAsLargeUnlessItIsToldAnother()
    {
        tell(1024);
        const std::size_t tooLarge = CineRing::usualBytes() + 1;
        void* const zeros = ::mmap(nullptr, tooLarge, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        QVERIFY(zeros != MAP_FAILED);
        XrayFrame frame;
        frame.pixels = std::span<const std::byte>(static_cast<const std::byte*>(zeros), tooLarge);
        CineRing ring;
        ring.add(frame);
        QVERIFY(ring.range().isEmpty());
        ::munmap(zeros, tooLarge);
    }
};

QTEST_APPLESS_MAIN(TestCineMemory)
#include "test_cine_memory.moc"
