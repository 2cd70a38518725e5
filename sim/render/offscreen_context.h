#pragma once

#include <memory>
#include <string>

namespace assay::render {

// An OpenGL context without a window. The engine draws into its own framebuffer object, so the
// context needs no surface of any size.
//
// The engine (2.2.2) links against no OpenGL. When its first drawing context is made, it looks in
// the process's global symbols for eglGetProcAddress, then OSMesaGetProcAddress, then
// glXGetProcAddressARB, and gets all of OpenGL from the first that is there. So the library that
// made the context is opened with RTLD_GLOBAL, stays open, and no other of the three may be opened
// beside it: the first context decides for the process.
class OffscreenContext {
 public:
  // OSMesa if it can be opened, else EGL without a surface. Throws EnvironmentError, naming the
  // Debian package to install, if there is neither.
  static std::unique_ptr<OffscreenContext> Create();

  virtual ~OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  // Makes it the context of this thread. Throws EnvironmentError.
  virtual void MakeCurrent() = 0;
  virtual std::string name() const = 0;  // "OSMesa", "EGL"

 protected:
  OffscreenContext() = default;
};

}  // namespace assay::render
