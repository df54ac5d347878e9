// The console's windows on the screens that there are, and what becomes of them when a screen vanishes.
#pragma once

#include "app/command_line.hpp"
#include "app/layout_book.hpp"
#include "model/console_models.hpp"

#include <QObject>
#include <QPointer>
#include <QTimer>

#include <memory>

class QScreen;

namespace console {

class CockpitWindow;
class PictureDesk;
class ReferenceImageView;
class ScreensView;
class SideWindow;
class TrendsPane;

/// GUI thread only; what it is given outlives it. One screen always suffices: the cockpit has everything, further windows repeat it. When a
/// screen goes, its windows fold in the same turn of the event loop, the cockpit first; if it was on that screen the hand loses the keys
/// until a person takes them again. Nothing is unfolded by itself.
class ScreenDesk : public QObject {
    Q_OBJECT
public:
    ScreenDesk(const Options& options, ConsoleModels& models, PictureDesk& pictures, CockpitWindow& window, QObject* parent = nullptr);
    ~ScreenDesk() override;

    /// The cockpit's window is shown.
    void begin();

    const ScreenLayout& present() const { return m_present; }
    const LayoutBook& book() const { return m_book; }
    SideWindow* second() const { return m_second.get(); }
    SideWindow* third() const { return m_third.get(); }

    void restore(int place);

    /// The name of a screen as layouts keep it.
    static QString nameOf(const QScreen* screen);

private:
    void connectView();
    void choose(const ScreenLayout& wanted);
    void apply(const ScreenPlan& plan);
    void screenGone(QScreen* gone);
    void moveCockpit(QScreen* to);
    void placeSecond(QScreen* on);
    QWidget* makeRunning();
    void placeThird(QScreen* on);
    void connectSide(SideWindow& side);
    void refresh();
    void refreshView();
    void say(bool trouble, const QString& words);
    QList<QString> screens(const QScreen* except = nullptr) const;
    QScreen* screenOf(const QString& name) const;
    bool mayChange() const;

    ConsoleModels& m_models;
    PictureDesk& m_pictures;
    CockpitWindow& m_window;
    LayoutBook m_book;
    ScreenLayout m_present;
    ScreensView* m_view; ///< the window's
    std::unique_ptr<SideWindow> m_second;
    std::unique_ptr<SideWindow> m_third;
    QPointer<TrendsPane> m_trends;
    QPointer<ReferenceImageView> m_reference;
    QTimer m_clock;
};

} // namespace console
