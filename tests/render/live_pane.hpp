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

} // namespace console::samples
