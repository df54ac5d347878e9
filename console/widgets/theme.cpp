// The dark palette, the typefaces in the program in fixed roles, and how both reach every widget.
#include "widgets/theme.hpp"

#include <QApplication>
#include <QDir>
#include <QFontDatabase>
#include <QPointer>
#include <QStyleFactory>
#include <QVariant>
#include <QWidget>

#include <algorithm>
#include <array>
#include <cmath>

namespace console::theme {

namespace {

constexpr const char* roleProperty = "textRole";
constexpr const char* scaleProperty = "cockpitScale";

struct Face {
    double reference; ///< px at the reference window
    int least;        ///< px below which it is not read from 0.8 m
    QFont::Weight weight;
};

constexpr std::array<Face, 7> faces{{
    {16, 11, QFont::Normal},
    {18, 12, QFont::Normal},
    {18, 12, QFont::DemiBold},
    {22, 14, QFont::DemiBold},
    {26, 15, QFont::Medium},
    {32, 18, QFont::DemiBold},
    {44, 23, QFont::Bold},
}};

/// Once for each application, with which Qt forgets them.
void loadFaces()
{
    static QPointer<QCoreApplication> loadedFor;
    if (loadedFor == QCoreApplication::instance())
        return;
    loadedFor = QCoreApplication::instance();
    const QDir folder(QStringLiteral(":/liena/fonts"));
    for (const QString& file : folder.entryList(QDir::Files))
        if (QFontDatabase::addApplicationFont(folder.filePath(file)) < 0)
            qWarning("the typeface %s in this program cannot be read; install LiENa anew", qUtf8Printable(file));
}

double luminance(const QColor& colour)
{
    const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

} // namespace

double scaleFor(const QSize& window)
{
    return std::min(double(window.width()) / referenceWidth, double(window.height()) / referenceHeight);
}

QFont font(TextRole role, double scale)
{
    loadFaces();
    const Face& face = faces.at(std::size_t(role));
    QFont f;
    f.setFamilies({QStringLiteral("LiENa Sans"), QStringLiteral("LiENa Hei")});
    f.setStyleHint(QFont::SansSerif); // the system's, for what neither has
    f.setPixelSize(std::max(face.least, int(std::lround(face.reference * scale))));
    f.setWeight(face.weight);
    return f;
}

double scaleOf(const QWidget* widget)
{
    const QVariant scale = widget->window()->property(scaleProperty);
    return scale.isValid() ? scale.toDouble() : 1.0;
}

void setTextRole(QWidget* widget, TextRole role)
{
    widget->setProperty(roleProperty, int(role));
    widget->setFont(font(role, scaleOf(widget)));
}

void applyScale(QWidget* root, double scale)
{
    root->window()->setProperty(scaleProperty, scale);
    const auto fit = [scale](QWidget* widget) {
        const QVariant role = widget->property(roleProperty);
        if (role.isValid())
            widget->setFont(font(TextRole(role.toInt()), scale));
        widget->updateGeometry();
    };
    fit(root);
    const auto children = root->findChildren<QWidget*>();
    for (QWidget* child : children)
        fit(child);
}

int px(const QWidget* widget, double length) { return length <= 0 ? 0 : std::max(1, int(std::lround(length * scaleOf(widget)))); }

int touchSide(const QWidget* widget)
{
    constexpr double side = 52; // at 2560 pixels on 597 mm
    return std::max(leastTouchSide, px(widget, side));
}

int safetySide(const QWidget* widget)
{
    constexpr double side = 86;
    return std::max(2 * leastTouchSide, px(widget, side));
}

int safetyGap(const QWidget* widget) { return px(widget, 22); }

void apply(QApplication& application)
{
    QApplication::setLayoutDirection(Qt::LeftToRight); // set, it is not asked of the language
    QApplication::setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
    QApplication::setFont(font(TextRole::Body, 0.75));
    setBrightness(application, brightness());
}

double contrast(const QColor& a, const QColor& b)
{
    const double x = luminance(a) + 0.05;
    const double y = luminance(b) + 0.05;
    return std::max(x, y) / std::min(x, y);
}

} // namespace console::theme
