// Bounds and words of the preferences.
#include "model/preferences.hpp"

#include "model/motion_permit.hpp"

#include <QCoreApplication>

#include <algorithm>
#include <cstdlib>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::Preferences)
};

/// Empty when it is more than that.
QString oneLine(const QString& text, int mostCharacters)
{
    const auto trimmed = text.trimmed();
    const auto control = [](QChar c) { return c.category() == QChar::Other_Control; };
    return trimmed.size() > mostCharacters || std::any_of(trimmed.cbegin(), trimmed.cend(), control) ? QString() : trimmed;
}

} // namespace

QString word(Brightness brightness)
{
    switch (brightness) {
    case Brightness::Dim:
        return Text::tr("dim");
    case Brightness::Usual:
        return Text::tr("usual");
    case Brightness::Bright:
        return Text::tr("bright");
    }
    return QStringLiteral("?");
}

QStringList preferenceLanguages() { return {QString(), QStringLiteral("en"), QStringLiteral("zh_CN")}; }

Preferences withinBounds(Preferences preferences)
{
    if (!preferenceLanguages().contains(preferences.language))
        preferences.language.clear();
    preferences.audioPause = std::clamp(preferences.audioPause, AlarmList::leastAudioPause, AlarmList::mostAudioPause);
    preferences.noiseReduction = std::clamp(preferences.noiseReduction, 0, 100);
    preferences.edge = std::clamp(preferences.edge, 0, 100);
    if (std::find(pulseRates.begin(), pulseRates.end(), preferences.pulseRate) == pulseRates.end())
        preferences.pulseRate = Preferences().pulseRate;
    if (std::find(holdCounts.begin(), holdCounts.end(), preferences.holdPictures) == holdCounts.end())
        preferences.holdPictures = Preferences().holdPictures;
    if (std::find(objectHeights.begin(), objectHeights.end(), preferences.objectHeight) == objectHeights.end())
        preferences.objectHeight = Preferences().objectHeight;
    if (preferences.tableTop && std::abs(*preferences.tableTop) > Preferences::farthestTableTop) // a bound would be another plane
        preferences.tableTop.reset();
    if (preferences.window == WindowChoice::Fixed) // a window by hand belongs to one picture
        preferences.window = WindowChoice::AsSent;
    preferences.pictureFolder = oneLine(preferences.pictureFolder, Preferences::mostFolder);
    preferences.patientSide = oneLine(preferences.patientSide, Preferences::mostContact);
    return preferences;
}

bool preferencesMayChange(PermitPhase phase)
{
    return phase != PermitPhase::Arming && phase != PermitPhase::Armed && phase != PermitPhase::Engaged && phase != PermitPhase::Hold;
}

} // namespace console
