// The vascular tree as centre lines with radii, read from an SWC file, and the way along it to a point.
#include "imaging/vessel_tree.hpp"

#include <QCoreApplication>
#include <QFile>
#include <QHash>

#include <algorithm>
#include <cmath>
#include <limits>

namespace console {

namespace {

constexpr qint64 longestFile = 32 * 1024 * 1024;
constexpr qint64 longestLine = 1024;
constexpr std::size_t mostPoints = 200000;
constexpr float farthest = 5000;

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::VesselTree)
};

// One point line; nothing and a reason when it is not one.
class SwcReader {
public:
    bool take(const QByteArray& line)
    {
        const QList<QByteArray> words = line.simplified().split(' ');
        if (words.size() < 7)
            return refuse(Text::tr("seven numbers are expected: number, kind, x, y, z, radius, parent"));
        bool ok = true;
        const int number = asInt(words[0], ok);
        const float x = asLength(words[2], ok);
        const float y = asLength(words[3], ok);
        const float z = asLength(words[4], ok);
        const float radius = asLength(words[5], ok);
        const int parentNumber = asInt(words[6], ok);
        if (!ok || radius < 0)
            return refuse(Text::tr("a number cannot be read, or is out of range"));
        return add(number, parentNumber, {QVector3D(x, y, z), radius, -1});
    }

    VesselTree tree;
    QString reason;

private:
    bool add(int number, int parentNumber, VesselPoint point)
    {
        if (m_places.contains(number))
            return refuse(Text::tr("the point number is used twice"));
        if (tree.points.size() >= mostPoints)
            return refuse(Text::tr("there are more than 200 000 points"));
        if (parentNumber >= 0) {
            const auto parent = m_places.constFind(parentNumber);
            if (parent == m_places.constEnd())
                return refuse(Text::tr("the parent must stand before its children"));
            point.parent = *parent;
        }
        m_places.insert(number, static_cast<int>(tree.points.size()));
        tree.points.push_back(point);
        return true;
    }

    bool refuse(const QString& why)
    {
        reason = why;
        return false;
    }

    static int asInt(const QByteArray& word, bool& ok)
    {
        bool read = false;
        const int value = word.toInt(&read);
        ok = ok && read;
        return value;
    }

    static float asLength(const QByteArray& word, bool& ok)
    {
        bool read = false;
        const float value = word.toFloat(&read);
        ok = ok && read && std::isfinite(value) && std::abs(value) <= farthest;
        return value;
    }

    QHash<int, int> m_places;
};

} // namespace

std::vector<QVector3D> VesselTree::wayTo(const QVector3D& target, float reach) const
{
    int nearest = -1;
    float best = reach * reach;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float distance = (points[i].position - target).lengthSquared();
        if (distance <= best) {
            best = distance;
            nearest = static_cast<int>(i);
        }
    }
    std::vector<QVector3D> way;
    for (int i = nearest; i >= 0; i = points[static_cast<std::size_t>(i)].parent)
        way.push_back(points[static_cast<std::size_t>(i)].position);
    std::reverse(way.begin(), way.end());
    return way;
}

VesselTreeResult readVesselTree(const QString& path)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        return {std::nullopt, Text::tr("%1 cannot be read: %2. Name a vessel tree (SWC) in the settings.").arg(path, file.errorString())};
    if (file.size() > longestFile)
        return {std::nullopt, Text::tr("%1 is larger than 32 MiB and is not read.").arg(path)};
    SwcReader reader;
    for (int number = 1; !file.atEnd(); ++number) {
        const QByteArray line = file.readLine(longestLine).trimmed();
        if (line.isEmpty() || line.startsWith('#'))
            continue;
        if (!reader.take(line))
            return {std::nullopt, Text::tr("%1:%2: %3.").arg(path).arg(number).arg(reader.reason)};
    }
    if (reader.tree.isEmpty())
        return {std::nullopt, Text::tr("%1 holds no vessel point.").arg(path)};
    return {std::move(reader.tree), {}};
}

} // namespace console
