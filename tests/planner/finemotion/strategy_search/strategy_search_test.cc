#include "planner/finemotion/strategy_search/strategy_search.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "bench/workloads/pegs.h"
#include "planner/finemotion/strategy_search/mating.h"
#include "tests/oracle/random_pose.h"
#include "tests/planner/domain/scenario.h"

namespace assay::finemotion::strategy_search_test {
namespace {

using workloads::BoxShape;
using workloads::SquareHoleShape;

constexpr std::uint64_t kSeed = 72;
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kHalf = 0.01905;  // half of the width of the peg, metres
constexpr double kPlay = 0.25e-3;  // metres on each side

Passage SquarePegInHole() {
  Passage passage;
  passage.moving = BoxShape({-kHalf, -kHalf, 0}, {kHalf, kHalf, 0.07});
  passage.stationary = SquareHoleShape(kHalf + kPlay, 0.038, 0.07);
  passage.seat = 0.06;
  return passage;
}

FineMotionErrors ErrorsOf(double length, double angle) {
  FineMotionErrors errors;
  errors.pose << Vector3::Constant(length), Vector3::Constant(angle);
  return errors;
}

StrategyOptions OptionsOf(std::uint64_t seed) { return {.diverse_rounds = 0, .seed = seed}; }

// A plan for errors in all six dimensions.
const FineMotionPlan& WidePlan() {
  static const FineMotionPlan plan =
      SearchStrategy(SquarePegInHole(), ErrorsOf(2e-3, kDegree), OptionsOf(1));
  return plan;
}

TEST(SearchStrategy, FindsOneForWideErrors) {
  const FineMotionPlan& plan = WidePlan();
  EXPECT_TRUE(plan.found());
  EXPECT_GE(plan.absorbed, 1);
  EXPECT_FALSE(plan.obstacle);
  ASSERT_FALSE(plan.motions.empty());
  EXPECT_GE(plan.motions.size(), plan.maneuvers.size());
  for (const CertainMotion& motion : plan.motions) EXPECT_TRUE(motion.check.certain);
  // At the end the peg is in: over the hole, upright, and no higher than the remaining errors in
  // height.
  const Pose& end = plan.motions.back().X_StationaryAfter;
  EXPECT_LT(end.translation().head<2>().norm(), std::numbers::sqrt2 * kPlay);
  EXPECT_LT(std::acos(std::min(1.0, end.linear()(2, 2))), 0.02);
}

// With 3 mm of play the peg would come in from some starts without any contact. The plan still has
// a motion to execute.
TEST(SearchStrategy, HasAMotionWhereThePlayIsGreaterThanTheErrors) {
  Passage passage = SquarePegInHole();
  passage.stationary = SquareHoleShape(kHalf + 3e-3, 0.045, 0.07);
  const FineMotionPlan plan = SearchStrategy(passage, ErrorsOf(2e-3, kDegree), OptionsOf(1));
  EXPECT_TRUE(plan.found());
  EXPECT_FALSE(plan.motions.empty());
}

TEST(SearchStrategy, StartsInFreeSpaceWhateverTheErrors) {
  const Pose& start = WidePlan().X_StationaryStart;
  double lowest = 1;
  for (const OuterVertex& vertex : SquarePegInHole().moving.vertices) {
    lowest = std::min(lowest, (start * vertex.p).z());
  }
  EXPECT_GT(lowest, 2e-3 + kDegree * std::numbers::sqrt2 * kHalf);
}

void ExpectTheSame(const FineMotionPlan& a, const FineMotionPlan& b) {
  EXPECT_EQ(a.absorbed, b.absorbed);
  EXPECT_EQ(a.expanded, b.expanded);
  EXPECT_EQ(a.replayed, b.replayed);
  EXPECT_EQ(a.X_StationaryStart.matrix(), b.X_StationaryStart.matrix());
  ASSERT_EQ(a.motions.size(), b.motions.size());
  for (std::size_t i = 0; i < a.motions.size(); ++i) {
    EXPECT_EQ(a.motions[i].command.displacement, b.motions[i].command.displacement);
    EXPECT_EQ(a.motions[i].command.kept, b.motions[i].command.kept);
    EXPECT_EQ(a.motions[i].command.until, b.motions[i].command.until);
  }
}

TEST(SearchStrategy, IsTheSameForTheSameSeed) {
  const auto again = SearchStrategy(SquarePegInHole(), ErrorsOf(2e-3, kDegree), OptionsOf(1));
  ExpectTheSame(WidePlan(), again);
}

TEST(SearchStrategy, FindsNothingForErrorsOfACentimetre) {
  StrategyOptions options = OptionsOf(1);
  options.rounds = 2;
  const FineMotionPlan plan = SearchStrategy(SquarePegInHole(), ErrorsOf(0.01, kDegree), options);
  EXPECT_FALSE(plan.found());
  EXPECT_LT(plan.absorbed, 1);
}

TEST(SearchStrategy, FindsAShortOneForSmallErrors) {
  for (const double length : {0.0, 0.05e-3}) {
    const double angle = length > 0 ? 0.05 * kDegree : 0;
    const FineMotionPlan plan =
        SearchStrategy(SquarePegInHole(), ErrorsOf(length, angle), OptionsOf(1));
    EXPECT_TRUE(plan.found()) << length;
    EXPECT_LE(plan.motions.size(), 6U) << length;
    for (const CertainMotion& motion : plan.motions) EXPECT_TRUE(motion.check.certain);
  }
}

// This holds even if the sequence was found for larger errors than requested.
TEST(SearchStrategy, NothingUnwantedHappensWithinWhatIsAbsorbed) {
  for (const double length : {0.5e-3, 2e-3}) {
    const FineMotionPlan plan =
        SearchStrategy(SquarePegInHole(), ErrorsOf(length, length / 2e-3 * kDegree), OptionsOf(1));
    ASSERT_TRUE(plan.found()) << length;
    for (const CertainMotion& motion : plan.motions) {
      for (const Unwanted& unwanted : motion.check.unwanted)
        EXPECT_GT(unwanted.scale, 0.999 * plan.absorbed)
            << length << ": " << Name(unwanted.contact);
    }
  }
}

// --- Cases without a strategy for all the errors.

struct TooMuch {
  FineMotionErrors errors;
  FineMotionPlan plan;
};

// Returns the failed plan for this multiple of the errors of the scenario.
TooMuch TooMuchFor(const std::string& scenario, double times, StrategyOptions options) {
  const domain::Problem problem =
      domain::ReadProblem(Document::Load(domain::ScenarioPath(scenario)), domain::ModelsFolder());
  const MatingGeometry geometry = GeometryOf(problem, problem.matings.front());
  const FineMotionErrors errors =
      ErrorsOf(times * problem.mating_errors.displacement, times * problem.mating_errors.rotation);
  return {errors, SearchStrategy(geometry.passage, errors, options)};
}

// The errors that can be absorbed are a fixed number of millimetres, whatever multiple of the
// scenario's errors is requested. Sequences are found by chance, so that this number varies.
TEST(SearchStrategy, TheObstaclesMarginFallsAsErrorsGrow) {
  StrategyOptions options = OptionsOf(1);
  options.rounds = 1;
  options.thorough_nodes = 1;
  for (const char* scenario : {"mate-square", "mate-t-slot"}) {
    double last = 0;
    for (const double times : {3.0, 6.0}) {
      const auto [errors, plan] = TooMuchFor(scenario, times, options);
      ASSERT_FALSE(plan.found()) << scenario << " " << times;
      ASSERT_TRUE(plan.obstacle) << scenario << " " << times;
      EXPECT_GT(plan.absorbed, 0) << scenario << " " << times;
      EXPECT_GT(plan.obstacle->scale, plan.absorbed) << scenario << " " << times;
      EXPECT_LE(plan.obstacle->scale, 1) << scenario << " " << times;
      for (const CertainMotion& motion : plan.motions) {
        for (const Unwanted& unwanted : motion.check.unwanted)
          EXPECT_GT(unwanted.scale, 0.999 * plan.absorbed) << Name(unwanted.contact);
      }
      if (last > 0) {
        EXPECT_LT(plan.obstacle->scale, 0.9 * last) << scenario;
      }
      last = plan.obstacle->scale;
    }
  }
}

TEST(SearchStrategy, ASpentBudgetIsNoProofThatThereIsNone) {
  StrategyOptions options = OptionsOf(1);
  options.rounds = 1;
  EXPECT_EQ(TooMuchFor("mate-square", 3, options).plan.outcome, Outcome::kNone);
  options.thorough_nodes = 1;
  EXPECT_EQ(TooMuchFor("mate-square", 3, options).plan.outcome, Outcome::kBudget);
  options.thorough_nodes = 0;
  const FineMotionPlan unasked = TooMuchFor("mate-square", 3, options).plan;
  EXPECT_EQ(unasked.outcome, Outcome::kBudget);
  EXPECT_EQ(unasked.absorbed, 0);
}

// --- Parts that are wrong by up to their tolerances.

Passage WithTolerances(std::vector<ModelTolerance> tolerances) {
  Passage passage = SquarePegInHole();
  passage.tolerances = std::move(tolerances);
  return passage;
}

FineMotionPlan PlanFor(double width) {
  using Of = ModelTolerance::Of;
  FineMotionErrors errors = ErrorsOf(0.5e-3, 0.25 * kDegree);
  errors.tolerances = Eigen::Vector2d(width, width);
  return SearchStrategy(WithTolerances({{"width of the peg", Of::kMovingFaces, {0, 1}},
                                        {"hole", Of::kStationaryFaces, {2, 4}}}),
                        errors, OptionsOf(1));
}

TEST(SearchStrategy, TolerancesOfNothingChangeNothing) {
  const FineMotionPlan exact =
      SearchStrategy(SquarePegInHole(), ErrorsOf(0.5e-3, 0.25 * kDegree), OptionsOf(1));
  const FineMotionPlan plan = PlanFor(0);
  EXPECT_TRUE(exact.found());
  EXPECT_TRUE(plan.found());
  EXPECT_NEAR(plan.absorbed, exact.absorbed, 1e-9);
  EXPECT_EQ(plan.motions.size(), exact.motions.size());
}

TEST(SearchStrategy, FindsOneForSmallTolerances) { EXPECT_TRUE(PlanFor(0.02e-3).found()); }

// The peg may be wider than the hole.
TEST(SearchStrategy, FindsNothingForTolerancesGreaterThanThePlay) {
  const FineMotionPlan plan = PlanFor(kPlay + 0.05e-3);
  EXPECT_FALSE(plan.found());
  EXPECT_LT(plan.absorbed, 1);
}

// --- A replay in exact geometry with the points and planes of the features. Parts move in small
// steps, and kept contacts are closed after each step.

constexpr double kRadius = 0.02;
constexpr double kTouching = 1e-7;  // metres

double GapOf(const Passage& passage, const ContactKey& key, const Pose& X) {
  const auto moving = static_cast<std::size_t>(key.moving);
  const auto stationary = static_cast<std::size_t>(key.stationary);
  switch (key.kind) {
    case ContactKind::kVertexFace: {
      const OuterFace& face = passage.stationary.faces[stationary];
      return face.normal.dot(X * passage.moving.vertices[moving].p) - face.height;
    }
    case ContactKind::kFaceVertex: {
      const OuterFace& face = passage.moving.faces[moving];
      return face.normal.dot(X.inverse() * passage.stationary.vertices[stationary].p) - face.height;
    }
    case ContactKind::kRimFace:
    case ContactKind::kRimRim:
    case ContactKind::kSideRim:
    case ContactKind::kRimWall:
      break;  // the shapes of these tests are not round
    case ContactKind::kEdgeEdge: {
      const OuterEdge& a = passage.moving.edges[moving];
      const OuterEdge& b = passage.stationary.edges[stationary];
      const Vector3 n = (X.linear() * a.direction()).cross(b.direction());
      // Outside of the features, either sign is right.
      return n.dot(X * a.start - b.start) / n.norm();
    }
  }
  return 0;
}

bool IsInside(const OuterFace& face, const Vector3& p) {
  return std::ranges::any_of(face.region, [&](const std::vector<Vector3>& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector3 along = outline[(i + 1) % outline.size()] - outline[i];
      if (face.normal.cross(along).dot(p - outline[i]) < 0) return false;
    }
    return true;
  });
}

// Returns whether features with a gap of 0 have a point in common.
bool Overlap(const Passage& passage, const ContactKey& key, const Pose& X) {
  const auto moving = static_cast<std::size_t>(key.moving);
  const auto stationary = static_cast<std::size_t>(key.stationary);
  switch (key.kind) {
    case ContactKind::kVertexFace:
      return IsInside(passage.stationary.faces[stationary], X * passage.moving.vertices[moving].p);
    case ContactKind::kFaceVertex:
      return IsInside(passage.moving.faces[moving],
                      X.inverse() * passage.stationary.vertices[stationary].p);
    case ContactKind::kRimFace:
    case ContactKind::kRimRim:
    case ContactKind::kSideRim:
    case ContactKind::kRimWall:
      break;  // the shapes of these tests are not round
    case ContactKind::kEdgeEdge: {
      const OuterEdge& a = passage.moving.edges[moving];
      const OuterEdge& b = passage.stationary.edges[stationary];
      Eigen::Matrix<double, 3, 2> lines;
      lines << X.linear() * (a.end - a.start), -(b.end - b.start);
      const Eigen::Vector2d at = lines.colPivHouseholderQr().solve(Vector3(b.start - X * a.start));
      return at.minCoeff() > 0 && at.maxCoeff() < 1;
    }
  }
  return false;
}

std::vector<ContactKey> AllPairs(const Passage& passage) {
  std::vector<ContactKey> keys;
  const auto add = [&](ContactKind kind, std::size_t moving, std::size_t stationary) {
    for (std::size_t i = 0; i < moving; ++i) {
      for (std::size_t j = 0; j < stationary; ++j) {
        keys.push_back({kind, static_cast<int>(i), static_cast<int>(j)});
      }
    }
  };
  const Polyhedron& moving = passage.moving;
  const Polyhedron& stationary = passage.stationary;
  add(ContactKind::kVertexFace, moving.vertices.size(), stationary.faces.size());
  add(ContactKind::kFaceVertex, moving.faces.size(), stationary.vertices.size());
  add(ContactKind::kEdgeEdge, moving.edges.size(), stationary.edges.size());
  return keys;
}

class ExactReplay {
 public:
  ExactReplay(const Passage& passage, const Pose& X) : passage_(passage), X_(X) {}

