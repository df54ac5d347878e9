// The language of what is shown: English as in the sources, others from the catalogues in the program.
#pragma once

#include <QString>
#include <QStringList>

namespace console {

/// What every text is in before it is translated: "en".
QString sourceLanguage();

/// English first, then every language that has a catalogue, for example "zh_CN".
QStringList languages();

/// Of `wanted`, a system's languages by preference such as "zh-Hans-CN" or "de", the first that the console speaks; else English.
QString spokenOf(const QStringList& wanted);

/// From now on texts are in `language`, one of languages(); empty: the system's. Once, after theme::apply(), which brings the typefaces,
/// and before the first widget. Where no typeface has the language's characters English stays: what would be empty boxes warns nobody.
/// Returns why, or nothing.
QString speak(const QString& language);

} // namespace console
