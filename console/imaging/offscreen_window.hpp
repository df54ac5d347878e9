// A VTK render window that draws with whatever OpenGL context is current.
#pragma once

#include <vtkGenericOpenGLRenderWindow.h>

namespace console {

/// VTK's generic window gives up when GLEW finds no X display although OpenGL is loaded; this one goes on.
class OffscreenWindow : public vtkGenericOpenGLRenderWindow {
public:
    static OffscreenWindow* New();
    vtkTypeMacro(OffscreenWindow, vtkGenericOpenGLRenderWindow)

        void OpenGLInitContext() override;

    /// After the context is current, and before the first Render().
    void prepare();

    bool isUsable() const { return Initialized; }

    OffscreenWindow(const OffscreenWindow&) = delete;
    OffscreenWindow& operator=(const OffscreenWindow&) = delete;

protected:
    OffscreenWindow() = default;
    ~OffscreenWindow() override = default;
};

} // namespace console
