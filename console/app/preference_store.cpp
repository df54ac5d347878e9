// Keys, words and numbers of the file.
#include "app/preference_store.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>

#include <algorithm>
#include <array>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::PreferenceStore)
};

constexpr int mostCopies = 20;

constexpr std::array<const char*, brightnessCount> brightnessWords{"dim", "usual", "bright"};
constexpr std::array<const char*, 2> spanWords{"60s", "10min"};
constexpr std::array<const char*, 5> windowWords{"as-sent", "automatic", "full-range", "narrow", "wide"}; // as in WindowChoice

constexpr std::array<const char*, 2> methodWords{"unsharp-mask", "multi-scale"}; // as in EdgeMethod

constexpr std::array<const char*, pulseRates.size()> rateWords{"7.5", "15", "30"};  // as in pulseRates
constexpr std::array<const char*, holdCounts.size()> holdWords{"1", "2", "4", "8"}; // as in holdCounts

constexpr std::array<const char*, objectHeights.size()> objectWords{"50", "75", "100", "125", "150"}; // as in objectHeights

/// Reads entries one by one, and says of each that makes no sense which it is.
class Entries {
public:
    Entries(QSettings& settings, QStringList& troubles) : m_settings(settings), m_troubles(troubles) {}

    template <std::size_t n>
    int choice(const char* key, const std::array<const char*, n>& words, int otherwise)
    {
        const QVariant value = valueOf(key);
        if (!value.isValid())
            return otherwise;
        QStringList allowed;
        for (std::size_t i = 0; i < n; ++i) {
            allowed << QString::fromLatin1(words.at(i));
            if (value.toString() == allowed.back())
                return int(i);
        }
        refuse(key, value, allowed.join(QStringLiteral(", ")));
        return otherwise;
    }

    int number(const char* key, int least, int most, int otherwise)
    {
        const QVariant value = valueOf(key);
        if (!value.isValid())
            return otherwise;
        bool good = false;
        const int found = value.toString().toInt(&good);
        if (good && found >= least && found <= most)
            return found;
        refuse(key, value, Text::tr("%1 to %2").arg(least).arg(most));
        return otherwise;
    }

    /// Nothing where nothing is written, or no such number.
    std::optional<int> numberOrNone(const char* key, int least, int most)
    {
        const int none = least - 1;
        const int found = valueOf(key).toString().isEmpty() ? none : number(key, least, most, none);
        return found == none ? std::nullopt : std::optional(found);
    }

    QString text(const char* key) const { return whole(valueOf(key)); }

    /// Exactly as it was written, or nothing.
    QString folder(const char* key)
    {
        const QVariant value = valueOf(key);
        if (value.typeId() != QMetaType::QStringList)
            return value.toString();
        refuse(key, value, Text::tr("the name of a folder, in quotes when it has a comma"));
        return {};
    }

    void refuse(const char* key, const QVariant& value, const QString& allowed)
    {
        m_troubles << Text::tr("%1: %2 is '%3', which is none of: %4. The default is used.")
                          .arg(m_settings.fileName(), QString::fromLatin1(key), whole(value).left(40), allowed);
    }

private:
    /// A line with commas that a person wrote without quotes is read as a list, which has no text of its own.
    static QString whole(const QVariant& value)
    {
        return value.typeId() == QMetaType::QStringList ? value.toStringList().join(QStringLiteral(", ")) : value.toString();
    }

    QVariant valueOf(const char* key) const { return m_settings.value(QString::fromLatin1(key)); }

    QSettings& m_settings;
    QStringList& m_troubles;
};

constexpr const char* languageKey = "language";
constexpr const char* brightnessKey = "brightness";
constexpr const char* pauseKey = "audio-pause-seconds";
constexpr const char* spanKey = "trend-span";
constexpr const char* folderKey = "picture-folder";
constexpr const char* windowKey = "window";
constexpr const char* noiseKey = "noise-reduction";
constexpr const char* edgeKey = "edge";
constexpr const char* methodKey = "edge-method";
constexpr const char* rateKey = "pulse-rate";
constexpr const char* holdKey = "hold-pictures";
constexpr const char* objectKey = "object-above-table-mm";
constexpr const char* tableTopKey = "table-top-below-isocentre-mm";
constexpr const char* patientSideKey = "patient-side";

template <typename Number, std::size_t n>
int placeOf(const std::array<Number, n>& values, Number value)
{
    return int(std::find(values.begin(), values.end(), value) - values.begin());
}