  const Pose& X() const { return X_; }

  // Returns the first contact on the way to `most` displacements, apart from kept contacts. The
  // part is turned about the believed tip.
  std::optional<ContactKey> Move(const Command& command, double most, Vector3 believed) {
    constexpr int kSteps = 400;
    const std::vector<ContactKey> apart = Apart();
    const GeneralizedPoint step = most / kSteps * command.displacement;
    for (int i = 0; i < kSteps; ++i) {
      const Pose before = X_;
      Advance(step, believed);
      Close(command.kept);
      if (const auto made = Made(before, apart)) {
        std::vector<ContactKey> touching = command.kept;
        touching.push_back(*made);
        Close(touching);
        return made;
      }
      believed += step.head<3>();
    }
    return std::nullopt;
  }

 private:
  void Advance(const GeneralizedPoint& step, const Vector3& believed) {
    const Vector3 apart = X_.translation() - believed;
    X_ = Displaced(X_, step);
    X_.translation() += Displaced(Pose::Identity(), step).linear() * apart - apart;
  }

  void Close(const std::vector<ContactKey>& keys) {
    if (keys.empty()) return;
    for (int round = 0; round < 3; ++round) {
      Eigen::VectorXd gaps(std::ssize(keys));
      Eigen::MatrixXd rows(std::ssize(keys), kPoseDimensions);
      for (Eigen::Index i = 0; i < gaps.size(); ++i) {
        const ContactKey& key = keys[static_cast<std::size_t>(i)];
        gaps[i] = GapOf(passage_, key, X_);
        for (int k = 0; k < kPoseDimensions; ++k) {
          const double size = k < 3 ? 1 : 1 / kRadius;
          const GeneralizedPoint nudge = 1e-7 * size * GeneralizedPoint::Unit(kPoseDimensions, k);
          rows(i, k) = (GapOf(passage_, key, Displaced(X_, nudge)) - gaps[i]) / 1e-7;
        }
      }
      GeneralizedPoint closing = rows.completeOrthogonalDecomposition().solve(-gaps);
      closing.tail<3>() /= kRadius;
      X_ = Displaced(X_, closing);
    }
  }

