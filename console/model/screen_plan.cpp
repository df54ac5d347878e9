// Planning of screens.
#include "model/screen_plan.hpp"

#include <QCoreApplication>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::ScreenPlan)
};

} // namespace

QString word(Arrangement arrangement)
{
    switch (arrangement) {
    case Arrangement::Usual:
        return Text::tr("live large");
    case Arrangement::ReferenceBeside:
        return Text::tr("reference beside it");
    case Arrangement::SceneBeside:
        return Text::tr("scene beside it");
    }
    return QStringLiteral("?");
}

Arrangement swapped(Arrangement present, Arrangement wanted) { return present == wanted ? Arrangement::Usual : wanted; }

ScreenPlan planFor(const ScreenLayout& layout, const QList<QString>& screens)
{
    ScreenPlan plan;
    const auto there = [&screens](const QString& name) { return !name.isEmpty() && screens.contains(name); };
    plan.cockpit = there(layout.cockpit) ? layout.cockpit : screens.value(0);
    if (there(layout.second) && layout.second != plan.cockpit)
        plan.second = layout.second;
    if (there(layout.third) && layout.third != plan.cockpit && layout.third != plan.second)
        plan.third = layout.third;
    const bool moved = !layout.cockpit.isEmpty() && plan.cockpit != layout.cockpit;
    plan.folded = moved || plan.second != layout.second || plan.third != layout.third;
    return plan;
}

} // namespace console
