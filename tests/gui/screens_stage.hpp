// A cockpit with its pictures on three invented screens.
#pragma once

#include "app/picture_desk.hpp"
#include "app/screen_desk.hpp"
#include "cockpit_stage.hpp"
#include "widgets/screens_view.hpp"

#include <QGuiApplication>
#include <QScreen>
#include <QTemporaryDir>

#include <memory>

namespace console::test {

/// Of three_screens.json.
inline QScreen* screenNamed(const char* name)
{
    for (QScreen* screen : QGuiApplication::screens())
        if (screen->name() == QString::fromLatin1(name))
            return screen;
    return nullptr;
}

struct ScreensStage : CockpitStage {
    QTemporaryDir folder;
    Options options;
    PictureDesk pictures;
    std::unique_ptr<ScreenDesk> desk;
    ScreensView* view;

    explicit ScreensStage(const QSize& size = {1920, 1080}) : CockpitStage(size), options(at(folder)), pictures(options, cockpit.models)
    {
        pictures.build(window);
        theme::applyScale(&window, theme::scaleFor(size)); // as when it is shown with its panes
        desk = std::make_unique<ScreenDesk>(options, cockpit.models, pictures, window);
        desk->begin();
        view = window.findChild<ScreensView*>();
    }

    static Options at(const QTemporaryDir& folder)
    {
        Options options;
        options.preferences = folder.filePath(QStringLiteral("preferences.ini"));
        return options;
    }

    bool readyWithKeys()
    {
        if (!ready())
            return false;
        window.setFocus();
        return QTest::qWaitFor([this] { return window.handHasKeys(); });
    }

    bool saidInTheLog(const QString& words) const { return cockpit.models.log.lines().back().text.contains(words); }
};

} // namespace console::test
