#pragma once

#include <memory>
#include <string>

namespace assay::render {

// An OpenGL context without a window. The engine draws into its own framebuffer object, so the
// context needs no surface of any size.
//
// The engine (2.2.2) links against no OpenGL. When it makes its first drawing context, it searches
// the process's global symbols for eglGetProcAddress, then OSMesaGetProcAddress, then
// glXGetProcAddressARB. It gets all of OpenGL from the first one that exists. Therefore the library
// that made the context is opened with RTLD_GLOBAL and stays open. Neither of the other two
// libraries may be opened beside it, so that the first context decides for the whole process.
class OffscreenContext {
 public:
  // Returns a context of OSMesa if that library can be opened, else of EGL without a surface.
  // Throws EnvironmentError, which names the Debian package to install, if there is neither.
  static std::unique_ptr<OffscreenContext> Create();

  virtual ~OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  // Makes this the current context of the calling thread. Throws EnvironmentError.
  virtual void MakeCurrent() = 0;
  virtual std::string name() const = 0;  // "OSMesa" or "EGL"

 protected:
  OffscreenContext() = default;
};

}  // namespace assay::render
