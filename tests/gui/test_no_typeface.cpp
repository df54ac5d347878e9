// A language that no typeface can show is not spoken. The system has none here, and nobody has loaded the console's own.
#include "app/language.hpp"
#include "model/link_state.hpp"

#include <QFontDatabase>
#include <QTest>

using namespace console;

class TestNoTypeface : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void whatCannotBeDrawnIsNotSpoken()
    {
        QVERIFY(QFontDatabase::families(QFontDatabase::SimplifiedChinese).isEmpty());
        QVERIFY(languages().contains(QStringLiteral("zh_CN")));
        const QString english = word(LinkState::StandBy);
        const QString trouble = speak(QStringLiteral("zh_CN"));
        QVERIFY2(trouble.startsWith(QStringLiteral("no typeface has the characters of zh_CN")), qPrintable(trouble));
        QCOMPARE(word(LinkState::StandBy), english);
    }

    void englishIsSpokenAllTheSame() { QCOMPARE(speak(QStringLiteral("en")), QString()); }
};

QTEST_MAIN(TestNoTypeface)
#include "test_no_typeface.moc"
