#pragma once

#include <memory>
#include <span>
#include <string>

#include "planner/geometry/coordinates.h"
#include "sim/mujoco/data.h"
#include "sim/render/ghost.h"
#include "sim/render/image.h"

namespace assay::render {

// A camera that is not part of a model. It looks along its own -z axis, and its y axis points up in
// the picture.
struct FreeCamera {
  geometry::Pose X_WorldCamera = geometry::Pose::Identity();
  double vertical_angle = 0;  // vertical angle of the whole picture, radians; pixels are square
};

// Effects that cost time and only please the eye.
enum class Effects {
  kAll,   // shadows, reflections, sky
  kNone,  // only the shapes and their light
};

struct Quality {
  Effects effects = Effects::kAll;
  // Averaged samples along each side of a pixel. One sample is quick but gives jagged edges.
  int samples = 2;
};
inline constexpr int kMostSamples = 4;

// Renders pictures of a simulation off screen with the engine's own renderer. It uses OSMesa, or
// EGL without a surface if there is no OSMesa. These libraries are loaded when the first Renderer
// is made, so that nothing links against them. The same data give the same bytes on one machine. A
// renderer must be used by the thread that made it.
class Renderer {
 public:
  // Throws EnvironmentError, which names the Debian package to install, if nothing renders on this
  // machine. Width and height must be 1 to 4096 pixels, and samples 1 to kMostSamples (checked).
  Renderer(const mujoco::Model& model, int width, int height, const Quality& quality = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  Image Render(const mujoco::Data& data, mujoco::CameraId camera,
               std::span<const Ghost> ghosts = {});
  Image Render(const mujoco::Data& data, const FreeCamera& camera,
               std::span<const Ghost> ghosts = {});

 private:
  struct Contents;
  std::unique_ptr<Contents> contents_;
};

// Returns what renders on this machine: "OSMesa" or "EGL"; empty if nothing does.
std::string AvailableRenderer();

}  // namespace assay::render
