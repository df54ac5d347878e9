// The picture panes in the cockpit's window, with the chain behind them.
#pragma once

#include "app/picture_desk.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/reference_image_view.hpp"
#include "sample_frames.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/small_button.hpp"

#include <QTemporaryDir>
#include <QtTest>

namespace console::test {

struct PictureDeskStage {
    static constexpr QSize frameSize{256, 256};

    explicit PictureDeskStage(const QString& display = {}) : options(optionsWith(display)), desk(options, models), window(models)
    {
        models.picture.setLinkUp(true);
        models.picture.expect(15, std::chrono::steady_clock::now());
        desk.build(window);
        window.resize(1366, 768);
        window.show();
        live = window.findChild<LiveImageView*>();
        reference = window.findChild<ReferenceImageView*>();
    }

    Options optionsWith(const QString& display) const
    {
        Options made;
        made.pictures = folder.filePath(QStringLiteral("saved"));
        made.display = display;
        made.patient = QStringLiteral("Anna Invented");
        made.patientId = QStringLiteral("PID-4711");
        return made;
    }

    bool send(quint32 number, quint32 run = 1)
    {
        auto frame = samples::frame(number, frameSize, 12, PixelEncoding::Raw);
        frame->acquisition = run;
        return send(frame);
    }

    /// Contrast comes in a vessel after the sixth picture; the X-ray system's clock has been set back by `back`.
    bool sendContrast(quint32 run, std::chrono::nanoseconds back = {})
    {
        for (quint32 number = 1; number <= 12; ++number) {
            auto values = samples::storedValues(frameSize, 12);
            values.back() = std::uint16_t(number); // no two pulses give the same picture
            if (number > 6)
                for (int at = 120 * frameSize.width(); at < 128 * frameSize.width(); ++at)
                    values[std::size_t(at)] = std::uint16_t(values[std::size_t(at)] * 0.85);
            const auto plain = samples::frame(100 * run + number, frameSize, 12, PixelEncoding::Raw);
            const auto frame = samples::withBytes(*plain, samples::encode(values, frameSize, 12, PixelEncoding::Raw, 0));
            frame->acquisition = run;
            frame->captureNs -= quint64(back.count());
            if (!send(frame))
                return false;
        }
        return true;
    }

    /// By its button; whether there is one then.
    bool makeRoadmap()
    {
        reference->tell({});
        click(QStringLiteral("Roadmap"));
        return QTest::qWaitFor([this] { return !reference->told().isEmpty(); }) && models.roadmap.isValid();
    }

    void moveTable(double to)
    {
        AcquisitionStatus status;
        status.geometry.table = {to, 0, 0};
        models.xray.receive(status, std::chrono::steady_clock::now());
    }

    /// A run of three pictures ends, and their mean is held.
    bool holdMeanOfThree()
    {
        desk.setHoldPictures(4);
        moveTable(0);
        for (quint32 number = 1; number <= 3; ++number) {
            const auto frame = samples::frame(number, frameSize, 12, PixelEncoding::Raw);
            frame->ageAtArrival = Duration::zero(); // taken after the first report
            if (!send(frame))
                return false;
        }
        models.picture.expect(0, std::chrono::steady_clock::now());
        return QTest::qWaitFor([this] { return moveTable(0), reference->picture() && reference->picture()->meanOf == 3; });
    }

    bool send(const std::shared_ptr<XrayFrame>& frame)
    {
        frame->arrival = std::chrono::steady_clock::now();
        desk.pipeline().showFrame(frame);
        const quint64 before = models.picture.paintedCount();
        return QTest::qWaitFor([&] { return models.picture.paintedCount() > before; });
    }

    SmallButton* button(const QString& name) const
    {
        for (SmallButton* button : window.findChildren<SmallButton*>())
            if (button->accessibleName() == name)
                return button;
        return nullptr;
    }

    void click(const QString& name) const { QTest::mouseClick(button(name), Qt::LeftButton); }

    QTemporaryDir folder;
    ConsoleModels models;
    Options options;
    PictureDesk desk;
    CockpitWindow window;
    LiveImageView* live = nullptr;
    ReferenceImageView* reference = nullptr;
};

} // namespace console::test
