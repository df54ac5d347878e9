// Where the link hands over pictures.
#pragma once

#include "model/xray_frame.hpp"

#include <memory>

namespace console {

class FrameSink {
public:
    virtual ~FrameSink() = default;

    /// Called on the network thread: takes the picture and returns at once. A newer picture replaces one that was not yet taken up.
    virtual void showFrame(std::shared_ptr<const XrayFrame> frame) = 0;

protected:
    FrameSink() = default;
    FrameSink(const FrameSink&) = default;
    FrameSink& operator=(const FrameSink&) = default;
};

} // namespace console
