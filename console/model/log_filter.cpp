// Filtering and writing out of a log.
#include "model/log_filter.hpp"

#include "model/log_roles.hpp"

#include <QCoreApplication>
#include <QDateTime>
#include <QStringList>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::LogFilter)
};

QString utc(qint64 wallMs) { return QDateTime::fromMSecsSinceEpoch(wallMs, Qt::UTC).toString(Qt::ISODateWithMs); }

QString oneLine(QString text)
{
    for (auto& character : text)
        if (character.category() == QChar::Other_Control || character == QChar::LineSeparator || character == QChar::ParagraphSeparator)
            character = QLatin1Char(' ');
    return text;
}

QString kindsText(const LogFilter& filter)
{
    QStringList words;
    for (int row = 0; row < filter.sourceModel()->rowCount(); ++row) {
        const auto index = filter.sourceModel()->index(row, 0);
        const auto word = index.data(LogKindWordRole).toString();
        if (filter.kinds().contains(index.data(LogKindRole).toInt()) && !words.contains(word))
            words << word;
    }
    return words.isEmpty() ? Text::tr("of the chosen kinds there is none") : words.join(Text::tr(", "));
}

} // namespace

LogFilter::LogFilter(QObject* parent) : QSortFilterProxyModel(parent) {}

void LogFilter::setKinds(const QSet<int>& kinds)
{
    if (m_kinds == kinds)
        return;
    m_kinds = kinds;
    invalidateFilter();
}

void LogFilter::setWords(const QString& words)
{
    if (m_words == words)
        return;
    m_words = words;
    invalidateFilter();
}

bool LogFilter::filterAcceptsRow(int row, const QModelIndex& parent) const
{
    const auto index = sourceModel()->index(row, 0, parent);
    if (!m_kinds.isEmpty() && !m_kinds.contains(index.data(LogKindRole).toInt()))
        return false;
    return m_words.isEmpty() || index.data(LogTextRole).toString().contains(m_words, Qt::CaseInsensitive);
}

QByteArray logText(const LogFilter& filter, const QString& name, qint64 writtenWallMs)
{
    const int all = filter.sourceModel() != nullptr ? filter.sourceModel()->rowCount() : 0;
    QString text = Text::tr("# LiENa console, %1, written %2\n").arg(name, utc(writtenWallMs));
    text += Text::tr("# %1 of %2 lines\n").arg(filter.rowCount()).arg(all);
    if (!filter.kinds().isEmpty())
        text += Text::tr("# kinds: %1\n").arg(kindsText(filter));
    if (!filter.words().isEmpty())
        text += Text::tr("# with the words: %1\n").arg(oneLine(filter.words()));
    for (int row = 0; row < filter.rowCount(); ++row) {
        const auto index = filter.index(row, 0);
        text += QStringLiteral("%1\t%2\t%3\n")
                    .arg(utc(index.data(LogWallRole).toLongLong()), index.data(LogKindWordRole).toString(),
                         oneLine(index.data(LogTextRole).toString()));
    }
    return text.toUtf8();
}

} // namespace console
