#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "planner/geometry/box.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "tests/planner/uncertainty/action_lists.h"
#include "tests/scratch_file.h"

// Parts that leave a known room to a hand or to each other. The certificate must state what errors
// leave of this room. While some room is left, no draw of the errors may make bodies meet.
namespace assay::uncertainty::narrow_room_test {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;

constexpr char kPlateWithRib[] = R"(
solids:
  body: {box: [[-90, -70, 0], [90, 70, 50]], color: [0.6, 0.6, 0.7, 1]}
pockets:
  left: {cut_from: body, box: [[-11, 14, 20], [11, 68, 50]]}
  right: {cut_from: body, box: [[-11, -68, 20], [11, -14, 50]]}
  bore: {cut_from: body, box: [[-10, -10, 0], [10, 10, 25]], widen: [x, y]}
features:
  1: {face: body, normal: [0, 0, 1], what: top}
  2: {hole: bore, axis: [0, 0, -1], what: bore}
)";
constexpr char kCap[] = R"(
solids:
  body: {box: [[-18, -18, 0], [18, 18, 60]], color: [0.2, 0.6, 0.7, 1]}
pockets:
  bore: {cut_from: body, box: [[-10, -10, 0], [10, 10, 25]], widen: [x, y]}
features:
  1: {face: body, normal: [0, 0, 1], what: top}
  2: {hole: bore, axis: [0, 0, -1], what: bore}
)";
// A cap whose foot is wider than the neck at which it is held.
constexpr char kFootedCap[] = R"(
solids:
  body: {box: [[-20, -20, 0], [20, 20, 25]], color: [0.2, 0.6, 0.7, 1]}
  neck: {box: [[-12, -12, 25], [12, 12, 140]], color: [0.2, 0.6, 0.7, 1]}
pockets:
  bore: {cut_from: body, box: [[-10, -10, 0], [10, 10, 20]], widen: [x, y]}
features:
  1: {face: neck, normal: [0, 0, 1], what: top}
  2: {hole: bore, axis: [0, 0, -1], what: bore}
)";
// A cap whose skirt hangs down beside the stand, to a height above the table.
constexpr char kSkirtedCap[] = R"(
solids:
  body: {box: [[-18, -140, 0], [18, 140, 60]], color: [0.2, 0.6, 0.7, 1]}
  skirt: {box: [[-18, 120, LOW], [18, 140, 0]], color: [0.2, 0.6, 0.7, 1]}
  skirt-2: {box: [[-18, -140, LOW], [18, -120, 0]], color: [0.2, 0.6, 0.7, 1]}
  neck: {box: [[-12, -12, 60], [12, 12, 140]], color: [0.2, 0.6, 0.7, 1]}
pockets:
  bore: {cut_from: body, box: [[-10, -10, 0], [10, 10, 25]], widen: [x, y]}
features:
  1: {face: neck, normal: [0, 0, 1], what: top}
  2: {hole: bore, axis: [0, 0, -1], what: bore}
)";
constexpr char kPin[] = R"(
solids:
  base: {box: [[-90, -100, 0], [90, 100, 20]], color: [0.5, 0.4, 0.3, 1]}
  pin: {box: [[-10, -10, 20], [10, 10, 42]], color: [0.8, 0.8, 0.3, 1]}
features:
  1: {face: base, normal: [0, 0, 1], what: top}
  2: {shaft: pin, axis: [0, 0, 1], what: pin}
)";
// A pin between walls that are 3 mm farther away than open fingers reach.
constexpr char kWalledPin[] = R"(
solids:
  base: {box: [[-120, -120, 0], [120, 120, 20]], color: [0.5, 0.4, 0.3, 1]}
  pin: {box: [[-10, -10, 20], [10, 10, 42]], color: [0.8, 0.8, 0.3, 1]}
  left: {box: [[-90, WALL, 20], [90, 110, 90]], color: [0.5, 0.4, 0.3, 1]}
  right: {box: [[-90, -110, 20], [90, -WALL, 90]], color: [0.5, 0.4, 0.3, 1]}
  front: {box: [[WALL, -110, 20], [110, 110, 90]], color: [0.5, 0.4, 0.3, 1]}
  back: {box: [[-110, -110, 20], [-WALL, 110, 90]], color: [0.5, 0.4, 0.3, 1]}
