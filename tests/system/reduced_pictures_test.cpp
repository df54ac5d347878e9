// The X-ray system on a way whose rate the test says: every picture tells its rung, and is what it tells.
#include "test_system.hpp"
#include "xray_device.hpp"

#include <QTest>

#include <atomic>
#include <set>
#include <thread>

using namespace liena;
using namespace liena::test;
using namespace liena::devices;

namespace {

constexpr std::uint16_t edge = 64;
constexpr double askedRate = 30;
constexpr double rawLoad = edge * edge * 2 * askedRate;
constexpr int patience = 30000;
constexpr unsigned impossible = 300; ///< of JPEG-LS, which has no more than 255

constexpr std::uint16_t tooLarge = 2900; ///< of raw pictures, which a message holds up to 16 MiB

/// Grey ramps of 12 bits.
class Ramp : public ImageSource {
public:
    explicit Ramp(std::uint16_t edgeOfAll = edge) : m_edge(edgeOfAll) {}

    std::string describe() const override { return "a ramp"; }

    Result<void> next(const Exposure&, Picture& picture) override
    {
        picture.format = {};
        picture.format.rows = picture.format.columns = m_edge;
        picture.format.bitsStored = 12;
        picture.format.windowCentre = 2048;
        picture.format.windowWidth = 4096;
        picture.pixels.resize(std::size_t(m_edge) * m_edge);
        for (std::size_t pixel = 0; pixel < picture.pixels.size(); ++pixel)
            picture.pixels[pixel] = static_cast<std::uint16_t>((pixel * 37 + pixel / m_edge * 101) % 4096);
        return ok();
    }

private:
    std::uint16_t m_edge;
};

/// Gives one picture of so many; the others cannot be taken. 0: none at all.
class Torn : public Ramp {
public:
    explicit Torn(unsigned oneOf) : m_oneOf(oneOf) {}

    Result<void> next(const Exposure& exposure, Picture& picture) override
    {
        if (m_oneOf == 0 || ++m_count % m_oneOf != 0)
            return fail(Errc::FileUnreadable, "a picture is torn");
        return Ramp::next(exposure, picture);
    }

private:
    unsigned m_oneOf;
    unsigned m_count = 0;
};

/// Whose window is outside the bounds of the message set.
class Glaring : public Ramp {
public:
    Result<void> next(const Exposure& exposure, Picture& picture) override
    {
        auto taken = Ramp::next(exposure, picture);
        picture.format.windowWidth = 1e6;
        return taken;
    }
};

/// A detector that takes so long.
class Slow : public Ramp {
public:
    explicit Slow(std::chrono::milliseconds takes) : m_takes(takes) {}

    Result<void> next(const Exposure& exposure, Picture& picture) override
    {
        std::this_thread::sleep_for(m_takes);
        return Ramp::next(exposure, picture);
    }

private:
    std::chrono::milliseconds m_takes;
};

/// What one picture tells, and what it is.
struct Said {
    std::uint32_t frame = 0;
    unsigned rung = 0;
    double rate = 0;
    double askedRate = 0;
    Encoding askedEncoding = Encoding::Raw;
    Encoding encoding = Encoding::Raw;
    unsigned quality = 0;
    std::vector<std::byte> pixels;
};

Said said(const Message& message)
{
    const auto pixels = message.get<std::span<const std::byte>>("pixels");
    return {message.get<std::uint32_t>("frame"), message.get<unsigned>("rung"),           message.get<double>("rate"),
            message.get<double>("asked_rate"),   message.get<Encoding>("asked_encoding"), message.get<Encoding>("encoding"),
            message.get<unsigned>("quality"),    {pixels.begin(), pixels.end()}};
}

/// An X-ray system, and a cockpit that holds the pedal and keeps what it is told.
class Theatre {
public:
    explicit Theatre(Reduction reduction, Encoding encoding = Encoding::Raw, unsigned quality = 0,
                     std::unique_ptr<ImageSource> source = std::make_unique<Ramp>())
        : m_source(std::move(source)),
          m_files({reference::cockpit, reference::xray}, {"cockpit xray"}),
          m_xray(m_files.settingsOf("xray"),
                 [this, reduction, encoding, quality](DistributedSystem& system) {
                     build(system, {std::move(m_source), encoding, quality, reduction, {}});
                 }),
          m_cockpit(m_files.settingsOf("cockpit"), [this](DistributedSystem& system) { watch(system); })
    {
        (void)m_cockpit->openChannel(m_files.idOf("xray"));
    }

