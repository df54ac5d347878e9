// The cockpit's regions A to J as fractions of the window.
#pragma once

#include "model/screen_plan.hpp"

#include <QLayout>
#include <QRect>

#include <array>
#include <memory>
#include <vector>

namespace console {

enum class Region : int {
    Status,    ///< A
    Alarm,     ///< B
    Links,     ///< C
    Live,      ///< D, square
    Reference, ///< E
    Scene,     ///< F
    Robot,     ///< G
    Dose,      ///< H
    Trends,    ///< I
    Motion,    ///< J
    Sheet,     ///< over E and F
    Overlay,   ///< over E, F and G
    Note,      ///< over H and I
};
inline constexpr int regionCount = 13;

/// Where a region lies in a window of that size. The first ten never overlap; D is square, and no picture is larger. Usually it is the
/// largest by far; beside one that has changed places with it, it is the larger by a little, with G, H and I in a row beneath.
QRect regionRect(Region region, const QSize& window, Arrangement arrangement = Arrangement::Usual);

/// Puts one widget into each region. Sheet, Overlay and Note take no room from the others.
class CockpitLayout : public QLayout {
    Q_OBJECT
public:
    explicit CockpitLayout(QWidget* parent);
    ~CockpitLayout() override;

    void place(Region region, QWidget* widget);
    void setArrangement(Arrangement arrangement);

    void addItem(QLayoutItem* item) override;
    int count() const override;
    QLayoutItem* itemAt(int index) const override;
    QLayoutItem* takeAt(int index) override;
    QSize sizeHint() const override;
    QSize minimumSize() const override;
    void setGeometry(const QRect& rect) override;

private:
    struct Slot {
        Region region;
        std::unique_ptr<QLayoutItem> item;
    };
    std::vector<Slot> m_slots;
    Arrangement m_arrangement = Arrangement::Usual;
};

} // namespace console