features:
  1: {face: base, normal: [0, 0, 1], what: top}
  2: {shaft: pin, axis: [0, 0, 1], what: pin}
)";
// A pin below two lips. The foot passes between the lips with 3 mm on each side, well before it
// reaches the pin.
constexpr char kLippedPin[] = R"(
solids:
  base: {box: [[-90, -100, 0], [90, 100, 20]], color: [0.5, 0.4, 0.3, 1]}
  pin: {box: [[-10, -10, 20], [10, 10, 36]], color: [0.8, 0.8, 0.3, 1]}
  post: {box: [[-60, -60, 20], [-45, 60, 80]], color: [0.5, 0.4, 0.3, 1]}
  post-2: {box: [[45, -60, 20], [60, 60, 80]], color: [0.5, 0.4, 0.3, 1]}
  lip: {box: [[-60, -60, 70], [-23, 60, 80]], color: [0.5, 0.4, 0.3, 1]}
  lip-2: {box: [[23, -60, 70], [60, 60, 80]], color: [0.5, 0.4, 0.3, 1]}
features:
  1: {face: base, normal: [0, 0, 1], what: top}
  2: {shaft: pin, axis: [0, 0, 1], what: pin}
)";

std::string Replaced(std::string text, const std::string& word, const std::string& by) {
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at)) {
    text.replace(at, word.size(), by);
  }
  return text;
}

// Returns the distance in millimetres to which open fingers reach from the middle of the hand, at
// the height of the pads.
double OpenReach(const domain::Workcell& workcell) {
  const kinematics::Gripper& gripper = workcell.gripper();
  double reach = 0;
  for (const geometry::Box& box : gripper.FingerBoxes(gripper.max_opening())) {
    if (box.X_FrameBox.translation().z() + box.half_extents.z() < 0) continue;  // behind the pads
    reach = std::max(reach, 1000 * (box.X_FrameBox.translation().y() + box.half_extents.y()));
  }
  return reach;
}