    ~Theatre()
    {
        m_cockpit->stop();
        m_xray->stop();
        m_device.reset();
    }

    void failWith(std::set<Encoding> encodings)
    {
        const std::lock_guard lock(m_mutex);
        m_failing = std::move(encodings);
    }

    void say(std::optional<double> rate) { m_rate = rate.value_or(-1); }

    std::vector<Said> pictures() const
    {
        const std::lock_guard lock(m_mutex);
        return m_pictures;
    }

    std::optional<unsigned> newestRung() const
    {
        const std::lock_guard lock(m_mutex);
        return m_pictures.empty() ? std::nullopt : std::optional(m_pictures.back().rung);
    }

    bool logged(std::string_view text) const
    {
        const std::lock_guard lock(m_mutex);
        return m_log.find(text) != std::string::npos;
    }

    double statedPulseRate() const { return m_pulseRate; }
    std::string story() const { return m_cockpit.story() + m_xray.story(); }

private:
    void build(DistributedSystem& system, XrayOptions options)
    {
        options.links = [this, &system] {
            auto links = system.links();
            const double rate = m_rate;
            for (LinkStatus& link : links) {
                link.bulkSuperseded = 0; // a busy computer is another matter
                link.bulkRate = rate >= 0 ? std::optional(rate) : std::nullopt;
                link.bulkStreams.clear(); // whose way on this computer is not known
            }
            return links;
        };
        options.encode = [this](FrameEncoder& encoder, Picture& picture) -> Result<EncodedPicture> {
            if (isBroken(encoder.encoding()))
                return fail(Errc::InvalidArgument, "the encoder is broken");
            return encoder.encode(picture);
        };
        m_device = std::move(XrayDevice::create(system, std::move(options), [this](const LogLine& line) {
                                 const std::lock_guard lock(m_mutex);
                                 m_log.append(line.text) += '\n';
                             }).value());
    }

    bool isBroken(Encoding encoding) const
    {
        const std::lock_guard lock(m_mutex);
        return m_failing.contains(encoding);
    }

    void watch(DistributedSystem& system)
    {
        QVERIFY(system.subscribe("XrayFrame", [this](const Message& message) {
            const std::lock_guard lock(m_mutex);
            m_pictures.push_back(said(message));
        }));
        QVERIFY(system.subscribe("AcquisitionStatus", [this](const Message& message) { m_pulseRate = message.get<double>("pulse_rate"); }));
        system.every(std::chrono::milliseconds(50), [this, &system] {
            auto command = system.command(m_files.idOf("xray"), "AcquisitionCommand").value();
            // The foot comes up now and then: a press counts only if it is heard from its beginning.
            const bool down = ++m_repeats % 20 != 0;
            command.set("mode", "fluoroscopy").set("pulse_rate", askedRate).set("pedal", down).set("press", m_press);
            (void)system.send(m_files.idOf("xray"), command);
            m_press += down ? 0 : 1;
        });
    }

