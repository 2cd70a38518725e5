#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "planner/base/random.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/motion/collision/collision_scene.h"
#include "planner/motion/paths/path_search.h"
#include "planner/motion/paths/straight_line.h"
#include "sim/scene/scene.h"

namespace assay::execution::path_in_engine_test {
namespace {

using domain::PartId;
using kinematics::JointVector;
using motion::CollisionScene;
using motion::JointPath;

// Returns the number of queries for each scene. The environment variable ASSAY_PATH_QUERIES sets
// it, and the test prints its figures.
int Queries() {
  const char* said = std::getenv("ASSAY_PATH_QUERIES");
  return said == nullptr ? 2 : std::stoi(said);
}

struct Case {
  const char* scenario;
  bool holds_the_peg;
};

// Random queries between postures with the tool low over the table. The engine is the oracle. It
// has its own shapes for everything that moves.
class PathInEngine : public testing::TestWithParam<Case> {
 protected:
  PathInEngine()
      : problem_(domain::ReadProblem(Document::Load(ASSAY_SOURCE_DIR "/scenarios/" +
                                                    std::string(GetParam().scenario) + ".yaml"),
                                     ASSAY_SOURCE_DIR "/models")),
        surroundings_(SurroundingsOf(problem_)),
        paths_(problem_, surroundings_),
        engine_(problem_, {}),
        data_(engine_.Start()),
        own_arm_too_(WithTheArmItself(*data_.own_model()), mj_deleteModel) {
    engine_.SetGripper(data_, surroundings_.opening);
  }

  // Returns a model in which the moving bodies can touch each other. Their geoms have one more
  // contact bit.
  static mjModel* WithTheArmItself(const mjModel& model) {
    constexpr int kItself = 1 << 30;
    mjModel* watching = mj_copyModel(nullptr, &model);
    for (int geom = 0; geom < model.ngeom; ++geom) {
      const std::string body = mj_id2name(&model, mjOBJ_BODY, model.geom_bodyid[geom]);
      if (!Moves(body) || (model.geom_contype[geom] | model.geom_conaffinity[geom]) == 0) continue;
      watching->geom_contype[geom] |= kItself;
      watching->geom_conaffinity[geom] |= kItself;
    }
    return watching;
  }

  static bool Moves(const std::string& body) {
    return body.starts_with("arm/") || body.starts_with("gripper/") ||
           (GetParam().holds_the_peg && body == "part/peg");
  }

  // Returns the planner's name for a body of the engine. The engine's names are for example
  // "arm/forearm", "gripper/finger_left" and "part/peg".
  static std::string PlannersName(const std::string& body) {
    const std::string name = body.substr(body.find('/') + 1);
    return name.starts_with("finger") ? "fingers" : name;
  }

  // Returns whether the planner keeps these two moving bodies apart. It does not do so for bodies
  // that one joint connects.
  bool MustNotTouch(const std::string& a, const std::string& b) const {
    return std::ranges::any_of(paths_.pairs(), [&](const motion::BodyPair& pair) {
      const std::string& first = paths_.body(pair.first).name;
      const std::string& second = paths_.body(pair.second).name;
      return (first == PlannersName(a) && second == PlannersName(b)) ||
             (first == PlannersName(b) && second == PlannersName(a));
    });
  }

  static motion::Surroundings SurroundingsOf(const domain::Problem& problem) {
    const PartId peg(1);
    motion::Surroundings surroundings{.opening = 0.05};
    for (std::size_t p = 0; p < problem.parts.size(); ++p) {
      if (GetParam().holds_the_peg && PartId(p) == peg) continue;
      surroundings.parts.push_back({PartId(p), problem.parts[p].X_WorldPart});
    }
    if (!GetParam().holds_the_peg) return surroundings;
    const domain::Grasp& grasp = problem.part(peg).grasps->front();
    surroundings.held = motion::HeldPart{peg, grasp.X_PartTool};
    surroundings.opening = grasp.width;
    return surroundings;
  }

  JointVector Draw(RandomStream& random) const {
    motion::MotionCheck check(paths_, {.clearance = 0.012});
    const domain::Workcell& workcell = *problem_.workcell;
    while (true) {
      JointVector q;
      for (int j = 0; j < 6; ++j) {
        const kinematics::JointLimits& limits = workcell.arm().limits()[j];
        q[j] = random.Uniform(limits.lower, limits.upper);
      }
      const geometry::Vector3 tool = workcell.X_WorldBase() * workcell.arm().Forward(q) *
                                     workcell.gripper().X_FlangeTool().translation();
      const bool near = tool.x() > 0.3 && tool.x() < 1.05 && std::abs(tool.y()) < 0.6 &&
                        tool.z() > 0 && tool.z() < 0.35;
      if (near && !check.FindObstruction(q, q)) return q;
    }
  }

  void Put(PartId part, const geometry::Pose& X_WorldPart) {
    const mjModel* model = data_.own_model();
    const int joint = model->body_jntadr[engine_.Body(part).index()];
    const Eigen::Quaterniond turn(X_WorldPart.linear());
    const geometry::Vector3 p = X_WorldPart.translation();
    const std::array<double, 7> values = {p.x(),    p.y(),    p.z(),   turn.w(),
                                          turn.x(), turn.y(), turn.z()};
    std::ranges::copy(values, data_.qpos().begin() + model->jnt_qposadr[joint]);
  }

