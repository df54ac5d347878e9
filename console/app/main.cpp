// liena-console: the surgeon's console.
#include "app/cockpit_application.hpp"
#include "app/command_line.hpp"
#include "app/language.hpp"
#include "app/preference_store.hpp"

#include "widgets/theme.hpp"

#include <QApplication>

#include <cstdio>

namespace {

int printed(FILE* stream, const QString& text, int status)
{
    std::fputs(qUtf8Printable(text), stream);
    return status;
}

/// What can be said without a screen is said without one.
std::optional<int> answerAtOnce(int argc, char** argv, console::Options& options)
{
    const QCoreApplication early(argc, argv);
    const auto line = console::readCommandLine(QCoreApplication::arguments());
    options = line.options;
    switch (line.outcome) {
    case console::CommandLine::Outcome::Run:
        return std::nullopt;
    case console::CommandLine::Outcome::Help:
    case console::CommandLine::Outcome::Version:
        return printed(stdout, line.text, 0);
    case console::CommandLine::Outcome::Mistake:
        break;
    }
    return printed(stderr, QStringLiteral("liena-console: %1\n").arg(line.text), 2);
}

/// What was asked for, else the person's preference. A report is read by programs: it does not change with either.
QString languageOf(const console::Options& options)
{
    if (!options.language.isEmpty())
        return options.language;
    if (options.unattended)
        return console::sourceLanguage();
    return options.preferences.isEmpty() ? QString() : console::PreferenceStore(options.preferences).read().preferences.language;
}

} // namespace

int main(int argc, char** argv)
{
    QCoreApplication::setApplicationName(QStringLiteral("liena-console"));
    QCoreApplication::setApplicationVersion(QStringLiteral(LIENA_VERSION));
    console::Options options;
    if (const auto status = answerAtOnce(argc, argv, options))
        return *status;
    QApplication application(argc, argv);
    console::theme::apply(application);
    if (const auto trouble = console::speak(languageOf(options)); !trouble.isEmpty())
        printed(stderr, QStringLiteral("liena-console: %1\n").arg(trouble), 0);
    console::CockpitApplication cockpit(options);
    QString error;
    if (!cockpit.prepare(&error))
        return printed(stderr, QStringLiteral("liena-console: %1\n").arg(error), 1);
    return cockpit.run();
}
