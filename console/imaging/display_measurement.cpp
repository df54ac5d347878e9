// Reads the file of a measured display.
#include "imaging/grey_scale.hpp"

#include <QCoreApplication>
#include <QFile>

#include <cmath>

namespace console {

namespace {

constexpr qint64 longestFile = 64 * 1024;
constexpr double brightest = 100000; ///< cd/m²; no display is brighter
constexpr int highestLevel = 255;

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::DisplayMeasurement)
};

/// One line after the other; `reason` says what is wrong with the one that was refused.
class Reader {
public:
    bool take(const QByteArray& line)
    {
        const QList<QByteArray> words = line.split('#').front().simplified().split(' ');
        if (words.size() == 1 && words.front().isEmpty())
            return true;
        if (words.size() != 2)
            return refuse(Text::tr("two words are expected: a level and its light in cd/m\u00B2, or ambient and its light"));
        bool number = false;
        const double light = words[1].toDouble(&number);
        if (!number || !(light >= 0) || light > brightest)
            return refuse(Text::tr("the light is not a number from 0 to 100000 cd/m\u00B2"));
        if (words[0] == "ambient") {
            measurement.ambient = light;
            return true;
        }
        return addGrey(words[0], light);
    }

    bool isComplete()
    {
        const auto& greys = measurement.greys;
        return (greys.size() >= 2 && greys.front().level == 0 && greys.back().level == highestLevel) ||
               refuse(Text::tr("the levels 0 and 255 must be among those measured"));
    }

    DisplayMeasurement measurement;
    QString reason;

private:
    bool addGrey(const QByteArray& word, double light)
    {
        bool number = false;
        const int level = word.toInt(&number);
        if (!number || level < 0 || level > highestLevel)
            return refuse(Text::tr("the level is not a whole number from 0 to 255"));
        auto& greys = measurement.greys;
        if (!greys.empty() && (level <= greys.back().level || light <= greys.back().luminance))
            return refuse(Text::tr("level and light must both be greater than on the line before; measure again"));
        greys.push_back({level, light});
        return true;
    }

    bool refuse(const QString& why)
    {
        reason = why;
        return false;
    }
};

} // namespace

DisplayMeasurementResult readDisplayMeasurement(const QString& path)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        return {std::nullopt, Text::tr("%1 cannot be read: %2. Name a display's measurement.").arg(path, file.errorString())};
    if (file.size() > longestFile)
        return {std::nullopt, Text::tr("%1 is larger than 64 KiB and is no display's measurement.").arg(path)};
    Reader reader;
    int number = 0;
    while (!file.atEnd()) {
        ++number;
        if (!reader.take(file.readLine()))
            return {std::nullopt, Text::tr("%1:%2: %3.").arg(path).arg(number).arg(reader.reason)};
    }
    if (!reader.isComplete())
        return {std::nullopt, Text::tr("%1:%2: %3.").arg(path).arg(number).arg(reader.reason)};
    return {reader.measurement, {}};
}

} // namespace console
