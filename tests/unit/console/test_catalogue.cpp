// Each catalogue says every text of the sources, nothing that they no longer say, and loses no number and no unit.
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QMap>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>
#include <QXmlStreamReader>

namespace {

struct Entry {
    QString context;
    QString source;
    QString translation;
    QString state; ///< unfinished, vanished, obsolete; empty: done
};

QString folder() { return QStringLiteral(LIENA_SOURCE_DIR "/resources/translations/"); }

// lupdate writes characters that XML has no place for as <byte value="x1b"/>; none of our texts has one.
std::vector<Entry> readCatalogue(const QString& path)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        return {};
    std::vector<Entry> entries;
    QString context;
    QXmlStreamReader xml(&file);
    while (!xml.atEnd()) {
        if (xml.readNext() != QXmlStreamReader::StartElement)
            continue;
        if (xml.name() == QLatin1String("name"))
            context = xml.readElementText();
        else if (xml.name() == QLatin1String("message"))
            entries.push_back({context, {}, {}, {}});
        else if (xml.name() == QLatin1String("source"))
            entries.back().source = xml.readElementText();
        else if (xml.name() == QLatin1String("translation")) {
            entries.back().state = xml.attributes().value(QLatin1String("type")).toString();
            entries.back().translation = xml.readElementText();
        }
    }
    return xml.hasError() ? std::vector<Entry>() : entries;
}

QStringList found(const QRegularExpression& what, const QString& text)
{
    QStringList all;
    for (auto match = what.globalMatch(text); match.hasNext();)
        all << match.next().captured().remove(QLatin1Char(' ')).remove(QChar(0x00A0));
    all.sort();
    return all;
}

/// %1, %2, …, each as often as it stands there.
QStringList places(const QString& text) { return found(QRegularExpression(QStringLiteral("%(\\d+|n)")), text); }

/// A number or a place with the unit behind it: "%1 ms", "1.5 s", "99 %".
QStringList quantities(const QString& text)
{
    static const QRegularExpression quantity(
        QStringLiteral("(%\\d|\\d[\\d.]*)[ \u00A0]?"
                       "(mm/s|mm|ms|mL|mGy/min|mGy|Gy|min|MiB|KiB|MB|kHz|fps|px|/s|cd/m\u00B2|\u00B0C|\u00B0|"
                       "\u00D7|%(?!\\d)|N|F|s)(?![A-Za-z\\d])"));
    return found(quantity, text);
}

/// A text that is a unit alone is the same in every language.
bool isUnit(const QString& text)
{
    static const QRegularExpression unit(QStringLiteral("^(mm/s|mm|ms|mL|mGy/min|mGy|Gy\u00B7cm\u00B2|N|A|%|\u00B0|\u00B0/s|\u00B0C)$"));
    return unit.match(text).hasMatch();
}

/// What is wrong with one translation, or nothing.
QString fault(const Entry& entry)
{
    if (entry.state == QLatin1String("vanished") || entry.state == QLatin1String("obsolete"))
        return QStringLiteral("no source says it any more");
    if (entry.translation.trimmed().isEmpty())
        return QStringLiteral("is not translated");
    if (!entry.state.isEmpty())
        return QStringLiteral("is %1").arg(entry.state);
    if (places(entry.source) != places(entry.translation))
        return QStringLiteral("has the places %1 and its translation %2")
            .arg(places(entry.source).join(QLatin1Char(' ')), places(entry.translation).join(QLatin1Char(' ')));
    if (quantities(entry.source) != quantities(entry.translation))
        return QStringLiteral("has the quantities \"%1\" and its translation \"%2\"")
            .arg(quantities(entry.source).join(QLatin1Char(' ')), quantities(entry.translation).join(QLatin1Char(' ')));
    if (isUnit(entry.source) && entry.translation != entry.source)
        return QStringLiteral("is a unit, and its translation is %1").arg(entry.translation);
    const auto lines = [](const QString& text) { return text.count(QLatin1Char('\n')); };
    if (lines(entry.source) != lines(entry.translation))
        return QStringLiteral("has another number of lines");
    return {};
}

QStringList faults(const std::vector<Entry>& entries)
{
    QStringList wrong;
    for (const Entry& entry : entries)
        if (const auto why = fault(entry); !why.isEmpty())
            wrong << QStringLiteral("%1: \"%2\" %3").arg(entry.context, entry.source, why);
    return wrong;
}

} // namespace

