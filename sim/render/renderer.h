#pragma once

#include <memory>
#include <span>
#include <string>

#include "planner/geometry/pose.h"
#include "sim/mujoco/data.h"
#include "sim/render/ghost.h"
#include "sim/render/image.h"

namespace assay::render {

// A camera that stands in no model. It looks along its own -z, its y is up in the picture.
struct FreeCamera {
  geometry::Pose X_WorldCamera = geometry::Pose::Identity();
  double vertical_angle = 0;  // of the whole picture, radians; pixels are square
};

// What costs time and only pleases the eye.
enum class Effects {
  kAll,   // shadows, reflections, sky
  kNone,  // the shapes and their light alone
};

struct Quality {
  Effects effects = Effects::kAll;
  int samples = 2;  // along each side of a pixel, averaged: 1 is quick, with jagged edges
};
inline constexpr int kMostSamples = 4;

// Pictures of a simulation by the engine's own renderer, off screen: with OSMesa, or with EGL
// without a surface where there is no OSMesa. Both are loaded when the first Renderer is made, so
// that nothing links against them. The same data give the same bytes on one machine. A renderer
// belongs to the thread that made it.
class Renderer {
 public:
  // Throws EnvironmentError, naming the Debian package to install, if there is no renderer.
  // Sizes are 1 to 4096 pixels, samples 1 to kMostSamples (checked).
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

// What renders on this machine: "OSMesa", "EGL"; empty if nothing does.
std::string AvailableRenderer();

}  // namespace assay::render
