// The texts that a widget paints, each with its place: for tests of what is clipped, cut short or painted over.
#pragma once

#include <QRectF>
#include <QString>
#include <QStringList>

#include <vector>

class QWidget;

namespace console::test {

struct ShownText {
    QString text;
    QRectF ink;  ///< in the widget's coordinates; as tall as capitals are
    QRectF room; ///< what the painter let through
};

/// What `widget` itself paints, without its children.
std::vector<ShownText> textsPaintedBy(QWidget& widget);
QString wordsPaintedBy(QWidget& widget); ///< one after the other

/// What is wrong with the texts of `window` and all that is visible in it, a line each: clipped, painted over, or cut short where the whole
/// is not at hand.
QStringList unreadableTexts(QWidget& window);

} // namespace console::test
