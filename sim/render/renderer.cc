#include "sim/render/renderer.h"

#include <mujoco/mujoco.h>

#include <algorithm>

#include "planner/base/check.h"
#include "planner/base/input_error.h"
#include "sim/mujoco/engine_messages.h"
#include "sim/render/offscreen_context.h"
#include "sim/render/supersampling.h"

namespace assay::render {
namespace {

constexpr int kLargestSide = 4096;
constexpr int kMostShapes = 4000;
constexpr int kFontScale = 100;

using ModelCopy = std::unique_ptr<mjModel, void (*)(mjModel*)>;

// The engine takes the size of its framebuffer from the model.
ModelCopy WithFramebuffer(const mjModel* model, int width, int height) {
  ModelCopy copy(mj_copyModel(nullptr, model), mj_deleteModel);
  copy->vis.global.offwidth = width;
  copy->vis.global.offheight = height;
  return copy;
}

}  // namespace

// Members in the order of construction: what draws is freed before the context that it needs.
struct Renderer::Contents {
  Contents(const mujoco::Model& model, int picture_width, int picture_height)
      : width(picture_width),
        height(picture_height),
        context(OffscreenContext::Create()),
        engine_model(
            WithFramebuffer(model.get(), width * kSupersampling, height * kSupersampling)) {
    mjv_defaultScene(&shapes);
    mjr_defaultContext(&drawing);
    context->MakeCurrent();
    mjv_makeScene(engine_model.get(), &shapes, kMostShapes);
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
  Contents(const Contents&) = delete;
  Contents& operator=(const Contents&) = delete;

  int width;
  int height;
  std::unique_ptr<OffscreenContext> context;
  ModelCopy engine_model;
  mjvScene shapes{};
  mjrContext drawing{};
};

Renderer::Renderer(const mujoco::Model& model, int width, int height) {
  ASSAY_CHECK(std::min(width, height) >= 1 && std::max(width, height) <= kLargestSide,
              "a picture of {} by {} pixels", width, height);
  mujoco::HandleEngineMessages();
  contents_ = std::make_unique<Contents>(model, width, height);
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Image Renderer::Render(const mujoco::Data& data, mujoco::CameraId camera) {
  Contents& c = *contents_;
  mjvCamera view;
  mjv_defaultCamera(&view);
  view.type = mjCAMERA_FIXED;
  view.fixedcamid = camera.index();
  mjvOption options;
  mjv_defaultOption(&options);
  c.context->MakeCurrent();
  // The engine only reads the data here, but does not say so in its signature.
  mjv_updateScene(c.engine_model.get(), const_cast<mjData*>(data.get()), &options, nullptr, &view,
                  mjCAT_ALL, &c.shapes);
  Image large{c.width * kSupersampling, c.height * kSupersampling, {}};
  large.rgb.resize(std::size_t{3} * large.width * large.height);
  const mjrRect viewport{0, 0, large.width, large.height};
  mjr_render(viewport, &c.shapes, &c.drawing);
  mjr_readPixels(large.rgb.data(), nullptr, viewport, &c.drawing);
  return FromSamples(large);
}

std::string AvailableRenderer() {
  try {
    return OffscreenContext::Create()->name();
  } catch (const EnvironmentError&) {
    return "";
  }
}

}  // namespace assay::render
