#include "sim/render/renderer.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "planner/base/check.h"
#include "planner/base/input_files/input_error.h"
#include "sim/mujoco/engine_messages.h"
#include "sim/render/offscreen_context.h"
#include "sim/render/picture.h"

namespace assay::render {
namespace {

constexpr int kLargestSide = 4096;
constexpr int kMostShapes = 4000;
constexpr int kFontScale = 100;
// Ghosts are slightly transparent, because the engine draws transparent shapes only once. To other
// shapes it adds the light of each lamp that casts shadows, which would change the lines' colours.
constexpr float kGhostOpacity = 0.9F;

using ModelCopy = std::unique_ptr<mjModel, void (*)(mjModel*)>;

// Returns a copy of the model with this picture size, because the engine takes the size of its
// framebuffers from the model.
ModelCopy WithFramebuffers(const mjModel* model, int width, int height, Effects effects) {
  ModelCopy copy(mj_copyModel(nullptr, model), mj_deleteModel);
  copy->vis.global.offwidth = width;
  copy->vis.global.offheight = height;
  if (effects == Effects::kNone) copy->vis.quality.shadowsize = 0;
  return copy;
}

// Converts a camera to the engine's form, as the engine does for a camera of the model.
mjvGLCamera ToEngine(const FreeCamera& camera, const mjModel& model) {
  const geometry::Matrix3 R = camera.X_WorldCamera.linear();
  mjvGLCamera view{};
  for (int i = 0; i < 3; ++i) {
    view.pos[i] = static_cast<float>(camera.X_WorldCamera.translation()[i]);
    view.forward[i] = static_cast<float>(-R(i, 2));
    view.up[i] = static_cast<float>(R(i, 1));
  }
  view.frustum_near = static_cast<float>(model.vis.map.znear * model.stat.extent);
  view.frustum_far = static_cast<float>(model.vis.map.zfar * model.stat.extent);
  view.frustum_top = static_cast<float>(view.frustum_near * std::tan(camera.vertical_angle / 2));
  view.frustum_bottom = -view.frustum_top;
  return view;
}

// Returns an edge as a line. `width` is in pixels of the drawing.
mjvGeom LineOf(const Edge& edge, Colour colour, double width) {
  float rgba[4] = {0, 0, 0, kGhostOpacity};
  for (int i = 0; i < 3; ++i) {
    rgba[i] = static_cast<float>(colour.Rgb()[i]) / 255;
  }
  mjvGeom line;
  mjv_initGeom(&line, mjGEOM_LINE, nullptr, nullptr, nullptr, rgba);
  mjv_makeConnector(&line, mjGEOM_LINE, width, edge.from.x(), edge.from.y(), edge.from.z(),
                    edge.to.x(), edge.to.y(), edge.to.z());
  line.category = mjCAT_DECOR;
  line.transparent = 1;
  return line;
}

}  // namespace

// The order of the members matters: the drawing data are freed before the context that they need.
struct Renderer::Contents {
  Contents(const mujoco::Model& model, int picture_width, int picture_height,
           const Quality& quality)
      : width(picture_width * quality.samples),
        height(picture_height * quality.samples),
        samples(quality.samples),
        context(OffscreenContext::Create()),
        engine_model(WithFramebuffers(model.get(), width, height, quality.effects)) {
    mjv_defaultScene(&shapes);
    mjr_defaultContext(&drawing);
    context->MakeCurrent();
    mjv_makeScene(engine_model.get(), &shapes, kMostShapes);
    if (quality.effects == Effects::kNone) {
      for (const mjtRndFlag effect : {mjRND_SHADOW, mjRND_REFLECTION, mjRND_SKYBOX}) {
        shapes.flags[effect] = 0;
      }
    }
    mjr_makeContext(engine_model.get(), &drawing, kFontScale);
    mjr_setBuffer(mjFB_OFFSCREEN, &drawing);
    if (drawing.currentBuffer != mjFB_OFFSCREEN) {
      throw EnvironmentError(context->name() + " cannot draw off screen");
    }
  }
  ~Contents() {
    context->MakeCurrent();
    mjr_freeContext(&drawing);
    mjv_freeScene(&shapes);
  }
  // Fills the scene with the shapes of the simulation, seen by the camera `view`.
  void Update(const mujoco::Data& data, mjvCamera view) {
    mjvOption options;
    mjv_defaultOption(&options);
    context->MakeCurrent();
    // The engine only reads the data here, although its signature is not const.
    mjv_updateScene(engine_model.get(), const_cast<mjData*>(data.get()), &options, nullptr, &view,
                    mjCAT_ALL, &shapes);
  }

  // Adds as many of the ghost's edges as the engine has room for.
  void Add(const Ghost& ghost) {
    const float* const position = shapes.camera[0].pos;
    const Vector3 eye(position[0], position[1], position[2]);
    const double line_width = std::max<double>(samples, height / 480.0);
    for (const Edge& edge : ghost.edges) {
      if (shapes.ngeom == shapes.maxgeom) return;
      if (!edge.FacesTowards(eye)) continue;
      shapes.geoms[shapes.ngeom++] = LineOf(edge, ghost.colour, line_width);
    }
  }

  Image Draw() {
    Image drawn{width, height, {}};
    drawn.rgb.resize(std::size_t{3} * width * height);
    const mjrRect viewport{0, 0, width, height};
    mjr_render(viewport, &shapes, &drawing);
    mjr_readPixels(drawn.rgb.data(), nullptr, viewport, &drawing);
    return FromSamples(drawn, samples);
  }

  Contents(const Contents&) = delete;
  Contents& operator=(const Contents&) = delete;

  int width;  // pixels of the drawing, all samples included
  int height;
  int samples;
  std::unique_ptr<OffscreenContext> context;
  ModelCopy engine_model;
  mjvScene shapes{};
  mjrContext drawing{};
};

Renderer::Renderer(const mujoco::Model& model, int width, int height, const Quality& quality) {
  ASSAY_CHECK(std::min(width, height) >= 1 && std::max(width, height) <= kLargestSide,
              "a picture of {} by {} pixels", width, height);
  ASSAY_CHECK(quality.samples >= 1 && quality.samples <= kMostSamples, "{} samples",
              quality.samples);
  mujoco::HandleEngineMessages();
  contents_ = std::make_unique<Contents>(model, width, height, quality);
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Image Renderer::Render(const mujoco::Data& data, mujoco::CameraId camera,
                       std::span<const Ghost> ghosts) {
  mjvCamera view;
  mjv_defaultCamera(&view);
  view.type = mjCAMERA_FIXED;
  view.fixedcamid = camera.index();
  contents_->Update(data, view);
  for (const Ghost& ghost : ghosts) contents_->Add(ghost);
  return contents_->Draw();
}

Image Renderer::Render(const mujoco::Data& data, const FreeCamera& camera,
                       std::span<const Ghost> ghosts) {
  mjvCamera view;
  mjv_defaultCamera(&view);
  contents_->Update(data, view);
  // The engine has two cameras for stereo pictures and renders other pictures from their mean.
  for (mjvGLCamera& eye : contents_->shapes.camera) {
    eye = ToEngine(camera, *contents_->engine_model);
  }
  for (const Ghost& ghost : ghosts) contents_->Add(ghost);
  return contents_->Draw();
}

std::string AvailableRenderer() {
  try {
    return OffscreenContext::Create()->name();
  } catch (const EnvironmentError&) {
    return "";
  }
}

}  // namespace assay::render