// Makes a folder of models with two parts of its own, and removes it at the end.
class NarrowRoom : public ::testing::Test {
 protected:
  NarrowRoom() : folder_(ScratchFile("narrow-room")) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "parts");
    for (const char* same : {"robots", "grippers", "workcells"}) {
      fs::create_directory_symlink(fs::path(ASSAY_SOURCE_DIR) / "models" / same, folder_ / same);
    }
  }
  ~NarrowRoom() override { fs::remove_all(folder_); }

  void Write(const std::string& name, const std::string& solids) const {
    fs::create_directories(folder_ / "parts" / name);
    std::ofstream(folder_ / "parts" / name / "part.yaml")
        << "format: assay-part/1\nname: " << name << "\ninitial: " << (name == "cap" ? "C" : "P")
        << "\nunits: {length: mm, angle: degree}\ndensity: 300\nfriction: 0.25\n"
        << solids << "stable_poses:\n  upright: [0, 0, -1]\n";
  }

  // The errors of `cap` or `stand` in x and y, millimetres. The cap is mated onto the pin of the
  // stand.
  struct Off {
    double cap = 0;
    double stand = 0;
  };
  domain::Problem Problem(double play, double top, double way, const Off& off) const {
    const fs::path file = folder_ / "scene.yaml";
    const auto error = [](double e) {
      return fmt::format("{{x: {}, y: {}, z: 0, theta: 0}}", e, e);
    };
    std::ofstream(file) << fmt::format(R"(
format: assay-scenario/1
units: {{length: mm, angle: degree}}
workcell: puma762-table
clearance: {}
parts:
  stand: {{model: stand, pose: {{stable: upright, at: [650, 150], yaw: 0}}, error: {}}}
  cap: {{model: cap, pose: {{stable: upright, at: [600, -150], yaw: 0}}, error: {}}}
gripper: {{error: {{x: 0, y: 0, z: 0, theta: 0}}}}
sensing: []
goal:
  - assembled:
      held: cap
      fixed: stand
      features: [[2], [2]]
      pose: {{columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, {}]]}}
      mating_vector: [0, 0, {}]
)",
                                       play, error(off.stand), error(off.cap), top, -way);
    return domain::ReadProblem(Document::Load(file), folder_);
  }

  // Returns the least margin of all claims of a kind, metres; infinite if there is none.
  static double Margin(const std::vector<CertifiedAction>& actions, plan::Condition condition) {
    double margin = std::numeric_limits<double>::infinity();
    for (const CertifiedAction& action : actions) {
      for (const auto& claim : action.certificate.preconditions) {
        if (claim.condition == condition) margin = std::min(margin, claim.margin);
      }
    }
    return margin;
  }

  // Executes the actions with many draws of the errors and expects no contradiction to a
  // certificate. Returns how many executions were completed.
  static int Completed(const domain::Problem& problem,
                       const std::vector<CertifiedAction>& actions) {
    RandomStream random(27, "narrow room");
    int completed = 0;
    for (int i = 0; i < kDraws; ++i) {
      const oracle::Execution execution = oracle::ExecuteOnce(problem, actions, random);
      EXPECT_THAT(execution.contradictions, IsEmpty());
      completed += execution.completed ? 1 : 0;
    }
    return completed;
  }

  // Expects that bodies can meet only if errors exceed `room` millimetres.
  template <class ProblemOf>
  static void ExpectRoom(double room, plan::Condition condition, const ProblemOf& problem_of) {
    for (const double error : {0.3 * room, 0.98 * room, 1.02 * room, 1.5 * room}) {
      const domain::Problem problem = problem_of(error);
      const std::vector<CertifiedAction> actions = Certify(problem, FirstPlan(problem));
      ASSERT_FALSE(actions.empty());
      const double margin = 1000 * Margin(actions, condition);
      const int completed = Completed(problem, actions);
      if (error < room) {
        EXPECT_GT(margin, 0) << error;
        EXPECT_EQ(completed, kDraws) << error;
      } else {
        EXPECT_NEAR(margin, room - error, 1e-6) << error;
        EXPECT_LT(completed, kDraws) << error;
      }
    }
  }

  static constexpr int kDraws = 100;
  fs::path folder_;
};

// The fingers of 16 mm go into pockets of 22 mm beside the rib.
TEST_F(NarrowRoom, FingersHitTheVeryPartThatTheyTake) {
  Write("cap", kPlateWithRib);
  Write("stand", kPin);
  ExpectRoom(3, plan::condition::kHandClear,
             [&](double error) { return Problem(6, 20, 50, {.cap = error}); });
}

TEST_F(NarrowRoom, OpeningFingersHitTheFixedPart) {
  Write("cap", kCap);
  const double reach = OpenReach(*LoadScenario("uncertain-known").workcell);
  Write("stand", Replaced(kWalledPin, "WALL", fmt::format("{}", reach + 3)));
  ExpectRoom(3, plan::condition::kHandClear,
             [&](double error) { return Problem(6, 20, 60, {.stand = error}); });
}

TEST_F(NarrowRoom, TheHeldPartHitsTheFixedPartBeforeItsShaftIsInItsHole) {
  Write("cap", kFootedCap);
  Write("stand", kLippedPin);
  ExpectRoom(3, plan::condition::kPassingClear,
             [&](double error) { return Problem(6, 20, 70, {.stand = error}); });
}

// The seat is 20 mm above the table, and the skirt hangs down from it by 20 mm.
TEST_F(NarrowRoom, ASkirtThatMayMeetTheTableIsNotProved) {
  Write("stand", kPin);
  for (const double height : {0.0, 5.0}) {
    Write("cap", Replaced(kSkirtedCap, "LOW", fmt::format("{}", height - 20)));
    const domain::Problem problem = Problem(6, 20, 60, {.cap = 0.1});
    const std::vector<CertifiedAction> actions = Certify(problem, FirstPlan(problem));
    ASSERT_FALSE(actions.empty());
    const double margin = 1000 * Margin(actions, plan::condition::kPassingClear);
    EXPECT_EQ(margin > 1e-9, height > 0) << margin;
  }
}

}  // namespace
}  // namespace assay::uncertainty::narrow_room_test
