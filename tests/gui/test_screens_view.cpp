// The view of screens and layouts: how long it says what was said.
#include "widgets/screens_view.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QLabel>
#include <QTest>

#include <algorithm>

using namespace console;

class TestScreensView : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void whatWasSaidStaysWhenScreensMayChangeAgain()
    {
        ScreensView view;
        ScreensView::State state;
        state.fixed = QStringLiteral("as they are");
        view.showState(state);
        view.say(QStringLiteral("a screen is gone"));
        state.fixed.clear();
        view.showState(state);
        const auto shown = [&view](const QString& words) {
            const auto labels = view.findChildren<QLabel*>();
            return std::any_of(labels.begin(), labels.end(), [&words](const QLabel* label) { return label->text() == words; });
        };
        QVERIFY(shown(QStringLiteral("a screen is gone")));
        state.fixed = QStringLiteral("as they are");
        view.showState(state);
        QVERIFY(shown(state.fixed));
        state.fixed.clear();
        view.showState(state);
        QVERIFY(!shown(QStringLiteral("as they are")));
    }
};

QTEST_MAIN(TestScreensView)
#include "test_screens_view.moc"