Preferences readEntries(QSettings& settings, QStringList& troubles)
{
    Entries entries(settings, troubles);
    Preferences p;
    p.language = entries.text(languageKey);
    if (!preferenceLanguages().contains(p.language))
        entries.refuse(languageKey, p.language, QStringLiteral("en, zh_CN"));
    p.brightness = Brightness(entries.choice(brightnessKey, brightnessWords, int(p.brightness)));
    p.audioPause = std::chrono::seconds(entries.number(pauseKey, int(AlarmList::leastAudioPause.count()),
                                                       int(AlarmList::mostAudioPause.count()), int(p.audioPause.count())));
    p.trendSpan = TrendSpan(entries.choice(spanKey, spanWords, int(p.trendSpan)));
    p.pictureFolder = entries.folder(folderKey);
    p.window = WindowChoice(entries.choice(windowKey, windowWords, int(p.window)));
    p.noiseReduction = entries.number(noiseKey, 0, 100, p.noiseReduction);
    p.edge = entries.number(edgeKey, 0, 100, p.edge);
    p.edgeMethod = EdgeMethod(entries.choice(methodKey, methodWords, int(p.edgeMethod)));
    p.pulseRate = pulseRates.at(std::size_t(entries.choice(rateKey, rateWords, placeOf(pulseRates, p.pulseRate))));
    p.holdPictures = holdCounts.at(std::size_t(entries.choice(holdKey, holdWords, placeOf(holdCounts, p.holdPictures))));
    p.objectHeight = objectHeights.at(std::size_t(entries.choice(objectKey, objectWords, placeOf(objectHeights, p.objectHeight))));
    p.tableTop = entries.numberOrNone(tableTopKey, -Preferences::farthestTableTop, Preferences::farthestTableTop);
    p.patientSide = entries.text(patientSideKey);
    const Preferences bounded = withinBounds(p);
    if (bounded.pictureFolder != p.pictureFolder.trimmed())
        entries.refuse(folderKey, p.pictureFolder, Text::tr("the name of a folder"));
    if (bounded.patientSide != p.patientSide.trimmed())
        entries.refuse(patientSideKey, p.patientSide, Text::tr("one short line"));
    return bounded;
}

void writeEntries(QSettings& settings, const Preferences& p)
{
    const auto set = [&settings](const char* key, const QVariant& value) { settings.setValue(QString::fromLatin1(key), value); };
    set(languageKey, p.language);
    set(brightnessKey, QString::fromLatin1(brightnessWords.at(std::size_t(p.brightness))));
    set(pauseKey, int(p.audioPause.count()));
    set(spanKey, QString::fromLatin1(spanWords.at(std::size_t(p.trendSpan))));
    set(folderKey, p.pictureFolder);
    set(windowKey, QString::fromLatin1(windowWords.at(std::size_t(p.window))));
    set(noiseKey, p.noiseReduction);
    set(edgeKey, p.edge);
    set(methodKey, QString::fromLatin1(methodWords.at(std::size_t(p.edgeMethod))));
    set(rateKey, QString::fromLatin1(rateWords.at(std::size_t(placeOf(pulseRates, p.pulseRate)))));
    set(holdKey, QString::fromLatin1(holdWords.at(std::size_t(placeOf(holdCounts, p.holdPictures)))));
    set(objectKey, QString::fromLatin1(objectWords.at(std::size_t(placeOf(objectHeights, p.objectHeight)))));
    set(tableTopKey, p.tableTop ? QString::number(*p.tableTop) : QString());
    set(patientSideKey, p.patientSide);
}

/// Why the file is not even tried; nothing when it can be.
QString unreadable(const QString& path)
{
    QFile file(path);
    if (!file.exists())
        return {};
    if (!QFileInfo(path).isFile())
        return Text::tr("%1 is not a file. The defaults are used.").arg(path);
    if (file.size() > PreferenceStore::mostBytes)
        return Text::tr("%1 is too long for preferences (%2 bytes). The defaults are used.").arg(path).arg(file.size());
    if (!file.open(QIODevice::ReadOnly))
        return Text::tr("%1 cannot be read: %2. The defaults are used.").arg(path, file.errorString());
    if (file.readAll().contains('\0'))
        return Text::tr("%1 is not a file of preferences. The defaults are used.").arg(path);
    return {};
}

} // namespace

PreferenceStore::PreferenceStore(QString path) : m_path(std::move(path)) {}

PreferenceStore::Reading PreferenceStore::read()
{
    Reading reading;
    m_damaged = true;
    if (const QString why = unreadable(m_path); !why.isEmpty()) {
        reading.troubles << why;
        return reading;
    }
    QSettings settings(m_path, QSettings::IniFormat);
    settings.sync();
    reading.preferences = readEntries(settings, reading.troubles);
    if (settings.status() != QSettings::NoError)
        reading.troubles << Text::tr("%1 cannot be read as a whole: what was not understood has its default.").arg(m_path);
    m_damaged = !reading.troubles.isEmpty();
    return reading;
}

QString PreferenceStore::keepCopy()
{
    for (int copy = 1; copy <= mostCopies; ++copy)
        if (QFile::copy(m_path, QStringLiteral("%1.kept-%2").arg(m_path).arg(copy)))
            return {};
    return Text::tr("%1 was not understood, and no copy of it can be kept beside it. Nothing was written; move it away.").arg(m_path);
}

QString PreferenceStore::write(const Preferences& preferences)
{
    if (m_damaged && QFileInfo::exists(m_path)) {
        if (QString why = keepCopy(); !why.isEmpty())
            return why;
        if (!unreadable(m_path).isEmpty())
            QFile::remove(m_path);
    }
    m_damaged = false;
    QDir().mkpath(QFileInfo(m_path).absolutePath());
    QSettings settings(m_path, QSettings::IniFormat);
    writeEntries(settings, withinBounds(preferences));
    settings.sync();
    if (settings.status() == QSettings::NoError && settings.isWritable())
        return {};
    return Text::tr("%1 cannot be written: this choice lasts for this run only. Look at the folder's permissions and the disk.")
        .arg(m_path);
}

QString preferenceFile()
{
    return QDir(QStandardPaths::writableLocation(QStandardPaths::AppConfigLocation)).filePath(QStringLiteral("preferences.ini"));
}

} // namespace console
