// An OpenGL context without a window and without a display server, by EGL.
#pragma once

#include <QString>

#include <memory>

namespace console {

/// Current on the thread that made it; make, use and destroy it on one thread.
class EglContext {
public:
    /// Null, and a reason, when this machine offers no OpenGL 3.2 through EGL.
    static std::unique_ptr<EglContext> create(QString& error);

    ~EglContext();
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    bool isCurrent() const;

private:
    EglContext(void* display, void* context) : m_display(display), m_context(context) {}

    void* m_display;
    void* m_context;
};

} // namespace console