  // Returns all contacts that do not touch at the start. A contact that touches at the start, and
  // that the motion does not maintain, can only open.
  std::vector<ContactKey> Apart() const {
    std::vector<ContactKey> apart = AllPairs(passage_);
    std::erase_if(apart, [&](const ContactKey& key) {
      return std::abs(GapOf(passage_, key, X_)) < kTouching;
    });
    return apart;
  }

  std::optional<ContactKey> Made(const Pose& before, const std::vector<ContactKey>& apart) const {
    for (const ContactKey& key : apart) {
      const double gap = GapOf(passage_, key, before);
      const double now = GapOf(passage_, key, X_);
      const bool crosses =
          key.kind == ContactKind::kEdgeEdge ? (gap > 0) != (now > 0) : gap > 0 && now <= 0;
      if (crosses && Overlap(passage_, key, X_)) return key;
    }
    return std::nullopt;
  }

  const Passage& passage_;
  Pose X_;
};

struct ReplayOutcome {
  std::size_t motions = 0;  // motions that went as planned
  std::optional<ContactKey> made = {};
};

ReplayOutcome ReplayFrom(const Passage& passage, const FineMotionPlan& plan,
                         const GeneralizedPoint& error) {
  Pose believed = plan.X_StationaryStart;
  ExactReplay replay(passage, Displaced(believed, error));
  ReplayOutcome outcome;
  for (const CertainMotion& motion : plan.motions) {
    const double most = motion.command.until ? 1.05 * motion.check.longest : 1;
    outcome.made = replay.Move(motion.command, most, believed.translation());
    if (outcome.made != motion.command.until) return outcome;
    believed = motion.X_StationaryAfter;
    ++outcome.motions;
  }
  return outcome;
}

GeneralizedPoint RandomError(const FineMotionErrors& errors, RandomStream& random) {
  GeneralizedPoint z(kPoseDimensions);
  for (int i = 0; i < kPoseDimensions; ++i) {
    z[i] = errors.pose[i] * std::clamp(random.Uniform(-2, 2), -1.0, 1.0);
  }
  return z;
}

TEST(SearchStrategy, ContactsComeInThePlannedOrderInExactGeometry) {
  const Passage passage = SquarePegInHole();
  RandomStream random(kSeed, "replay");
  for (int sample = 0; sample < 40; ++sample) {
    const GeneralizedPoint error = RandomError(ErrorsOf(2e-3, kDegree), random);
    const ReplayOutcome outcome = ReplayFrom(passage, WidePlan(), error);
    EXPECT_EQ(outcome.motions, WidePlan().motions.size()) << "sample " << sample;
  }
}

// --- Matings of scenarios, with the errors of the scenarios.

struct ScenarioMating {
  const char* scenario;
  int critical_points;  // points where something enters, without the landing of the plate
};

class ScenarioMatings : public testing::TestWithParam<ScenarioMating> {
 protected:
  struct Planned {
    MatingGeometry geometry;
    FineMotionErrors errors;
    FineMotionPlan plan = {};
  };
  // Returns the plan of the scenario, which is searched once.
  static const Planned& Mating() {
    static std::map<std::string, Planned> known;
    const auto [found, is_new] = known.try_emplace(GetParam().scenario);
    if (is_new) found->second = PlannedFor(GetParam().scenario);
    return found->second;
  }
  static Planned PlannedFor(const std::string& scenario) {
    const domain::Problem problem =
        domain::ReadProblem(Document::Load(domain::ScenarioPath(scenario)), domain::ModelsFolder());
    Planned planned{
        .geometry = GeometryOf(problem, problem.matings.front()),
        .errors = ErrorsOf(problem.mating_errors.displacement, problem.mating_errors.rotation)};
    planned.plan = SearchStrategy(planned.geometry.passage, planned.errors, OptionsOf(1));
    return planned;
  }
};

TEST_P(ScenarioMatings, AreOneStrategyThroughAllCriticalPointsInExactGeometry) {
  const auto& [geometry, errors, plan] = Mating();
  const Passage& passage = geometry.passage;
  ASSERT_EQ(passage.critical_points(), GetParam().critical_points);
  ASSERT_TRUE(plan.found());
  EXPECT_EQ(std::ranges::count(plan.maneuvers, Maneuver::Kind::kAdvance, &Maneuver::kind),
            GetParam().critical_points - 1);
  const Vector3 end = plan.motions.back().X_StationaryAfter.translation();
  const double deep = (end - passage.X_StationaryEntry.translation()).dot(passage.mating);
  EXPECT_GT(deep, (passage.further.empty() ? 0 : passage.further.back()) - 0.01);
  RandomStream random(kSeed, "replay");
  for (int sample = 0; sample < 10; ++sample) {
    const ReplayOutcome outcome = ReplayFrom(passage, plan, RandomError(errors, random));
    EXPECT_EQ(outcome.motions, plan.motions.size()) << "sample " << sample;
  }
}

// The narrow shaft enters at the bottom of the wide hole.
TEST_P(ScenarioMatings, TheStartIsReachedStraightFromOutside) {
  const auto& [geometry, errors, plan] = Mating();
  constexpr double kOutside = 0.06;  // metres
  PoseChange in = PoseChange::Zero();
  in.head<3>() = kOutside * geometry.passage.mating;
  RandomStream random(kSeed, "approach");
  for (int sample = 0; sample < 10; ++sample) {
    const Pose start = Displaced(plan.X_StationaryStart, RandomError(errors, random));
    ExactReplay replay(geometry.passage, Displaced(start, -in));
    EXPECT_EQ(replay.Move({in, {}, {}}, 1, start.translation()), std::nullopt);
  }
}

INSTANTIATE_TEST_SUITE_P(Matings, ScenarioMatings,
                         testing::Values(ScenarioMating{"mate-stepped", 2},
                                         ScenarioMating{"mate-t-slot", 2},
                                         ScenarioMating{"mate-keyed", 1},
                                         ScenarioMating{"mate-octagonal", 1}),
                         [](const auto& test) {
                           std::string name = test.param.scenario;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace assay::finemotion::strategy_search_test
