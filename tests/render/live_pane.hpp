// A live pane whose clock only the test moves, and its pictures.
#pragma once

#include "imaging/frame_pipeline.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/pane_colours.hpp"
#include "sample_frames.hpp"

#include <QtTest>

namespace console::samples {

inline constexpr QSize frameSize(640, 520);

/// Shows pictures that went through the whole pipeline.
struct LivePane {
    LivePane()
    {
        view.setClock([this] { return now; });
        state.setLinkUp(true);
        state.expect(15, now);
        view.resize(frameSize + QSize(2 * hatchWidth, 2 * hatchWidth));
        QObject::connect(&pipeline, &FramePipeline::pictureReady, &view, &LiveImageView::showPicture);
        QObject::connect(&pipeline, &FramePipeline::pictureRefused, &view, &LiveImageView::showRefusal);
        view.show();
    }

    // Sends a frame that arrives now, and waits until it is delivered.
    bool send(const std::shared_ptr<XrayFrame>& frame)
    {
        frame->arrival = now;
        const quint64 before = pipeline.counts().shown;
        pipeline.showFrame(frame);
        return QTest::qWaitFor([&] { return pipeline.counts().shown > before; });
    }

    bool send(quint32 number) { return send(frame(number, frameSize, 12, PixelEncoding::Raw)); }

    QImage grab() { return view.grab().toImage().convertToFormat(QImage::Format_RGB32); }

    Instant now = std::chrono::steady_clock::now();
    PictureState state;
    LiveImageView view{state};
    FramePipeline pipeline;
};

// Calls `check` with each pixel of the picture that no mark covers; returns how many there are.
template <typename Check>
int forEachPicturePixel(const LivePane& pane, Check check)
{
    const QRect area = pane.view.pictureRect();
    const QRegion picture = QRegion(area) - pane.view.overlayRegion();
    int count = 0;
    for (const QRect& part : picture)
        for (int y = part.top(); y <= part.bottom(); ++y)
            for (int x = part.left(); x <= part.right(); ++x, ++count)
                check(x, y, x - area.left(), y - area.top());
    return count;
}

inline int differingPixels(const QImage& a, const QImage& b, const QRect& area)
{
    int differing = 0;
    for (int y = area.top(); y <= area.bottom(); ++y)
        for (int x = area.left(); x <= area.right(); ++x)
            differing += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
    return differing;
}

} // namespace console::samples
