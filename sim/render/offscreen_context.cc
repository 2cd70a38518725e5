#include "sim/render/offscreen_context.h"

#include <dlfcn.h>

#include <array>

#include "planner/base/input_files/input_error.h"

namespace assay::render {
namespace {

// A library whose functions are looked up by name. It is never closed, see OffscreenContext.
class Library {
 public:
  explicit Library(const char* file) : handle_(dlopen(file, RTLD_NOW | RTLD_GLOBAL)) {}

  bool is_open() const { return handle_ != nullptr; }

  template <class Function>
  Function* Find(const char* name) const {
    void* const symbol = dlsym(handle_, name);
    if (symbol == nullptr) throw EnvironmentError(std::string("no function ") + name);
    return reinterpret_cast<Function*>(symbol);
  }

 private:
  void* handle_;
};

[[noreturn]] void FailToCreate(const char* what) {
  throw EnvironmentError(std::string(what) + " gives no off-screen OpenGL context");
}

// Constants from the OpenGL and EGL registries.
constexpr unsigned kGlRgba = 0x1908;
constexpr unsigned kGlUnsignedByte = 0x1401;
constexpr unsigned kEglPlatformSurfacelessMesa = 0x31DD;
constexpr unsigned kEglOpenGlApi = 0x30A2;
constexpr int kEglRenderableType = 0x3040;
constexpr int kEglOpenGlBit = 0x0008;
constexpr int kEglNone = 0x3038;

class OsMesaContext : public OffscreenContext {
 public:
  explicit OsMesaContext(const Library& library)
      : destroy_(library.Find<void(void*)>("OSMesaDestroyContext")),
        make_current_(
            library.Find<unsigned char(void*, void*, unsigned, int, int)>("OSMesaMakeCurrent")) {
    constexpr int kDepthBits = 24;
    constexpr int kStencilBits = 8;
    auto* const create =
        library.Find<void*(unsigned, int, int, int, void*)>("OSMesaCreateContextExt");
    context_ = create(kGlRgba, kDepthBits, kStencilBits, 0, nullptr);
    if (context_ == nullptr) FailToCreate("OSMesa");
  }
  ~OsMesaContext() override { destroy_(context_); }

  void MakeCurrent() override {
    if (!make_current_(context_, surface_.data(), kGlUnsignedByte, kSide, kSide)) {
      FailToCreate("OSMesa");
    }
  }
  std::string name() const override { return "OSMesa"; }

 private:
  static constexpr int kSide = 16;  // OSMesa needs a surface, although nothing is drawn on it

  void (*destroy_)(void*);
  unsigned char (*make_current_)(void*, void*, unsigned, int, int);
  void* context_ = nullptr;
  std::array<unsigned char, 4 * kSide * kSide> surface_{};
};

class EglContext : public OffscreenContext {
 public:
  explicit EglContext(const Library& library)
      : destroy_(library.Find<unsigned(void*, void*)>("eglDestroyContext")),
        make_current_(library.Find<unsigned(void*, void*, void*, void*)>("eglMakeCurrent")) {
    OpenDisplay(library);
    CreateContext(library);
  }
  ~EglContext() override {
    make_current_(display_, nullptr, nullptr, nullptr);
    destroy_(display_, context_);
  }

  void MakeCurrent() override {
    if (!make_current_(display_, nullptr, nullptr, context_)) FailToCreate("EGL");
  }
  std::string name() const override { return "EGL"; }

 private:
  void OpenDisplay(const Library& library) {
    auto* const get_display =
        library.Find<void*(unsigned, void*, const void*)>("eglGetPlatformDisplay");
    auto* const initialize = library.Find<unsigned(void*, int*, int*)>("eglInitialize");
    display_ = get_display(kEglPlatformSurfacelessMesa, nullptr, nullptr);
    if (display_ == nullptr || !initialize(display_, nullptr, nullptr)) FailToCreate("EGL");
  }

  void CreateContext(const Library& library) {
    auto* const bind_api = library.Find<unsigned(unsigned)>("eglBindAPI");
    auto* const choose =
        library.Find<unsigned(void*, const int*, void**, int, int*)>("eglChooseConfig");
    auto* const create = library.Find<void*(void*, void*, void*, const int*)>("eglCreateContext");
    const std::array<int, 3> wanted = {kEglRenderableType, kEglOpenGlBit, kEglNone};
    void* config = nullptr;
    int count = 0;
    if (!bind_api(kEglOpenGlApi) || !choose(display_, wanted.data(), &config, 1, &count)) {
      FailToCreate("EGL");
    }
    // If no configuration matches, the context has none (EGL_KHR_no_config_context, which Mesa
    // has).
    context_ = create(display_, count > 0 ? config : nullptr, nullptr, nullptr);
    if (context_ == nullptr) FailToCreate("EGL");
  }

  unsigned (*destroy_)(void*, void*);
  unsigned (*make_current_)(void*, void*, void*, void*);
  void* display_ = nullptr;
  void* context_ = nullptr;
};

bool EglIsLoaded() { return dlsym(RTLD_DEFAULT, "eglGetProcAddress") != nullptr; }

}  // namespace

std::unique_ptr<OffscreenContext> OffscreenContext::Create() {
  if (!EglIsLoaded()) {
    const Library osmesa("libOSMesa.so.8");
    if (osmesa.is_open()) return std::make_unique<OsMesaContext>(osmesa);
  }
  const Library egl("libEGL.so.1");
  if (egl.is_open()) return std::make_unique<EglContext>(egl);
  throw EnvironmentError("no off-screen renderer: apt-get install libosmesa6");
}

}  // namespace assay::render
