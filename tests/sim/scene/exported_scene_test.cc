#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/domain/problem/problem_file.h"
#include "sim/mujoco/engine_messages.h"
#include "sim/scene/scene.h"
#include "tests/scratch_file.h"

namespace assay::scene::exported_scene_test {
namespace {

namespace fs = std::filesystem;

using OwnedModel = std::unique_ptr<mjModel, void (*)(mjModel*)>;
using OwnedData = std::unique_ptr<mjData, void (*)(mjData*)>;

// Gives the engine the collision function of boxes that other programs have. In this process,
// mujoco::CheckBoxCollisions replaces it by its own one.
class PlainEngine {
 public:
  PlainEngine() : ours_(mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX]) {
    mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX] = kTheirs;
  }
  ~PlainEngine() { mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX] = ours_; }
  PlainEngine(const PlainEngine&) = delete;
  PlainEngine& operator=(const PlainEngine&) = delete;

 private:
  static const mjfCollision kTheirs;
  mjfCollision ours_;
};
// The function is read before main, when nothing has replaced it.
const mjfCollision PlainEngine::kTheirs = mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX];

std::vector<fs::path> AllScenarios() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(ASSAY_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

domain::Problem FirstWorldOf(const fs::path& file) {
  return domain::ReadWorlds(Document::Load(file), ASSAY_SOURCE_DIR "/models", {}).front();
}

OwnedModel Loaded(const std::string& mjcf) {
  mujoco::HandleEngineMessages();
  const fs::path file = ScratchFile("scene.xml");
  std::ofstream(file) << mjcf;
  char message[1000] = "";
  OwnedModel model(mj_loadXML(file.c_str(), nullptr, message, sizeof message), mj_deleteModel);
  EXPECT_STREQ(message, "");
  return model;
}

// Returns the first warning, or says that a velocity is not a number. Empty means neither.
std::string TroubleIn(const mjModel& model, const mjData& data) {
  for (int i = 0; i < mjNWARNING; ++i) {
    if (data.warning[i].number > 0) return mju_warningText(i, data.warning[i].lastinfo);
  }
  for (int i = 0; i < model.nv; ++i) {
    if (!std::isfinite(data.qvel[i])) return "a velocity that is no number";
  }
  return "";
}

// Returns the simulated seconds. The environment variable ASSAY_EXPORTED_SECONDS sets them.
double Seconds() {
  const char* seconds = std::getenv("ASSAY_EXPORTED_SECONDS");
  return seconds == nullptr ? 1 : std::atof(seconds);
}

struct Stepped {
  std::string trouble;
  double speed = 0;  // greatest of all coordinates at the end, m/s or rad/s
};

Stepped Step(const mjModel& model, mjData& data) {
  while (data.time < Seconds()) {
    mj_step(&model, &data);
    if (std::string trouble = TroubleIn(model, data); !trouble.empty()) return {trouble, 0};
  }
  double speed = 0;
  for (int i = 0; i < model.nv; ++i) speed = std::max(speed, std::abs(data.qvel[i]));
  return {"", speed};
}

// The model is stepped from its own configuration and from its key frame. From the key frame,
// everything comes to rest.
TEST(ExportedScene, StepsInThePlainEngine) {
  const PlainEngine plain;
  for (const fs::path& file : AllScenarios()) {
    const OwnedModel model = Loaded(ToMjcf(FirstWorldOf(file), {.endless_tables = true}));
    ASSERT_TRUE(model) << file;
    ASSERT_EQ(model->nkey, 1) << file;
    const OwnedData data(mj_makeData(model.get()), mj_deleteData);
    const Stepped from_zero = Step(*model, *data);
    EXPECT_EQ(from_zero.trouble, "") << file;
    mj_resetDataKeyframe(model.get(), data.get(), 0);
    const Stepped from_home = Step(*model, *data);
    EXPECT_EQ(from_home.trouble, "") << file;
    // The engine's own contacts of meshes jitter.
    EXPECT_LT(from_home.speed, model->nmesh == 0 ? 1e-3 : 2e-2) << file;
    mujoco::TakeEngineWarnings();
  }
}

TEST(ExportedScene, HasWhereTheSceneStartsAsKeyFrame) {
  for (const char* name : {"spar-fig15", "five-cans"}) {
    const fs::path file = fs::path(ASSAY_SOURCE_DIR) / "scenarios" / (std::string(name) + ".yaml");
    const Scene scene(FirstWorldOf(file), {});
    const mujoco::Data start = scene.Start();
    const mjModel& model = *scene.model().get();
    ASSERT_EQ(std::string(mj_id2name(&model, mjOBJ_KEY, 0)), "home");
    for (int i = 0; i < model.nq; ++i) EXPECT_NEAR(model.key_qpos[i], start.qpos()[i], 1e-12) << i;
    for (int i = 0; i < model.nu; ++i) EXPECT_NEAR(model.key_ctrl[i], start.ctrl()[i], 1e-12) << i;
  }
}

}  // namespace
}  // namespace assay::scene::exported_scene_test
