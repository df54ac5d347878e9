// Paints the cockpit in its main states with invented values into PNG files: `cockpit_gallery <folder> [<state> or all] [<language>]`.
#include "app/language.hpp"
#include "gallery_scene.hpp"
#include "pseudo_language.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QDir>

#include <cstdio>

namespace {

using console::test::GalleryState;

bool paint(const GalleryState& state, const QSize& size, const QDir& folder)
{
    console::test::GalleryScene scene(size);
    if (!scene.bring(state, 250))
        return false;
    return scene.window().grab().save(folder.filePath(QStringLiteral("%1_%2.png").arg(QString::fromLatin1(state.name)).arg(size.height())));
}

} // namespace

int main(int argc, char* argv[])
{
    QApplication application(argc, argv);
    console::theme::apply(application);
    const QDir folder(argc > 1 ? QString::fromLocal8Bit(argv[1]) : QDir::currentPath());
    const QString only = argc > 2 ? QString::fromLocal8Bit(argv[2]) : QStringLiteral("all");
    const QString language = argc > 3 ? QString::fromLocal8Bit(argv[3]) : console::sourceLanguage();
    console::test::PseudoLanguage pseudo;
    if (language == QLatin1String("pseudo"))
        QApplication::installTranslator(&pseudo);
    else if (!console::languages().contains(language) || !console::speak(language).isEmpty())
        return std::fprintf(stderr, "%s: not spoken\n", qPrintable(language)), 2;
    for (const GalleryState& state : console::test::galleryStates())
        for (const QSize& size : {QSize(2560, 1440), QSize(1920, 1080), QSize(1366, 768)})
            if ((only == QLatin1String("all") || only == QLatin1String(state.name)) && !paint(state, size, folder)) {
                std::fprintf(stderr, "%s: cannot be painted into %s\n", state.name, qPrintable(folder.path()));
                return 1;
            }
    return 0;
}
