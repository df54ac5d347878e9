// Which languages there are, and the translators.
#include "app/language.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QFontDatabase>
#include <QLocale>
#include <QTranslator>

#include <memory>

namespace console {

namespace {

const QString folder = QStringLiteral(":/liena/translations");
const QString prefix = QStringLiteral("liena-console_");

bool canBeDrawn(const QString& language)
{
    return !language.startsWith(QLatin1String("zh")) || !QFontDatabase::families(QFontDatabase::SimplifiedChinese).isEmpty();
}

/// Of Qt's own texts none is shown.
bool install(const QString& language)
{
    auto translator = std::make_unique<QTranslator>(QCoreApplication::instance());
    return translator->load(prefix + language, folder) && QCoreApplication::installTranslator(translator.release());
}

} // namespace

QString sourceLanguage() { return QStringLiteral("en"); }

QStringList languages()
{
    QStringList all{sourceLanguage()};
    for (const auto& file : QDir(folder).entryList({prefix + QStringLiteral("*.qm")}, QDir::Files, QDir::Name))
        all << file.mid(prefix.size()).chopped(3);
    return all;
}

QString spokenOf(const QStringList& wanted)
{
    for (const auto& one : wanted) {
        const QLocale locale(one);
        for (const auto& language : languages()) {
            // The script decides: zh-Hans-SG reads zh_CN, and zh-TW does not.
            const QLocale known(language);
            if (known.language() == locale.language() && known.script() == locale.script())
                return language;
        }
    }
    return sourceLanguage();
}

QString speak(const QString& language)
{
    const auto chosen = language.isEmpty() ? spokenOf(QLocale::system().uiLanguages()) : language;
    if (chosen == sourceLanguage())
        return {};
    if (!canBeDrawn(chosen))
        return QStringLiteral("no typeface has the characters of %1, so the screen speaks English; install LiENa anew").arg(chosen);
    if (!install(chosen))
        return QStringLiteral("the catalogue of %1 cannot be read, so the screen speaks English; install LiENa anew").arg(chosen);
    return {};
}

} // namespace console