class TestCatalogue : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void seesWhatIsLost_data()
    {
        QTest::addColumn<QString>("source");
        QTest::addColumn<QString>("translation");
        QTest::addColumn<QString>("state");
        QTest::addColumn<bool>("good");
        const auto row = [](const char* name, const char* source, const char* translation, const char* state, bool good) {
            QTest::newRow(name) << QString::fromUtf8(source) << QString::fromUtf8(translation) << QString::fromUtf8(state) << good;
        };
        row("whole", "Force %1 N", "受力 %1 N", "", true);
        row("places in another order", "%1 of %2 lines", "%2 行中的 %1 行", "", true);
        row("place lost", "%1 of %2 lines", "%1 行", "", false);
        row("place twice", "%1 lines", "%1 行 %1", "", false);
        row("unit lost", "jitter above %1 ms", "抖动超过 %1", "", false);
        row("unit changed", "hold 1.5 s", "按住 1.5 ms", "", false);
        row("number changed", "hold 1.5 s", "按住 2 s", "", false);
        row("per cent lost", "noise %1 %", "降噪 %1", "", false);
        row("unit alone", "mm", "毫米", "", false);
        row("empty", "Close", "", "", false);
        row("unfinished", "Close", "关闭", "unfinished", false);
        row("gone from the sources", "Close", "关闭", "vanished", false);
        row("line lost", "lost,\nin stand-by", "丢失，待机", "", false);
    }

    void seesWhatIsLost()
    {
        QFETCH(QString, source);
        QFETCH(QString, translation);
        QFETCH(QString, state);
        QFETCH(bool, good);
        QCOMPARE(fault({QStringLiteral("Test"), source, translation, state}).isEmpty(), good);
    }

    void catalogueIsWhole_data()
    {
        QTest::addColumn<QString>("catalogue");
        for (const QString& name : QDir(folder()).entryList({QStringLiteral("*.ts")}, QDir::Files))
            QTest::newRow(qPrintable(name)) << name;
    }

    // As the target `translations` does it, but into a copy, and what the sources no longer say is kept to be named.
    void catalogueIsWhole()
    {
        QFETCH(QString, catalogue);
        const QTemporaryDir temporary;
        const QString copy = temporary.filePath(catalogue);
        QVERIFY(QFile::copy(folder() + catalogue, copy));
        QVERIFY(QFile::setPermissions(copy, QFile::ReadOwner | QFile::WriteOwner));
        QProcess lupdate;
        lupdate.start(QStringLiteral(LIENA_LUPDATE),
                      {QStringLiteral(LIENA_SOURCE_DIR "/console"), QStringLiteral("-extensions"), QStringLiteral("cpp,hpp"),
                       QStringLiteral("-locations"), QStringLiteral("none"), QStringLiteral("-disable-heuristic"),
                       QStringLiteral("sametext"), QStringLiteral("-ts"), copy});
        QVERIFY2(lupdate.waitForFinished(60000) && lupdate.exitCode() == 0, lupdate.readAllStandardError().constData());
        const auto entries = readCatalogue(copy);
        QVERIFY(entries.size() > 500);
        const auto wrong = faults(entries);
        QVERIFY2(
            wrong.isEmpty(),
            qPrintable(
                wrong.join(QLatin1Char('\n')) +
                QStringLiteral("\nBuild the target `translations`, then translate what is unfinished in %1.").arg(folder() + catalogue)));
    }

    void oneStateHasOneWord_data() { catalogueIsWhole_data(); }

    void oneStateHasOneWord()
    {
        QFETCH(QString, catalogue);
        // A line carries nothing, a master answers nothing; and lists of causes and of names differ.
        const QStringList differing{QStringLiteral("silent"), QStringLiteral(", ")};
        QMap<QString, Entry> first;
        QStringList wrong;
        for (const Entry& entry : readCatalogue(folder() + catalogue)) {
            const auto known = first.constFind(entry.source);
            if (known == first.constEnd())
                first.insert(entry.source, entry);
            else if (known->translation != entry.translation && !differing.contains(entry.source))
                wrong << QStringLiteral("\"%1\" is \"%2\" in %3 and \"%4\" in %5")
                             .arg(entry.source, known->translation, known->context, entry.translation, entry.context);
        }
        QVERIFY(first.size() > 500);
        QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join(QLatin1Char('\n'))));
    }

    // It takes more than four figures behind \u, and the text that it writes down is then never shown.
    void noEscapeIsReadOtherwiseByLupdate()
    {
        static const QRegularExpression misread(QStringLiteral("\\\\u[0-9A-Fa-f]{5}"));
        int looked = 0;
        QDirIterator files(QStringLiteral(LIENA_SOURCE_DIR "/console"), {QStringLiteral("*.cpp"), QStringLiteral("*.hpp")}, QDir::Files,
                           QDirIterator::Subdirectories);
        while (files.hasNext()) {
            QFile file(files.next());
            QVERIFY(file.open(QIODevice::ReadOnly));
            const auto match = misread.match(QString::fromUtf8(file.readAll()));
            QVERIFY2(!match.hasMatch(), qPrintable(QStringLiteral("%1: %2… is read with five figures; write the character itself")
                                                       .arg(file.fileName(), match.captured())));
            ++looked;
        }
        QVERIFY(looked > 100);
    }
};

QTEST_GUILESS_MAIN(TestCatalogue)
#include "test_catalogue.moc"
