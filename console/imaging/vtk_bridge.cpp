// The one place where pictures, points and colours cross between Qt and VTK.
#include "imaging/vtk_bridge.hpp"

#include <vtkImageData.h>
#include <vtkUnsignedCharArray.h>

#include <cstring>

namespace console {

namespace {

void copyRows(const uchar* first, std::size_t stride, std::size_t rowBytes, int rows, void* target)
{
    auto* to = static_cast<uchar*>(target);
    for (int row = rows - 1; row >= 0; --row, to += rowBytes)
        std::memcpy(to, first + static_cast<std::size_t>(row) * stride, rowBytes);
}

} // namespace

void copyToVtk(const QImage& picture, vtkImageData& target)
{
    const bool grey = picture.isGrayscale();
    const QImage plain = picture.convertToFormat(grey ? QImage::Format_Grayscale8 : QImage::Format_RGB888);
    const int components = grey ? 1 : 3;
    target.SetDimensions(plain.width(), plain.height(), 1);
    target.AllocateScalars(VTK_UNSIGNED_CHAR, components);
    copyRows(plain.constBits(), static_cast<std::size_t>(plain.bytesPerLine()), static_cast<std::size_t>(plain.width() * components),
             plain.height(), target.GetScalarPointer());
    target.Modified();
}

QImage fromRenderedPixels(vtkUnsignedCharArray& rgba, QSize size)
{
    if (size.isEmpty() || rgba.GetNumberOfComponents() != 4 ||
        rgba.GetNumberOfTuples() != static_cast<vtkIdType>(size.width()) * size.height())
        return {};
    // The alpha that VTK leaves behind is no coverage; RGBX ignores it.
    const QImage bottomUp(rgba.GetPointer(0), size.width(), size.height(), 4 * size.width(), QImage::Format_RGBX8888);
    return bottomUp.mirrored().convertToFormat(QImage::Format_RGB32);
}

std::array<double, 3> vtkColour(const QColor& colour) { return {colour.redF(), colour.greenF(), colour.blueF()}; }

std::array<double, 3> vtkPoint(const QVector3D& point) { return {point.x(), point.y(), point.z()}; }

} // namespace console
