#include "sim/render/insertion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/random.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"

namespace assay::render::insertion_test {
namespace {

using domain::PartId;

// Returns where the ray enters the convex piece, as a fraction of the ray's length, by clipping the
// ray at every facet. Infinity means that the ray does not meet the piece.
double Meets(const geometry::ConvexHull& piece, const Pose& X_WorldPart, const Vector3& from,
             const Vector3& ray) {
  const Vector3 p = X_WorldPart.inverse() * from;
  const Vector3 v = X_WorldPart.linear().transpose() * ray;
  double enter = 0;
  double leave = 1;
  for (const geometry::Facet& facet : piece.facets) {
    const double beyond = facet.normal.dot(p) - facet.offset;
    const double speed = facet.normal.dot(v);
    if (speed == 0 && beyond > 0) return std::numeric_limits<double>::infinity();
    if (speed < 0) enter = std::max(enter, -beyond / speed);
    if (speed > 0) leave = std::min(leave, -beyond / speed);
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

// The last mating of a scenario. The fixed part is on the table with its hole upward, and the held
// part is above it. The arm is at home, far from both.
struct Stage {
  domain::Problem problem;
  scene::Scene scene;
  const domain::Mating& mating;
  Insertion insertion;
  mujoco::Data data;
  Vector3 out;  // direction out of the hole, in the world frame

  Stage(const std::string& scenario, double yaw)
      : problem(
            domain::ReadProblem(Document::Load(ASSAY_SOURCE_DIR "/scenarios/" + scenario + ".yaml"),
                                ASSAY_SOURCE_DIR "/models")),
        scene(problem, {}),
        mating(problem.matings.back()),
        insertion(problem, scene, mating),
        data(scene.Start()),
        out(Vector3::UnitZ()) {
    Pose X_WorldFixed = geometry::Translation(0.6, 0, 0) * geometry::RotationZ(yaw);
    X_WorldFixed.rotate(
        Eigen::Quaterniond::FromTwoVectors(-mating.mating_vector, Vector3::UnitZ()));
    double lowest = 0;
    for (const Ball& corner : CornersOf(model(mating.fixed), X_WorldFixed)) {
      lowest = std::min(lowest, corner.center.z());
    }
    scene.SetPart(data, mating.fixed, geometry::Translation(0, 0, -lowest) * X_WorldFixed);
  }

  const domain::PartModel& model(PartId part) const { return *problem.part(part).model; }
  Pose PoseOf(PartId part) const { return scene.TruePose(data, part); }

  void Insert(double inserted) {
    scene.SetPart(data, mating.held,
                  geometry::Translation((insertion.depth() - inserted) * out) *
                      PoseOf(mating.fixed) * mating.X_FixedHeld);
    data.Forward();
  }

  double TopOf(PartId part) const {
    double top = 0;
    for (const Ball& corner : CornersOf(model(part), PoseOf(part))) {
      top = std::max(top, corner.center.z());
    }
    return top;
  }

  bool IsInside(const Vector3& point) const {
    for (const PartId part : {mating.held, mating.fixed}) {
      for (const geometry::ConvexHull& piece : model(part).pieces()) {
        if (Contains(piece, PoseOf(part).inverse() * point, 1e-3)) return true;
      }
    }
    return false;
  }

  // Returns whether the eye sees the point if only the pieces of both parts can hide it.
  bool IsSeen(const Vector3& point, const Vector3& eye) const {
    const Vector3 from = point + 1e-4 * (eye - point).normalized();
    for (const PartId part : {mating.held, mating.fixed}) {
      for (const geometry::ConvexHull& piece : model(part).pieces()) {
        if (Meets(piece, PoseOf(part), from, eye - from) <= 1) return false;
      }
    }
    return true;
  }
};

class InsertionTest : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Scenarios, InsertionTest,
                         testing::Values("spar-fig15", "keyed", "mate-t-slot", "mate-octagonal",
                                         "mate-stepped", "uncertain-squeezing"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase(name, '-');
                           return name;
                         });

// The depth of the insertion is the overlap in height of the upper and the lower part when mated.
// This holds whichever part has the hole.
TEST_P(InsertionTest, IsAsDeepAsThePartsReachIntoEachOther) {
  Stage stage(GetParam(), 0.4);
  stage.Insert(stage.insertion.depth());
  double bottom = 1;
  for (const Ball& corner :
       CornersOf(stage.model(stage.mating.held), stage.PoseOf(stage.mating.held))) {
    bottom = std::min(bottom, corner.center.z());
  }
  EXPECT_NEAR(stage.insertion.depth(), stage.TopOf(stage.mating.fixed) - bottom, 1e-6);
  for (const double inserted : {-0.05, 0.0, 0.01, stage.insertion.depth()}) {
    stage.Insert(inserted);
    EXPECT_NEAR(stage.insertion.Inserted(stage.data), inserted, 1e-9);
  }
}

// The oracle intersects exact rays with the parts' boxes. Before the insertion, nothing hides the
// mouth. Both parts are wholly in the picture, before the insertion and at the seat.
TEST_P(InsertionTest, TheMouthIsSeenAndThePartsAreInThePicture) {
  for (const double yaw : {0.0, 0.7, 2.0, -1.3}) {
    Stage stage(GetParam(), yaw);
    stage.Insert(-stage.insertion.gap() - 0.02);
    const Subject subject = stage.insertion.SubjectIn(stage.data);
    constexpr double kAspect = 4.0 / 3;
    const FreeCamera camera =
        CloseUp(subject, Sight(stage.data, stage.insertion.Moving()), kAspect);
    const Vector3 eye = camera.X_WorldCamera.translation();
    EXPECT_GT(eye.z(), 0.02);

    stage.Insert(-stage.insertion.gap());
    for (const domain::ShaftFit& fit : domain::FitsOf(stage.problem, stage.mating)) {
      if (!fit.shaft_is_held) continue;  // the mouth of a sleeve looks down
      const Pose X_WorldHole = stage.PoseOf(stage.mating.fixed);
      const double top = stage.TopOf(stage.mating.fixed);
      for (const domain::Mouth& mouth : fit.hole.mouths) {
        const domain::Face& face = fit.hole_model.faces()[mouth.face.index()];
        // The face is on the side where a slot is open.
        if ((X_WorldHole.linear() * face.normal).z() < 0.9) continue;
        // The face is inside of the part.
        if ((X_WorldHole * face.X_PartFace).translation().z() < top - 1e-6) continue;
        for (const geometry::Vector2& p : mouth.outline) {
          const Vector3 corner = X_WorldHole * face.X_PartFace * Vector3(p.x(), p.y(), 0);
          EXPECT_TRUE(stage.IsSeen(corner, eye)) << yaw << ": " << corner.transpose();
        }
      }
    }
    for (const double inserted : {-stage.insertion.gap(), stage.insertion.depth()}) {
      stage.Insert(inserted);
      for (const PartId part : {stage.mating.held, stage.mating.fixed}) {
        for (const geometry::ConvexHull& piece : stage.model(part).pieces()) {
          for (const Vector3& vertex : piece.vertices) {
            const Vector3 p = camera.X_WorldCamera.inverse() * stage.PoseOf(part) * vertex;
            const double half = -p.z() * std::tan(camera.vertical_angle / 2);
            EXPECT_LT(std::abs(p.x()), kAspect * half) << yaw;
            EXPECT_LT(std::abs(p.y()), half) << yaw;
          }
        }
      }
    }
  }
}

// The rays are near the parts and far from the arm. They may be hidden by the boxes of the parts or
// by the table. A moved part hides what is behind its new pose.
TEST_P(InsertionTest, SightKnowsWhatPartsAndTableHide) {
  RandomStream random(1, GetParam());
  Stage before(GetParam(), 0.4);
  Stage after(GetParam(), 0.4);
  before.Insert(-0.01);
  after.Insert(0.02);
  const Sight sight(before.data, before.insertion.Moving());
  const Vector3 moved = -0.03 * before.out;
  int seen = 0;
  constexpr int kRays = 2000;
  for (int i = 0; i < kRays; ++i) {
    const auto near = [&](double low) {
      return Vector3(0.6 + random.Uniform(-0.12, 0.12), random.Uniform(-0.12, 0.12),
                     random.Uniform(low, 0.15));
    };
    Vector3 point = near(-0.02);
    while (std::abs(point.z()) < 1e-3) point = near(-0.02);  // neither in the table nor touching it
    Vector3 eye = near(0.001);
    while (before.IsInside(eye) || after.IsInside(eye)) eye = near(0.001);
    const bool above = point.z() > 0;  // the eye is always above
    const bool is_seen = above && before.IsSeen(point, eye);
    EXPECT_EQ(sight.Sees(eye, point), is_seen) << i;
    EXPECT_EQ(sight.Sees(eye, point, moved), above && after.IsSeen(point, eye)) << i;
    seen += is_seen ? 1 : 0;
  }
  EXPECT_GT(seen, kRays / 10);
  EXPECT_LT(seen, kRays * 9 / 10);
}

}  // namespace
}  // namespace assay::render::insertion_test
