// The one place where pictures, points and colours cross between Qt and VTK.
#pragma once

#include <QColor>
#include <QImage>
#include <QVector3D>

#include <array>

class vtkImageData;
class vtkUnsignedCharArray;

namespace console {

/// Fills `target` with the picture, VTK's way up (first row at the bottom), one component for grey and three for colour.
void copyToVtk(const QImage& picture, vtkImageData& target);

/// Bottom-up RGBA bytes, as a render window gives them, to Format_RGB32. Null when the sizes do not match.
QImage fromRenderedPixels(vtkUnsignedCharArray& rgba, QSize size);

std::array<double, 3> vtkColour(const QColor& colour);
std::array<double, 3> vtkPoint(const QVector3D& point);

} // namespace console
