// JSON of the layouts.
#include "app/layout_book.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSaveFile>

#include <algorithm>
#include <array>
#include <optional>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::LayoutBook)
};

constexpr int mostCopies = 20;
constexpr int longestScreen = 200;
constexpr std::array<const char*, arrangementCount> arrangementWords{"usual", "reference-beside", "scene-beside"};

QJsonObject toJson(const ScreenLayout& layout)
{
    return {{QStringLiteral("name"), layout.name},
            {QStringLiteral("arrangement"), QString::fromLatin1(arrangementWords.at(std::size_t(layout.arrangement)))},
            {QStringLiteral("cockpit"), layout.cockpit},
            {QStringLiteral("second"), layout.second},
            {QStringLiteral("third"), layout.third}};
}

std::optional<ScreenLayout> fromJson(const QJsonObject& json)
{
    const auto text = [&json](const char* key) { return json.value(QLatin1String(key)).toString().left(longestScreen); };
    ScreenLayout layout;
    layout.name = LayoutBook::cleaned(text("name"));
    const auto place = std::find_if(arrangementWords.begin(), arrangementWords.end(),
                                    [wanted = text("arrangement")](const char* word) { return wanted == QLatin1String(word); });
    if (layout.name.isEmpty() || place == arrangementWords.end())
        return std::nullopt;
    layout.arrangement = Arrangement(place - arrangementWords.begin());
    layout.cockpit = text("cockpit");
    layout.second = text("second");
    layout.third = text("third");
    return layout;
}

bool has(const std::vector<ScreenLayout>& layouts, const QString& name)
{
    return std::any_of(layouts.begin(), layouts.end(), [&name](const ScreenLayout& l) { return l.name == name; });
}

} // namespace

LayoutBook::LayoutBook(QString path) : m_path(std::move(path)) {}

QString LayoutBook::cleaned(const QString& name)
{
    QString clean;
    for (const QChar c : name)
        clean += c.category() == QChar::Other_Control || c.category() == QChar::Other_Format ? QLatin1Char(' ') : c;
    clean = clean.simplified().left(longestName);
    if (!clean.isEmpty() && clean.back().isHighSurrogate())
        clean.chop(1);
    return clean.trimmed();
}

QStringList LayoutBook::read()
{
    m_layouts.clear();
    QFile file(m_path);
    if (m_path.isEmpty() || !file.exists())
        return {};
    m_damaged = true;
    if (!QFileInfo(m_path).isFile() || file.size() > mostBytes || !file.open(QIODevice::ReadOnly))
        return {Text::tr("%1 cannot be read as layouts of screens. There are none until one is saved.").arg(m_path)};
    QJsonParseError error{};
    const auto json = QJsonDocument::fromJson(file.readAll(), &error);
    if (!json.isObject() || !json.object().value(QStringLiteral("layouts")).isArray())
        return {Text::tr("%1 is not understood at byte %2: %3. There are no layouts until one is saved.")
                    .arg(m_path)
                    .arg(error.offset)
                    .arg(error.error == QJsonParseError::NoError ? Text::tr("no list of layouts") : error.errorString())};
    QStringList troubles;
    int number = 0;
    for (const auto& entry : json.object().value(QStringLiteral("layouts")).toArray()) {
        ++number;
        const auto layout = fromJson(entry.toObject());
        if (layout && m_layouts.size() < most && !has(m_layouts, layout->name))
            m_layouts.push_back(*layout);
        else
            troubles << Text::tr("%1: layout %2 makes no sense and is left out.").arg(m_path).arg(number);
    }
    m_damaged = !troubles.isEmpty();
    return troubles.mid(0, 3);
}

QString LayoutBook::save(ScreenLayout layout)
{
    layout.name = cleaned(layout.name);
    if (layout.name.isEmpty())
        return Text::tr("A layout needs a name.");
    const auto same = std::find_if(m_layouts.begin(), m_layouts.end(), [&](const ScreenLayout& l) { return l.name == layout.name; });
    if (same == m_layouts.end() && m_layouts.size() >= most)
        return Text::tr("There are %1 layouts already. Delete one first.").arg(most);
    if (same != m_layouts.end())
        *same = layout;
    else
        m_layouts.push_back(layout);
    return write();
}

QString LayoutBook::remove(std::size_t place)
{
    if (place >= m_layouts.size())
        return {};
    m_layouts.erase(m_layouts.begin() + std::ptrdiff_t(place));
    return write();
}

QString LayoutBook::write()
{
    if (m_path.isEmpty())
        return Text::tr("This run has no file of layouts: the layout lasts for this run only.");
    if (!QFileInfo::exists(m_path))
        m_damaged = false; // it was moved or deleted since: there is nothing to keep
    for (int copy = 1; m_damaged && copy <= mostCopies; ++copy)
        m_damaged = !QFile::copy(m_path, QStringLiteral("%1.kept-%2").arg(m_path).arg(copy));
    if (m_damaged)
        return Text::tr("%1 was not understood, and no copy of it can be kept. Nothing was written; move it away.").arg(m_path);
    QJsonArray layouts;
    for (const ScreenLayout& layout : m_layouts)
        layouts.append(toJson(layout));
    const QByteArray text = QJsonDocument(QJsonObject{{QStringLiteral("layouts"), layouts}}).toJson();
    QDir().mkpath(QFileInfo(m_path).absolutePath());
    QSaveFile file(m_path);
    if (file.open(QIODevice::WriteOnly) && file.write(text) == text.size() && file.commit())
        return {};
    return Text::tr("%1 cannot be written: %2. The layout lasts for this run only.").arg(m_path, file.errorString());
}

} // namespace console
