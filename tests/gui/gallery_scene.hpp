// The cockpit in its main states with invented values and pictures: for the gallery, and for tests of everything that is shown.
#pragma once

#include "invented_cockpit.hpp"
#include "widgets/cockpit_window.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace console::test {

struct GalleryState {
    const char* name;
    std::function<void(InventedCockpit&, CockpitWindow&)> bring;
};

std::vector<GalleryState> galleryStates();

class GalleryScene {
public:
    explicit GalleryScene(const QSize& size);
    ~GalleryScene();

    /// False when the window did not become active. `patience`: milliseconds for which what moves may move.
    bool bring(const GalleryState& state, int patience);

    CockpitWindow& window() { return m_window; }

private:
    struct PicturePanes;

    InventedCockpit m_cockpit;
    CockpitWindow m_window{m_cockpit.models};
    std::unique_ptr<PicturePanes> m_panes;
};

} // namespace console::test