    std::unique_ptr<ImageSource> m_source; ///< until the device is built
    TestSystem m_files;
    std::atomic<double> m_rate = -1;
    std::atomic<double> m_pulseRate = 0;
    std::uint32_t m_repeats = 0;
    std::uint32_t m_press = 1;
    mutable std::mutex m_mutex;
    std::vector<Said> m_pictures;
    std::string m_log;
    std::set<Encoding> m_failing;
    std::unique_ptr<XrayDevice> m_device;
    TestDevice m_xray;
    TestDevice m_cockpit;
};

bool isMarker(const Said& picture, std::size_t at, unsigned marker)
{
    return picture.pixels.size() > at + 1 && std::to_integer<unsigned>(picture.pixels[at]) == 0xFF &&
           std::to_integer<unsigned>(picture.pixels[at + 1]) == marker;
}

/// What the bytes are, whatever the fields say.
Encoding encodingOf(const Said& picture)
{
    if (picture.pixels.size() == std::size_t(edge) * edge * 2)
        return Encoding::Raw;
    return isMarker(picture, 2, 0xF7) ? Encoding::JpegLs : Encoding::Jpeg; // start of frame, ISO 14495-1
}

} // namespace

class ReducedPicturesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void everyPictureIsWhatItSays()
    {
        const PictureLadder declared(Encoding::Raw, 0, Reduction::Lossy);
        Theatre theatre(Reduction::Lossy);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.newestRung() == 0U, theatre.story().c_str(), patience);
        QTRY_COMPARE_WITH_TIMEOUT(theatre.statedPulseRate(), askedRate, patience);
        for (const double share : {0.6, 0.1, 0.0}) {
            const auto before = theatre.newestRung();
            theatre.say(rawLoad * share);
            QTRY_VERIFY2_WITH_TIMEOUT(theatre.newestRung() > before, theatre.story().c_str(), patience);
        }
        QTRY_COMPARE_WITH_TIMEOUT(theatre.statedPulseRate(), askedRate / 4, patience); // no pulses that nobody will see
        theatre.say(rawLoad * 10);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.newestRung() == 0U, theatre.story().c_str(), patience);
        std::set<unsigned> rungs;
        for (const Said& picture : theatre.pictures()) {
            rungs.insert(picture.rung);
            const PictureRung& rung = declared.rungs().at(picture.rung);
            QCOMPARE(picture.encoding, rung.encoding);
            QCOMPARE(picture.encoding, encodingOf(picture));
            QCOMPARE(picture.quality, rung.quality);
            QCOMPARE(picture.rate, askedRate / rung.divisor);
            QCOMPARE(picture.askedRate, askedRate);
            QCOMPARE(picture.askedEncoding, Encoding::Raw);
        }
        QVERIFY(rungs.contains(0) && rungs.contains(1) && rungs.contains(11));
    }

    void neverSendsLossyPicturesWithoutPermission()
    {
        Theatre theatre(Reduction::Lossless);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.newestRung() == 0U, theatre.story().c_str(), patience);
        theatre.say(0);
        QTRY_COMPARE_WITH_TIMEOUT(theatre.newestRung().value_or(0), 5U, patience);
        QTRY_COMPARE_WITH_TIMEOUT(theatre.statedPulseRate(), askedRate / 4, patience);
        for (const Said& picture : theatre.pictures()) {
            QVERIFY(picture.encoding != Encoding::Jpeg && encodingOf(picture) != Encoding::Jpeg);
            QCOMPARE(picture.quality, 0U);
        }
    }

    void leavesAnEncodingThatFails()
    {
        Theatre theatre(Reduction::Lossy, Encoding::JpegLs, impossible);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.pictures().size() >= 20, theatre.story().c_str(), patience);
        for (const Said& picture : theatre.pictures())
            QVERIFY(picture.rung >= 2 && picture.encoding == Encoding::Jpeg && encodingOf(picture) == Encoding::Jpeg);
        QVERIFY(theatre.logged("the encoding before failed"));
    }

    /// A rate that is told and not kept is none.
    void tellsTheRateForWhichThereIsTime()
    {
        Theatre theatre(Reduction::Lossy, Encoding::Raw, 0, std::make_unique<Slow>(std::chrono::milliseconds(40)));
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.newestRung() >= 1U, theatre.story().c_str(), patience);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.statedPulseRate() > 0 && theatre.statedPulseRate() <= askedRate / 2, theatre.story().c_str(),
                                  patience);
        QVERIFY(theatre.logged("pictures take longer to make here than until the next pulse"));
        for (const Said& picture : theatre.pictures())
            QVERIFY(picture.rung == 0 || picture.rate <= askedRate / 2);
    }

    void saysWhereNothingLessIsPermitted()
    {
        Theatre theatre(Reduction::None, Encoding::Raw, 0, std::make_unique<Slow>(std::chrono::milliseconds(40)));
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.logged("nothing less is permitted: pulses are left out"), theatre.story().c_str(), patience);
    }

    void endsTheRunWhereNoEncodingWorks()
    {
        Theatre theatre(Reduction::None, Encoding::JpegLs, impossible);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.logged("beam off: pictures cannot be encoded"), theatre.story().c_str(), patience);
        QVERIFY(theatre.pictures().empty());
    }

    void leavesAnEncodingWhosePicturesNoMessageHolds()
    {
        Theatre theatre(Reduction::Lossless, Encoding::Raw, 0, std::make_unique<Ramp>(tooLarge));
        QTRY_VERIFY2_WITH_TIMEOUT(!theatre.pictures().empty(), theatre.story().c_str(), patience);
        for (const Said& picture : theatre.pictures())
            QVERIFY(picture.rung >= 2 && picture.encoding == Encoding::JpegLs && encodingOf(picture) == Encoding::JpegLs);
        QVERIFY(theatre.logged("larger than the 16777216 bytes"));
    }

    void endsTheRunWhereNoMessageHoldsThePictures()
    {
        Theatre theatre(Reduction::None, Encoding::Raw, 0, std::make_unique<Ramp>(tooLarge));
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.logged("beam off: pictures cannot be encoded"), theatre.story().c_str(), patience);
        QVERIFY(theatre.pictures().empty());
    }

    void triesTheOtherEncodingsAgainWhereAllHaveFailed()
    {
        Theatre theatre(Reduction::Lossy, Encoding::JpegLs);
        theatre.failWith({Encoding::JpegLs, Encoding::Jpeg});
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.logged("beam off: pictures cannot be encoded"), theatre.story().c_str(), patience);
        const auto before = theatre.pictures().size(); // those of before the word was heard
        theatre.failWith({Encoding::Jpeg});            // which was the last to fail
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.pictures().size() >= before + 10, theatre.story().c_str(), patience);
        QCOMPARE(theatre.pictures().back().encoding, Encoding::JpegLs);
    }

    void endsTheRunWhereNoPictureCanBeTaken()
    {
        Theatre theatre(Reduction::Lossy, Encoding::Raw, 0, std::make_unique<Torn>(0));
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.logged("beam off: pictures cannot be taken"), theatre.story().c_str(), patience);
        QVERIFY(theatre.logged("a picture is torn"));
    }

    void goesOnWherePicturesCanBeTakenNowAndThen()
    {
        Theatre theatre(Reduction::None, Encoding::Raw, 0, std::make_unique<Torn>(3));
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.pictures().size() >= 10, theatre.story().c_str(), patience);
        QVERIFY(theatre.logged("a picture is torn"));
        QVERIFY(!theatre.logged("beam off: pictures"));
    }

    void endsTheRunWhereTheMessageSetRefusesThePictures()
    {
        Theatre theatre(Reduction::None, Encoding::Raw, 0, std::make_unique<Glaring>());
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.logged("beam off: pictures cannot be sent"), theatre.story().c_str(), patience);
        QVERIFY(theatre.pictures().empty());
    }

    void staysAsAskedWithoutPermissionToReduce()
    {
        Theatre theatre(Reduction::None);
        theatre.say(0);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.pictures().size() >= 20, theatre.story().c_str(), patience);
        for (const Said& picture : theatre.pictures())
            QVERIFY(picture.rung == 0 && encodingOf(picture) == Encoding::Raw && picture.rate == askedRate);
    }
};

QTEST_GUILESS_MAIN(ReducedPicturesTest)
#include "reduced_pictures_test.moc"
