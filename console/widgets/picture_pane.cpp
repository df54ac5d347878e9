// A picture with its row of controls beneath.
#include "widgets/picture_pane.hpp"

#include <QVBoxLayout>

namespace console {

PicturePane::PicturePane(QWidget* picture, QWidget* controls, QWidget* parent) : QWidget(parent)
{
    setAccessibleName(picture->accessibleName());
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(picture, 1);
    column->addWidget(controls, 0);
}

} // namespace console
