// Bounds and words of the display settings.
#include "model/display_settings.hpp"

#include <QCoreApplication>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::DisplaySettings)
};

constexpr double narrowest = 2;
constexpr double widest = 131072;
constexpr double farthestCentre = 131072;

} // namespace

QString word(VoiFunction function)
{
    switch (function) {
    case VoiFunction::Linear:
        return QStringLiteral("LINEAR");
    case VoiFunction::LinearExact:
        return QStringLiteral("LINEAR_EXACT");
    case VoiFunction::Sigmoid:
        return QStringLiteral("SIGMOID");
    }
    return QStringLiteral("?");
}

QString word(WindowChoice choice)
{
    switch (choice) {
    case WindowChoice::AsSent:
        return Text::tr("as sent");
    case WindowChoice::Automatic:
        return Text::tr("AUTO");
    case WindowChoice::FullRange:
        return Text::tr("full range");
    case WindowChoice::Narrow:
        return Text::tr("half width");
    case WindowChoice::Wide:
        return Text::tr("twice the width");
    case WindowChoice::Fixed:
        return Text::tr("by hand");
    }
    return QStringLiteral("?");
}

QString word(EdgeMethod method)
{
    switch (method) {
    case EdgeMethod::UnsharpMask:
        return Text::tr("unsharp mask");
    case EdgeMethod::MultiScale:
        return Text::tr("multi-scale");
    }
    return QStringLiteral("?");
}

QString word(ShutterShape shape)
{
    switch (shape) {
    case ShutterShape::None:
        return Text::tr("no shutter");
    case ShutterShape::Circle:
        return Text::tr("round shutter");
    case ShutterShape::Rectangle:
        return Text::tr("square shutter");
    }
    return QStringLiteral("?");
}

DisplaySettings withinBounds(DisplaySettings settings)
{
    settings.noiseReduction = std::clamp(settings.noiseReduction, 0, 100);
    settings.edge = std::clamp(settings.edge, 0, 100);
    if (settings.window == WindowChoice::Fixed && !settings.fixed.isKnown())
        settings.window = WindowChoice::AsSent;
    return settings;
}

GreyWindow carriedOver(GreyWindow window, const WindowBasis& from, const WindowBasis& to)
{
    if (from.bits <= 0 || to.bits <= 0 || from.bits == to.bits)
        return window;
    const auto whole = [](const WindowBasis& basis) {
        const double range = std::ldexp(1.0, basis.bits);
        return basis.sent.isKnown() ? basis.sent : GreyWindow{range / 2, range};
    };
    const GreyWindow was = whole(from);
    const GreyWindow is = whole(to);
    const double scale = is.width / was.width;
    return {is.centre + (window.centre - was.centre) * scale, std::max(window.width * scale, narrowest)};
}

GreyWindow moved(GreyWindow window, double centreShare, double widthShare)
{
    if (!window.isKnown() || !std::isfinite(centreShare) || !std::isfinite(widthShare))
        return window;
    const double width = std::clamp(window.width * (1 + widthShare), narrowest, widest);
    return {std::clamp(window.centre + window.width * centreShare, -farthestCentre, farthestCentre), width};
}

} // namespace console
