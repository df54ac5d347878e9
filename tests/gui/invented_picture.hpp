// Pictures that nobody takes for a patient's.
#pragma once

#include "imaging/display_picture.hpp"

#include <QPainter>
#include <QWidget>

namespace console::test {

/// A grey field with a word, so that nobody takes the gallery for a patient.
class Stand : public QWidget {
public:
    explicit Stand(const QString& text) : m_text(text) { setAccessibleName(text); }

protected:
    void paintEvent(QPaintEvent*) override
    {
        QPainter painter(this);
        QLinearGradient shade(0, 0, width(), height());
        shade.setColorAt(0, QColor(58, 58, 58));
        shade.setColorAt(1, QColor(120, 120, 120));
        painter.fillRect(rect(), shade);
        painter.setPen(Qt::white);
        painter.drawText(rect(), Qt::AlignCenter, m_text);
    }

private:
    QString m_text;
};

/// The invented picture as the newest that the models know: nobody takes it for a patient, and no book counts it twice.
inline DisplayPicture inventedPicture(const PictureStamp& newest, PictureRole role)
{
    DisplayPicture picture;
    picture.role = role;
    picture.about.frame = newest.frame;
    picture.about.acquisition = newest.acquisition;
    picture.about.captureNs = newest.captureNs;
    picture.about.source = newest.source;
    picture.about.rows = picture.about.columns = 1024;
    picture.about.imagerPixelSpacing = 0.3;
    picture.about.geometry.sourceDetectorDistance = 1100;
    picture.about.geometry.sourceObjectDistance = 750;
    picture.window = {2048, 4096};
    picture.image = QImage(1024, 1024, QImage::Format_RGB32);
    Stand stand(QStringLiteral("INVENTED"));
    stand.resize(picture.image.size());
    stand.render(&picture.image);
    return picture;
}

} // namespace console::test