  // Returns a pair of bodies that touch but should not with the arm at q. Empty means none.
  std::string Touching(const JointVector& q) {
    for (std::size_t j = 0; j < 6; ++j) data_.qpos()[engine_.arm().qpos[j]] = q[j];
    if (const auto& held = surroundings_.held) {
      Put(held->part, motion::ToolAt(*problem_.workcell, q) * held->X_PartTool.inverse());
    }
    mj_kinematics(own_arm_too_.get(), data_.get());
    mj_comPos(own_arm_too_.get(), data_.get());
    mj_collision(own_arm_too_.get(), data_.get());
    for (const mujoco::Contact& contact : mujoco::Contacts(data_)) {
      const std::string a = data_.model().Name(contact.body_a);
      const std::string b = data_.model().Name(contact.body_b);
      if (Moves(a) != Moves(b) || (Moves(a) && MustNotTouch(a, b))) return a + " " + b;
    }
    return {};
  }

  // Returns the first pair of bodies that touch along the path but should not. No point of a moving
  // body goes farther than a millimetre between two tests.
  std::string TouchingAlong(const JointPath& path) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const JointVector way = path[i + 1] - path[i];
      double motion = 0;
      for (const motion::BodyPair& pair : paths_.pairs()) {
        motion = std::max(motion, paths_.GreatestMotion(pair, way.cwiseAbs()));
      }
      const int steps = static_cast<int>(std::ceil(motion / 1e-3));
      for (int k = 0; k <= steps; ++k) {
        const std::string pair = Touching(path[i] + static_cast<double>(k) / steps * way);
        if (!pair.empty()) return pair;
      }
    }
    return {};
  }

  domain::Problem problem_;
  motion::Surroundings surroundings_;
  CollisionScene paths_;
  scene::Scene engine_;
  mujoco::Data data_;
  std::unique_ptr<mjModel, void (*)(mjModel*)> own_arm_too_;
};

TEST_P(PathInEngine, TouchesNothing) {
  RandomStream random(2026, "paths in the engine");
  int unsolved = 0;
  int solved_by_a_long_run = 0;
  std::vector<double> milliseconds;
  for (int i = 0; i < Queries(); ++i) {
    motion::PathRequest request{.from = Draw(random), .to = Draw(random)};
    const std::clock_t start = std::clock();
    const motion::PathResult result = FindPath(paths_, request);
    milliseconds.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    if (const auto* path = std::get_if<JointPath>(&result)) {
      EXPECT_EQ(TouchingAlong(*path), "") << "query " << i;
      continue;
    }
    ++unsolved;
    request.budget *= 20;
    if (std::holds_alternative<JointPath>(FindPath(paths_, request))) ++solved_by_a_long_run;
  }
  std::ranges::sort(milliseconds);
  std::cout << Queries() << " queries, " << unsolved << " unsolved, of which a long run solves "
            << solved_by_a_long_run << "; median " << milliseconds[milliseconds.size() / 2]
            << " ms\n";
  EXPECT_LE(solved_by_a_long_run, Queries() / 100);
}

// The oracle must see a contact if the hand is in the middle of the block.
TEST_P(PathInEngine, TheEngineSeesWhatIsTouched) {
  const geometry::Pose X_WorldTool =
      problem_.part(PartId(0)).X_WorldPart *
      geometry::Translation(problem_.part(PartId(0)).model->mass().center);
  const geometry::Pose down =
      geometry::Translation(X_WorldTool.translation()) * geometry::RotationX(M_PI);
  const domain::Workcell& workcell = *problem_.workcell;
  for (const auto& s : workcell.arm().Inverse(workcell.FlangeFor(down), workcell.home())) {
    if (!workcell.arm().InRange(s.q)) continue;
    EXPECT_NE(Touching(s.q), "");
  }
}

// The oracle must see the arm touch itself in some of many random postures.
TEST_P(PathInEngine, TheEngineSeesTheArmTouchItself) {
  RandomStream random(7, "arm touches itself");
  int seen = 0;
  for (int i = 0; i < 3000; ++i) {
    JointVector q;
    for (int j = 0; j < 6; ++j) q[j] = random.Uniform(-M_PI, M_PI);
    const std::string touching = Touching(q);
    const auto space = touching.find(' ');
    if (space == std::string::npos) continue;
    seen += Moves(touching.substr(0, space)) && Moves(touching.substr(space + 1)) ? 1 : 0;
  }
  EXPECT_GT(seen, 10);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PathInEngine,
                         testing::Values(Case{"clutter", false}, Case{"clutter", true},
                                         Case{"mast", false}, Case{"mast", true}),
                         [](const auto& of) {
                           return std::string(of.param.scenario) +
                                  (of.param.holds_the_peg ? "WithThePeg" : "");
                         });

}  // namespace
}  // namespace assay::execution::path_in_engine_test
