#include <benchmark/benchmark.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "bench/harness/contest.h"
#include "planner/base/input_files/input_error.h"
#include "sim/render/offscreen_context.h"
#include "sim/render/renderer.h"
#include "sim/scenario/scenario.h"
#include "sim/scene/scene.h"

namespace assay {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

const scene::Scene& FigureThirteen() {
  static const scenario::Scenario scenario =
      scenario::Load(std::string(ASSAY_SOURCE_DIR) + "/scenarios/spar-fig13.yaml");
  static const scene::Scene scene(scenario.problem, scenario.simulation.scene);
  return scene;
}

mujoco::CameraId Camera() { return mujoco::CameraId(0); }

void Draw(benchmark::State& state, int samples) {
  const mujoco::Data data = FigureThirteen().Start();
  render::Renderer renderer(FigureThirteen().model(), kWidth, kHeight, {.samples = samples});
  renderer.Render(data, Camera());  // the first picture compiles the drawing programs
  for (auto _ : state) benchmark::DoNotOptimize(renderer.Render(data, Camera()));
}

// Renders with the engine's own calls in a row, as the engine's examples do.
class BareRenderer {
 public:
  explicit BareRenderer(const mjModel* model)
      : model_(mj_copyModel(nullptr, model)), context_(render::OffscreenContext::Create()) {
    model_->vis.global.offwidth = kWidth;
    model_->vis.global.offheight = kHeight;
    mjv_defaultOption(&options_);
    mjv_defaultCamera(&camera_);
    camera_.type = mjCAMERA_FIXED;
    camera_.fixedcamid = Camera().index();
    mjv_defaultScene(&shapes_);
    mjr_defaultContext(&drawing_);
    context_->MakeCurrent();
    mjv_makeScene(model_, &shapes_, 4000);
    mjr_makeContext(model_, &drawing_, 100);
    mjr_setBuffer(mjFB_OFFSCREEN, &drawing_);
  }
  ~BareRenderer() {
    mjr_freeContext(&drawing_);
    mjv_freeScene(&shapes_);
    mj_deleteModel(model_);
  }
  BareRenderer(const BareRenderer&) = delete;
  BareRenderer& operator=(const BareRenderer&) = delete;

  const std::vector<unsigned char>& Draw(mjData* data) {
    const mjrRect viewport{0, 0, kWidth, kHeight};
    mjv_updateScene(model_, data, &options_, nullptr, &camera_, mjCAT_ALL, &shapes_);
    mjr_render(viewport, &shapes_, &drawing_);
    mjr_readPixels(pixels_.data(), nullptr, viewport, &drawing_);
    return pixels_;
  }

 private:
  mjModel* model_;
  std::unique_ptr<render::OffscreenContext> context_;
  mjvOption options_;
  mjvCamera camera_;
  mjvScene shapes_;
  mjrContext drawing_;
  std::vector<unsigned char> pixels_ =
      std::vector<unsigned char>(std::size_t{3} * kWidth * kHeight);
};

// Compares pictures. The engine's rows begin at the bottom.
bool IsSamePicture(const render::Image& picture, const std::vector<unsigned char>& pixels) {
  constexpr std::size_t kRow = std::size_t{3} * kWidth;
  for (std::size_t row = 0; row < kHeight; ++row) {
    const auto ours = picture.rgb.begin() + static_cast<std::ptrdiff_t>(row * kRow);
    const auto theirs = pixels.begin() + static_cast<std::ptrdiff_t>((kHeight - 1 - row) * kRow);
    if (!std::equal(ours, ours + kRow, theirs)) return false;
  }
  return true;
}

void DrawBare(benchmark::State& state) {
  mujoco::Data data = FigureThirteen().Start();
  const render::Image ours =
      render::Renderer(FigureThirteen().model(), kWidth, kHeight, {.samples = 1})
          .Render(data, Camera());
  BareRenderer renderer(FigureThirteen().model().get());
  if (!IsSamePicture(ours, renderer.Draw(data.get()))) {
    return state.SkipWithError("the pictures differ");
  }
  for (auto _ : state) benchmark::DoNotOptimize(renderer.Draw(data.get()));
}

const bool kAdded = [] {
  // OSMesa would otherwise draw with threads of its own, whose time does not count.
  setenv("LP_NUM_THREADS", "0", 1);
  bench::Announce(
      "rendering",
      {.measured = "a picture of the start of figure 13 with 640 x 480 pixels, all effects and one "
                   "sample for each pixel. The peer calls the engine's mjv_updateScene, mjr_render "
                   "and mjr_readPixels one after another",
       .unfair =
           "assay also reverses the order of the rows and allocates memory for every picture. By "
           "default, `assay render` takes 2 x 2 samples for each pixel (column smooth)",
       .never_below = 0.95});
  if (render::AvailableRenderer().empty()) {
    bench::AddMissing("rendering", "mujoco", "libosmesa6");
    return false;
  }
  bench::AddContestant("rendering", "fig13", "assay",
                       [](benchmark::State& state) { Draw(state, 1); });
  bench::AddContestant("rendering", "fig13", "mujoco", DrawBare);
  bench::AddContestant("rendering", "fig13", "assay:smooth",
                       [](benchmark::State& state) { Draw(state, 2); });
  return true;
}();

}  // namespace
}  // namespace assay
