// A picture to save, and a look into the DICOM file that it became.
#pragma once

#include "imaging/picture_export.hpp"
#include "sample_frames.hpp"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

namespace console::saved {

inline constexpr QSize size(301, 201); // odd: DICOM pads

inline DisplayPicture picture(PictureRole role = PictureRole::Review)
{
    DisplayPicture picture;
    picture.about = *samples::frame(17, size, 8, PixelEncoding::Raw);
    picture.about.acquisition = 3;
    picture.role = role;
    picture.window = {128, 256};
    picture.image = QImage(size, QImage::Format_RGB32);
    for (int y = 0; y < size.height(); ++y)
        for (int x = 0; x < size.width(); ++x)
            picture.image.setPixel(x, y, qRgb((x + y) % 256, (x + y) % 256, (x + y) % 256));
    return picture;
}

inline QString valueOf(DcmDataset& dataset, const DcmTagKey& tag)
{
    OFString value;
    dataset.findAndGetOFStringArray(tag, value);
    return QString::fromUtf8(value.c_str());
}

inline QByteArray pixelsOf(const QString& path)
{
    DcmFileFormat file;
    const Uint8* pixels = nullptr;
    unsigned long count = 0;
    if (file.loadFile(path.toLocal8Bit().constData()).bad() || file.getDataset()->findAndGetUint8Array(DCM_PixelData, pixels, &count).bad())
        return {};
    return {reinterpret_cast<const char*>(pixels), static_cast<qsizetype>(count)};
}

} // namespace console::saved
