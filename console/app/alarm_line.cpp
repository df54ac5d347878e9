// One line of the alarm log's file.
#include "app/alarm_line.hpp"

#include <QCryptographicHash>
#include <QDateTime>
#include <QJsonDocument>
#include <QJsonObject>

#include <array>

namespace console {

namespace {

constexpr std::array words{"low", "medium", "high"};
constexpr qsizetype longestText = 400; // characters
const QByteArray chainMark = QByteArrayLiteral(",\"chain\":\"");

QByteArray chainOf(const QByteArray& before, const QByteArray& body)
{
    return QCryptographicHash::hash(before + body, QCryptographicHash::Sha256).toHex().left(32);
}

/// A JSON string, in its quotes.
QByteArray quoted(const QString& text)
{
    const auto object = QJsonDocument(QJsonObject{{QStringLiteral("t"), text}}).toJson(QJsonDocument::Compact);
    return object.mid(5, object.size() - 6);
}

} // namespace

AlarmLine alarmLine(const AlarmLogEntry& entry, const QByteArray& chain)
{
    const auto at = QDateTime::fromMSecsSinceEpoch(entry.wallMs, Qt::UTC).toString(Qt::ISODateWithMs).toLatin1();
    const QByteArray body = "{\"at\":\"" + at + "\",\"ms\":" + QByteArray::number(entry.wallMs) + ",\"priority\":\"" +
                            words.at(std::size_t(entry.priority)) + "\",\"text\":" + quoted(entry.text.left(longestText));
    const auto next = chainOf(chain, body);
    return {body + chainMark + next + "\"}\n", next};
}

ReadLine readAlarmLine(const QByteArray& line, const QByteArray& chain)
{
    ReadLine read;
    const auto object = QJsonDocument::fromJson(line).object();
    const auto end = line.lastIndexOf(chainMark);
    read.chain = object[QStringLiteral("chain")].toString().toLatin1();
    if (object.isEmpty() || end < 0)
        return read;
    read.fits = read.chain == chainOf(chain, line.left(end));
    read.entry.wallMs = object[QStringLiteral("ms")].toInteger();
    read.entry.text = object[QStringLiteral("text")].toString();
    const auto priority = object[QStringLiteral("priority")].toString();
    for (std::size_t i = 0; i < words.size(); ++i)
        if (priority == QLatin1String(words.at(i))) {
            read.entry.priority = static_cast<AlarmPriority>(i);
            read.readable = true;
        }
    return read;
}

} // namespace console
