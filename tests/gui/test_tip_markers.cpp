// The marks of a tip before and after an interruption: where they stand on the scene.
#include "imaging/c_arm_pose.hpp"
#include "imaging/scene_view.hpp"
#include "shown_texts.hpp"

#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include <cmath>

using namespace console;
using namespace console::test;

namespace {

constexpr QSize pane(562, 562);
constexpr double atTheTip = 40; ///< pixels: a mark that is farther away belongs to nothing

TipPose tipAt(double right, double up)
{
    TipPose pose;
    pose.valid = true;
    pose.position = {right, 0, up};
    pose.quaternion = {1, 0, 0, 0};
    return pose;
}

struct Scene {
    QTemporaryDir folder;
    SceneView view;

    bool shows()
    {
        QFile file(folder.filePath(QStringLiteral("tree.swc"))); // its middle is the frame's
        if (!file.open(QIODevice::WriteOnly))
            return false;
        file.write("1 2 0 0 -80 4 -1\n2 2 0 0 0 4 1\n3 2 0 0 80 3 2\n");
        file.close();
        view.resize(pane);
        view.loadVessels(file.fileName());
        view.show();
        return QTest::qWaitFor([this] { return view.drawings() > 0; });
    }

    QPointF placeOf(const TipPose& pose) const
    {
        const auto& p = pose.position;
        return view.camera().project(toScene({float(p[0]), float(p[1]), float(p[2])}), pane).value();
    }

    /// Nothing when it is not painted.
    std::optional<QRectF> mark(const QString& text)
    {
        for (const auto& shown : textsPaintedBy(view))
            if (shown.text == text)
                return shown.ink;
        return std::nullopt;
    }
    std::optional<QRectF> before() { return mark(QStringLiteral("BEFORE")); }
    std::optional<QRectF> now() { return mark(QStringLiteral("NOW")); }

    /// Both are painted on the newest drawing.
    bool marks()
    {
        return QTest::qWaitFor([this] { return before() && now(); });
    }
};

/// From the nearest point of `rect`.
double distance(const QRectF& rect, QPointF place)
{
    const double x = std::max({rect.left() - place.x(), 0.0, place.x() - rect.right()});
    const double y = std::max({rect.top() - place.y(), 0.0, place.y() - rect.bottom()});
    return std::hypot(x, y);
}

} // namespace

class TestTipMarkers : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void theyStandWhereTheTipWasAndWhereItIs_data()
    {
        QTest::addColumn<double>("rightBefore");
        QTest::addColumn<double>("upBefore");
        QTest::addColumn<double>("rightNow");
        QTest::addColumn<double>("upNow");
        QTest::newRow("below and above") << 0.0 << -60.0 << 0.0 << 60.0;
        QTest::newRow("above and below") << 0.0 << 60.0 << 0.0 << -60.0;
        QTest::newRow("left and right") << -50.0 << 0.0 << 50.0 << 10.0;
        QTest::newRow("near to one another") << 10.0 << 20.0 << 14.0 << 24.0;
    }

    void theyStandWhereTheTipWasAndWhereItIs()
    {
        QFETCH(double, rightBefore);
        QFETCH(double, upBefore);
        QFETCH(double, rightNow);
        QFETCH(double, upNow);
        const TipPose was = tipAt(rightBefore, upBefore);
        const TipPose is = tipAt(rightNow, upNow);
        Scene scene;
        QVERIFY(scene.shows());
        scene.view.showTip(is, false);
        scene.view.showTipBefore(was);
        QVERIFY(scene.marks());
        QVERIFY(scene.view.rect().contains(scene.placeOf(was).toPoint()) && scene.view.rect().contains(scene.placeOf(is).toPoint()));
        QVERIFY2(distance(*scene.before(), scene.placeOf(was)) < atTheTip, qPrintable(QString::number(scene.before()->x())));
        QVERIFY2(distance(*scene.now(), scene.placeOf(is)) < atTheTip, qPrintable(QString::number(scene.now()->x())));
        QVERIFY(!scene.before()->intersects(*scene.now()));
    }

    /// The tip moves on; where it was stays.
    void onlyTheTipOfNowMovesOn()
    {
        Scene scene;
        QVERIFY(scene.shows());
        scene.view.showTip(tipAt(0, 0), false);
        scene.view.showTipBefore(tipAt(0, -50));
        QVERIFY(scene.marks());
        const auto before = *scene.before();
        const auto now = *scene.now();
        scene.view.showTip(tipAt(0, 50), false);
        QTRY_VERIFY(*scene.now() != now);
        QCOMPARE(*scene.before(), before);
        QVERIFY(distance(*scene.now(), scene.placeOf(tipAt(0, 50))) < atTheTip);
    }

    /// Both turn with the scene.
    void theyFollowTheCamera()
    {
        Scene scene;
        QVERIFY(scene.shows());
        scene.view.showTip(tipAt(50, 30), false);
        scene.view.showTipBefore(tipAt(-50, -30));
        QVERIFY(scene.marks());
        const auto drawings = scene.view.drawings();
        for (int i = 0; i < 10; ++i)
            QTest::keyClick(&scene.view, Qt::Key_4);
        QTRY_VERIFY(scene.view.drawings() > drawings);
        QTRY_VERIFY(distance(*scene.before(), scene.placeOf(tipAt(-50, -30))) < atTheTip &&
                    distance(*scene.now(), scene.placeOf(tipAt(50, 30))) < atTheTip);
    }

    void nothingIsMarkedThatIsNotKnown()
    {
        Scene scene;
        QVERIFY(scene.shows());
        scene.view.showTip(tipAt(0, 0), false);
        QVERIFY(!scene.before() && !scene.now()); // nothing was interrupted
        scene.view.showTipBefore(tipAt(0, 50));
        QVERIFY(scene.marks());
        scene.view.showTip(std::nullopt, false); // it was, and is not tracked now
        QVERIFY(scene.before() && !scene.now());
        scene.view.showTip(tipAt(0, 0), false);
        auto lost = tipAt(0, 50);
        lost.valid = false;
        scene.view.showTipBefore(lost); // and was not then
        QVERIFY(!scene.before() && !scene.now());
    }
};

QTEST_MAIN(TestTipMarkers)
#include "test_tip_markers.moc"
