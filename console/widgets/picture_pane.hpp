// A picture with its row of controls beneath.
#pragma once

#include <QWidget>

namespace console {

/// Takes both. Nothing of the controls ever lies over the picture.
class PicturePane : public QWidget {
    Q_OBJECT
public:
    PicturePane(QWidget* picture, QWidget* controls, QWidget* parent = nullptr);
};

} // namespace console
