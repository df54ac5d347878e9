// A real coronary cine through the whole chain: DICOM file, X-ray device as a process, TLS session, decoder, window, painted pixels.
#include "child_process.hpp"
#include "dicom_cine.hpp"
#include "imaging/frame_pipeline.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/picture_overlay.hpp"
#include "link/translate.hpp"
#include "test_system.hpp"

#include <QtTest>

#include <set>

using namespace liena::test;
using namespace console;

namespace {

QString cinePath()
{
    const auto shared = qEnvironmentVariable("LIENA_SHARED_DATA", QStringLiteral(LIENA_SOURCE_DIR "/../shared/data"));
    return shared + QStringLiteral("/dicom-xa/rubo_0002_xa_96f_jpegbaseline.dcm");
}

/// DICOM PS3.3 C.11.2.1.2.1, for 8 bits, before rounding.
double windowed(double x, double centre, double width)
{
    if (x <= centre - 0.5 - (width - 1) / 2)
        return 0;
    if (x > centre - 0.5 + (width - 1) / 2)
        return 255;
    return ((x - (centre - 0.5)) / (width - 1) + 0.5) * 255;
}

/// A grey level is the rounded value; a half may go either way.
bool isRounded(int grey, double value) { return std::abs(grey - value) <= 0.5 + 1e-6; }

/// The cockpit's end: frames go the console's way from the wire to the screen, and the pedal is held.
class Screen {
public:
    explicit Screen(TestSystem& system)
        : device(system.settingsOf("cockpit"),
                 [this, xray = system.idOf("xray")](liena::DistributedSystem& cockpit) { connect(cockpit, xray); })
    {
        state.setLinkUp(true);
        view.resize(512 + 2 * hatchWidth, 512 + 2 * hatchWidth);
        QObject::connect(&pipeline, &FramePipeline::pictureReady, &view, [this](const DisplayPicture& picture) {
            shown = picture;
            view.showPicture(picture);
        });
        view.show();
    }

    void connect(liena::DistributedSystem& cockpit, liena::DeviceId xray)
    {
        QVERIFY(cockpit.subscribe("XrayFrame", [this](const liena::Message& message) {
            m_pictures = true;
            pipeline.showFrame(xrayFrame(std::make_shared<const liena::Message>(message), Duration{}));
        }));
        cockpit.every(std::chrono::milliseconds(100), [this, &cockpit, xray] {
            // Until pictures come the foot comes up again and again: a press counts only if it is heard from its beginning.
            const bool down = m_pictures || ++m_repeats % 4 != 0;
            auto command = cockpit.command(xray, "AcquisitionCommand").value();
            command.set("mode", "fluoroscopy").set("pulse_rate", 30.0).set("pedal", down).set("press", m_press);
            (void)cockpit.send(xray, command);
            m_press += down ? 0 : 1;
        });
    }

    PictureState state;
    LiveImageView view{state};
    FramePipeline pipeline;
    std::optional<DisplayPicture> shown;
    bool m_pictures = false; ///< these three are of the network thread
    std::uint32_t m_repeats = 0;
    std::uint32_t m_press = 1;
    TestDevice device; // last: its thread ends before what it feeds
};

} // namespace

class CineTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void paintsEveryFrameOfACoronaryCineAsItIsInTheFile()
    {
        if (!QFile::exists(cinePath()))
            QSKIP(qPrintable(QStringLiteral("the coronary cine is not here: %1").arg(cinePath())));
        auto cine = liena::devices::DicomCine::open(cinePath().toStdString());
        QVERIFY2(cine, cine ? "" : cine.error().what.c_str());
        const auto count = cine.value()->frameCount();
        QCOMPARE(count, 96U);

        TestSystem system({reference::cockpit, reference::xray}, {"cockpit xray"});
        ChildProcess xray(QStringLiteral("liena-device"),
                          QStringList{QStringLiteral("xray")} + system.argumentsOf("xray") +
                              QStringList{QStringLiteral("--no-reduction"), QStringLiteral("--dicom"), cinePath()});
        QVERIFY2(xray.waitForLine(QStringLiteral("listening on")), qPrintable(xray.output()));
        Screen screen(system);
        QVERIFY(screen.device->openChannel(system.idOf("xray")));

        std::set<std::uint32_t> seen;
        std::optional<std::uint32_t> offset; // from a frame's number to its place in the file
        std::vector<std::uint16_t> pixels;
        quint32 last = 0;
        const QDeadlineTimer deadline(90000);
        while (seen.size() < count) {
            QVERIFY2(!deadline.hasExpired(), qPrintable(QStringLiteral("%1 of 96 frames\n").arg(seen.size()) + xray.output()));
            if (!QTest::qWaitFor([&] { return screen.shown && screen.shown->about.frame != last; }, 20000))
                QFAIL(qPrintable(xray.output() + QString::fromStdString(screen.device.story())));
            const auto image = screen.view.grab().toImage().convertToFormat(QImage::Format_RGB32);
            const auto picture = *screen.shown;
            last = picture.about.frame;
            if (!offset)
                offset = placeInFile(*cine.value(), picture, last);
            QVERIFY2(offset, "the first picture is none of the file's frames");
            const auto index = (last + *offset) % count;
            if (!seen.insert(index).second)
                continue;
            QVERIFY(cine.value()->frame(index, pixels));
            comparePixels(screen, picture, image, pixels);
            if (QTest::currentTestFailed())
                return;
        }
    }

private:
    /// Which frame of the file the picture is: the one whose grey values it has.
    static std::optional<std::uint32_t> placeInFile(liena::devices::DicomCine& cine, const DisplayPicture& picture, quint32 number)
    {
        std::vector<std::uint16_t> pixels;
        for (std::uint32_t index = 0; index < cine.frameCount(); ++index) {
            if (!cine.frame(index, pixels))
                return std::nullopt;
            bool same = true;
            for (std::size_t at = 0; same && at < pixels.size(); at += 37)
                same = isRounded(qRed(picture.image.pixel(static_cast<int>(at % 512), static_cast<int>(at / 512))),
                                 windowed(pixels[at], picture.window.centre, picture.window.width));
            if (same)
                return (index + cine.frameCount() - number % cine.frameCount()) % cine.frameCount();
        }
        return std::nullopt;
    }

    static void comparePixels(const Screen& screen, const DisplayPicture& picture, const QImage& image,
                              const std::vector<std::uint16_t>& pixels)
    {
        const QRect area = screen.view.pictureRect();
        QCOMPARE(area.size(), QSize(512, 512));
        int compared = 0;
        for (const QRect& part : QRegion(area) - screen.view.overlayRegion())
            for (int y = part.top(); y <= part.bottom(); ++y) {
                const auto* row = reinterpret_cast<const QRgb*>(image.constScanLine(y));
                for (int x = part.left(); x <= part.right(); ++x, ++compared) {
                    const auto stored = pixels[static_cast<std::size_t>((y - area.top()) * 512 + x - area.left())];
                    const double grey = windowed(stored, picture.window.centre, picture.window.width);
                    if (!isRounded(qRed(row[x]), grey) || qGreen(row[x]) != qRed(row[x]) || qBlue(row[x]) != qRed(row[x]))
                        QFAIL(qPrintable(QStringLiteral("frame %1 at %2,%3: stored %4, painted %5, expected %6")
                                             .arg(picture.about.frame)
                                             .arg(x - area.left())
                                             .arg(y - area.top())
                                             .arg(stored)
                                             .arg(qRed(row[x]))
                                             .arg(grey)));
                }
            }
        QVERIFY(compared > 512 * 512 * 3 / 4);
    }
};

QTEST_MAIN(CineTest)
#include "cine_test.moc"
