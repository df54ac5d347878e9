// Three levels of brightness of what surrounds the pictures.
#include "widgets/theme.hpp"

#include <QApplication>
#include <QFile>
#include <QPalette>
#include <QWidget>

#include <array>

namespace console::theme {

namespace {

constexpr std::array<Greys, brightnessCount> levels{{
    {{0x07, 0x09, 0x0B},
     {0x0C, 0x0F, 0x12},
     {0x12, 0x16, 0x1A},
     {0x22, 0x28, 0x2F},
     {0x46, 0x4E, 0x57},
     {0xCD, 0xD2, 0xD7},
     {0xA4, 0xAA, 0xB1},
     {0x86, 0x8E, 0x97},
     {0x7B, 0x83, 0x8C},
     {0x1A, 0x20, 0x26},
     {0x26, 0x2D, 0x35}},
    {{0x0E, 0x11, 0x14},
     {0x14, 0x18, 0x1D},
     {0x1C, 0x21, 0x28},
     {0x2C, 0x33, 0x3B},
     {0x55, 0x5E, 0x68},
     {0xF1, 0xF3, 0xF5},
     {0xC8, 0xCD, 0xD3},
     {0x92, 0x9A, 0xA3},
     {0x82, 0x8A, 0x93},
     {0x26, 0x2D, 0x36},
     {0x34, 0x3C, 0x46}},
    {{0x12, 0x16, 0x1A},
     {0x19, 0x1E, 0x23},
     {0x1F, 0x24, 0x2B},
     {0x3C, 0x45, 0x4F},
     {0x74, 0x7F, 0x8A},
     {0xFF, 0xFF, 0xFF},
     {0xE2, 0xE6, 0xEA},
     {0xB2, 0xBA, 0xC2},
     {0xA0, 0xA8, 0xB1},
     {0x2B, 0x32, 0x3B},
     {0x3B, 0x44, 0x4E}},
}};

constexpr std::array<QColor Greys::*, 11> tones{&Greys::background, &Greys::panel,  &Greys::raised, &Greys::line,
                                                &Greys::strongLine, &Greys::bright, &Greys::text,   &Greys::secondary,
                                                &Greys::stale,      &Greys::hover,  &Greys::pressed};

constinit Brightness inForce = Brightness::Usual;

QPalette paletteOf(const Greys& grey)
{
    QPalette p;
    p.setColor(QPalette::Window, grey.background);
    p.setColor(QPalette::WindowText, grey.text);
    p.setColor(QPalette::Base, grey.panel);
    p.setColor(QPalette::AlternateBase, grey.raised);
    p.setColor(QPalette::Text, grey.text);
    p.setColor(QPalette::PlaceholderText, grey.secondary);
    p.setColor(QPalette::Button, grey.raised);
    p.setColor(QPalette::ButtonText, grey.text);
    p.setColor(QPalette::BrightText, grey.bright);
    p.setColor(QPalette::ToolTipBase, grey.raised);
    p.setColor(QPalette::ToolTipText, grey.text);
    p.setColor(QPalette::Highlight, grey.strongLine);
    p.setColor(QPalette::HighlightedText, grey.bright);
    p.setColor(QPalette::Link, colour::armed);
    p.setColor(QPalette::Disabled, QPalette::ButtonText, grey.stale);
    p.setColor(QPalette::Disabled, QPalette::WindowText, grey.stale);
    p.setColor(QPalette::Disabled, QPalette::Text, grey.stale);
    return p;
}

QColor translated(const QColor& colour, const Greys& from, const Greys& to)
{
    for (const auto tone : tones)
        if (colour == from.*tone)
            return to.*tone;
    return colour;
}

/// A widget with an ink of its own keeps its meaning in the other greys.
void reInk(QWidget* widget, const Greys& from, const Greys& to)
{
    if (widget->testAttribute(Qt::WA_SetPalette)) {
        QPalette palette = widget->palette();
        for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::Window, QPalette::Base})
            for (const auto group : {QPalette::Active, QPalette::Inactive})
                if (palette.isBrushSet(group, role))
                    palette.setColor(group, role, translated(palette.color(group, role), from, to));
        widget->setPalette(palette);
    }
    widget->update();
}

} // namespace

namespace detail {
constinit Greys present = levels[std::size_t(Brightness::Usual)];
} // namespace detail

const Greys& greys(Brightness brightness) { return levels.at(std::size_t(brightness)); }

Brightness brightness() { return inForce; }

QString styleSheet(Brightness brightness)
{
    QFile file(QStringLiteral(":/liena/styles/cockpit.qss"));
    if (!file.open(QIODevice::ReadOnly))
        return {};
    const Greys& usual = greys(Brightness::Usual);
    QString sheet = QString::fromUtf8(file.readAll());
    // Marked first: a grey of one level may be another one of the next.
    for (std::size_t i = 0; i < tones.size(); ++i)
        sheet.replace((usual.*tones.at(i)).name(), QStringLiteral("@%1@").arg(i), Qt::CaseInsensitive);
    for (std::size_t i = 0; i < tones.size(); ++i)
        sheet.replace(QStringLiteral("@%1@").arg(i), (greys(brightness).*tones.at(i)).name(), Qt::CaseInsensitive);
    return sheet;
}

void setBrightness(QApplication& application, Brightness brightness)
{
    const Greys before = detail::present;
    inForce = brightness;
    detail::present = greys(brightness);
    QApplication::setPalette(paletteOf(detail::present));
    application.setStyleSheet(styleSheet(brightness));
    const auto widgets = QApplication::allWidgets();
    for (QWidget* widget : widgets)
        reInk(widget, before, detail::present);
    // A new style sheet gives widgets their first fonts back.
    const auto windows = QApplication::topLevelWidgets();
    for (QWidget* window : windows)
        applyScale(window, scaleOf(window));
}

} // namespace console::theme
