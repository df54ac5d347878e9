// A hand that was recorded.
#include "input/recorded_master.hpp"

#include <QFile>
#include <QStringList>

#include <algorithm>
#include <array>
#include <cmath>

namespace console {

namespace {

constexpr double degreesPerMillimetre = 10;
constexpr unsigned deadManBit = 1U;
constexpr unsigned clutchBit = 2U;
constexpr qint64 largestFile = 64LL * 1024 * 1024;

struct Reader {
    QString file;
    int line = 0;
    QString error;

    bool fail(int column, const QString& text)
    {
        error = QStringLiteral("%1:%2:%3: %4").arg(file).arg(line).arg(column).arg(text);
        return false;
    }

    bool read(const QString& text, HandSample& sample)
    {
        const auto cells = text.split(QLatin1Char(','));
        if (cells.size() != 5)
            return fail(1, RecordedMaster::tr("%1 values instead of 5; write time,x,y,z,buttons").arg(cells.size()));
        std::array<double, 4> numbers{};
        int column = 1;
        for (std::size_t cell = 0; cell < numbers.size(); ++cell) {
            const auto& word = cells.at(static_cast<qsizetype>(cell));
            bool good = false;
            numbers[cell] = word.trimmed().toDouble(&good);
            if (!good || !std::isfinite(numbers[cell]))
                return fail(column, RecordedMaster::tr("'%1' is not a number").arg(word.left(20)));
            column += static_cast<int>(word.size()) + 1;
        }
        bool good = false;
        sample.buttons = cells.at(4).trimmed().toUInt(&good);
        if (!good)
            return fail(column, RecordedMaster::tr("'%1' is not a set of buttons; write a whole number").arg(cells.at(4).left(20)));
        sample.time = numbers[0];
        sample.position = {numbers[1], numbers[2], numbers[3]};
        return true;
    }
};

} // namespace

std::optional<std::vector<HandSample>> readRecording(const QString& text, const QString& file, QString* error)
{
    Reader reader{file, 0, {}};
    std::vector<HandSample> samples;
    const auto lines = text.split(QLatin1Char('\n'));
    bool good = true;
    for (const auto& raw : lines) {
        ++reader.line;
        const auto line = raw.trimmed();
        if (reader.line == 1 && line != QLatin1String("time,x,y,z,buttons"))
            good = reader.fail(1, RecordedMaster::tr("the first line must be time,x,y,z,buttons"));
        if (!good)
            break;
        if (reader.line == 1 || line.isEmpty())
            continue;
        HandSample sample;
        good = reader.read(line, sample);
        if (good && (samples.empty() ? sample.time != 0 : sample.time <= samples.back().time))
            good = reader.fail(1, RecordedMaster::tr("time must start at 0 and rise from line to line"));
        samples.push_back(sample);
    }
    if (good && samples.size() < 2)
        good = reader.fail(1, RecordedMaster::tr("at least two samples are needed"));
    if (good)
        return samples;
    if (error != nullptr)
        *error = reader.error;
    return std::nullopt;
}

std::vector<HandSample> RecordedMaster::load(const QString& path, QString* error)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly | QIODevice::Text) || file.size() > largestFile) {
        if (error != nullptr)
            *error = tr("%1: cannot be read: %2").arg(path, file.isOpen() ? tr("larger than 64 MiB") : file.errorString());
        return {};
    }
    return readRecording(QString::fromUtf8(file.readAll()), path, error).value_or(std::vector<HandSample>{});
}

RecordedMaster::RecordedMaster(std::vector<HandSample> samples, QObject* parent) : MasterDevice(parent), m_samples(std::move(samples)) {}

QString RecordedMaster::name() const { return word(kind()); }

QString RecordedMaster::legend() const { return tr("moves as it was recorded while D is held"); }

MasterLife RecordedMaster::life(Instant) const { return m_samples.empty() ? MasterLife::Gone : MasterLife::Alive; }

Duration RecordedMaster::length() const { return m_samples.empty() ? Duration::zero() : fromMilliseconds(m_samples.back().time * 1000); }

HandSample RecordedMaster::at(double time) const
{
    const auto after = std::upper_bound(m_samples.begin(), m_samples.end(), time, [](double t, const HandSample& s) { return t < s.time; });
    if (after == m_samples.begin())
        return m_samples.front();
    if (after == m_samples.end())
        return m_samples.back();
    const auto& before = *std::prev(after);
    HandSample sample = before;
    const double part = (time - before.time) / (after->time - before.time);
    for (std::size_t axis = 0; axis < sample.position.size(); ++axis)
        sample.position[axis] += part * (after->position[axis] - before.position[axis]);
    sample.time = time;
    return sample;
}

MasterReading RecordedMaster::read(Instant now)
{
    MasterReading reading;
    if (m_samples.empty())
        return reading;
    reading.alive = true;
    if (!m_begin) {
        reading.deadMan = (m_samples.front().buttons & deadManBit) != 0;
        return reading;
    }
    // A recording that is shorter than its use starts again; where it jumps nothing moves.
    const double end = m_samples.back().time;
    double time = seconds(now - *m_begin);
    if (time > end) {
        rezero(now);
        time = 0;
    }
    const auto sample = at(time);
    const auto velocity = m_tracker.velocity(sample.position, now);
    reading.deadMan = (sample.buttons & deadManBit) != 0;
    reading.clutch = (sample.buttons & clutchBit) != 0;
    if (!reading.clutch)
        reading.motion = {velocity[2], velocity[0] * degreesPerMillimetre, velocity[1], 0};
    return reading;
}

void RecordedMaster::rezero(Instant now)
{
    m_begin = now;
    m_tracker.rezero();
}

} // namespace console
