// A VTK render window that draws with whatever OpenGL context is current.
#include "imaging/offscreen_window.hpp"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

// Declared here because GL/glew.h must not meet another OpenGL header.
extern "C" unsigned int glewInit();

namespace console {

vtkStandardNewMacro(OffscreenWindow);

namespace {

constexpr unsigned glewOk = 0;
constexpr unsigned glewNoGlxDisplay = 4; // The entry points are loaded all the same.

void confirmCurrent(vtkObject*, unsigned long, void*, void* isCurrent) { *static_cast<bool*>(isCurrent) = true; }

} // namespace

void OffscreenWindow::OpenGLInitContext()
{
    ContextCreationTime.Modified();
    if (Initialized)
        return;
    const unsigned outcome = glewInit();
    if (outcome != glewOk && outcome != glewNoGlxDisplay)
        return;
    GlewInitValid = true;
    Initialized = true;
    MaximumHardwareLineWidth = 1;
}

void OffscreenWindow::prepare()
{
    vtkNew<vtkCallbackCommand> current;
    current->SetCallback(confirmCurrent);
    AddObserver(vtkCommand::WindowIsCurrentEvent, current);
    SetOwnContext(0);
    SetFrameBlitModeToNoBlit();
    SetForceMaximumHardwareLineWidth(1);
    SetMultiSamples(0);
    SetMapped(1);
    OpenGLInitContext();
}

} // namespace console
