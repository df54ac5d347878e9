// An OpenGL context without a window and without a display server, by EGL.
#include "imaging/egl_context.hpp"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <QCoreApplication>

#include <array>
#include <cstring>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::EglContext)
};

EGLDisplay surfacelessDisplay()
{
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!extensions || !std::strstr(extensions, "EGL_MESA_platform_surfaceless"))
        return EGL_NO_DISPLAY;
    const auto platformDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    return platformDisplay ? platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr) : EGL_NO_DISPLAY;
}

EGLContext contextOn(EGLDisplay display)
{
    EGLint major = 0;
    EGLint minor = 0;
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor) || !eglBindAPI(EGL_OPENGL_API))
        return EGL_NO_CONTEXT;
    const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (!eglChooseConfig(display, wanted.data(), &config, 1, &found) || found < 1)
        return EGL_NO_CONTEXT;
    const std::array<EGLint, 7> profile{
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, profile.data());
    if (context == EGL_NO_CONTEXT)
        return EGL_NO_CONTEXT;
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        eglDestroyContext(display, context);
        return EGL_NO_CONTEXT;
    }
    return context;
}

} // namespace

std::unique_ptr<EglContext> EglContext::create(QString& error)
{
    for (const EGLDisplay display : {surfacelessDisplay(), eglGetDisplay(EGL_DEFAULT_DISPLAY)}) {
        if (const EGLContext context = contextOn(display); context != EGL_NO_CONTEXT)
            return std::unique_ptr<EglContext>(new EglContext(display, context));
    }
    error = Text::tr("EGL offers no OpenGL 3.2 here (EGL error 0x%1). Install a graphics driver; Mesa's software driver is enough.")
                .arg(eglGetError(), 4, 16, QLatin1Char('0'));
    return nullptr;
}

// The display is left initialised: it belongs to the process, and other contexts may live on it.
EglContext::~EglContext()
{
    eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(m_display, m_context);
    eglReleaseThread();
}

bool EglContext::isCurrent() const { return eglGetCurrentContext() == m_context; }

} // namespace console
