#include "planner/uncertainty/standing/tilting.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <vector>

#include "planner/domain/parts/part_file.h"
#include "planner/domain/parts/part_model.h"
#include "tests/planner/uncertainty/part_on_table.h"
#include "tests/scratch_file.h"

namespace assay::uncertainty::tilting_test {
namespace {

// A block that is tilted about a corner of its lower side, so that nothing of it is below the
// table, moves the grasped point by no more than the bound. Some blocks use most of the bound.
TEST(MovedByTilt, BoundsTheWayAboutEachCornerOfTheSupport) {
  const domain::Problem problem = UprightBlock({});
  const UncertainWorld world(problem, Propagation::kSound);
  const Pose& X_WorldPart = world.X_WorldPart(kBlock);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(-1, 1);
  double most_of_bound = 0;
  for (int i = 0; i < 2000; ++i) {
    plan::Hold hold = HoldFromAbove(problem, Vector3::UnitY());
    hold.X_PartTool.rotate(Eigen::AngleAxisd(1.2 * share(random), Vector3::UnitY()));
    hold.X_PartTool.translation() += 0.03 * Vector3(share(random), share(random), share(random));
    const Pose X_WorldTool = X_WorldPart * hold.X_PartTool;
    const double tilt = 1e-3 * share(random);
    const Vector3 bound = MovedByTilt(world, kBlock, hold, std::abs(tilt), 0);
    const Vector3 axis =
        Vector3::UnitZ().cross(X_WorldTool.linear().col(2).cross(Vector3::UnitZ()));
    const Eigen::AngleAxisd turn(tilt, axis.normalized());
    for (const Vector3& corner : problem.part(kBlock).model->corners()) {
      const Vector3 about = X_WorldPart * corner;
      if (std::abs(about.z()) > 1e-9) continue;
      const auto moved = [&](const Vector3& p) -> Vector3 { return turn * (p - about) + about; };
      bool stands = true;
      for (const Vector3& other : problem.part(kBlock).model->corners())
        stands = stands && moved(X_WorldPart * other).z() > -1e-9;
      if (!stands) continue;
      const Vector3 grasped = X_WorldTool.translation();
      const Vector3 way = X_WorldTool.linear().transpose() * (moved(grasped) - grasped);
      EXPECT_TRUE((way.cwiseAbs().array() <= bound.array() * (1 + 1e-3) + 1e-9).all())
          << way.transpose() << " beyond " << bound.transpose();
      most_of_bound = std::max(most_of_bound, std::abs(way.x()) / bound.x());
    }
  }
  EXPECT_GT(most_of_bound, 0.9);
}

// Boxes in millimetres, which stand on z = 0. Those that stick out at a side give the part products
// of inertia.
struct Box {
  Vector3 low;
  Vector3 high;
};
const std::vector<Box> kWide = {{{-40, -40, 0}, {40, 40, 30}}, {{40, -10, 10}, {60, 30, 30}}};
const std::vector<std::vector<Box>> kRocking = {
    {{{-18, -17, 0}, {18, 17, 84}}},
    {{{-20, -20, 0}, {20, 20, 80}}, {{20, -10, 50}, {60, 30, 70}}},
    {{{-10, -14, 0}, {10, 14, 122}}, {{10, 0, 70}, {20, 14, 80}}}};

// Returns a problem with an upright part of these boxes.
domain::Problem Upright(const std::vector<Box>& boxes) {
  const auto file = ScratchFile("bar.yaml");
  std::ofstream text(file);
  text << "format: assay-part/1\nname: bar\ninitial: B\nunits: {length: mm, angle: degree}\n"
          "density: 700\nfriction: 0.3\nsolids:\n";
  const Eigen::IOFormat list(Eigen::FullPrecision, 0, ", ", ", ", "", "", "[", "]");
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    text << "  box" << i << ": {box: [" << boxes[i].low.format(list) << ", "
         << boxes[i].high.format(list) << "]}\n";
  }
  text << "features:\n  1: {face: box0, normal: +z, what: top}\n";
  text.close();
  domain::Problem problem = UprightBlock({});
  problem.parts[kBlock.index()].model = domain::PartFile::Load(file, 0.001);
  return problem;
}

// Returns the angular momentum about the vertical through a point, by a sum over small cubes.
double VerticalMomentum(const std::vector<Box>& boxes, const Vector3& point, const Vector3& omega) {
  constexpr double kSide = 2;  // mm
  double sum = 0;
  for (const Box& box : boxes) {
    for (double x = box.low.x() + kSide / 2; x < box.high.x(); x += kSide) {
      for (double y = box.low.y() + kSide / 2; y < box.high.y(); y += kSide) {
        for (double z = box.low.z() + kSide / 2; z < box.high.z(); z += kSide) {
          const Vector3 arm = 1e-3 * Vector3(x, y, z) - point;
          sum += arm.cross(omega.cross(arm)).z();
        }
      }
    }
  }
  return sum;
}

std::vector<Vector3> CornersBelow(const domain::PartModel& model) {
  std::vector<Vector3> corners;
  for (const Vector3& corner : model.corners()) {
    if (corner.z() < 1e-9) corners.push_back(corner);
  }
  return corners;
}

// Returns the greatest turn for each radian of a fall about any horizontal axis, without momentum
// about the vertical through the centre of mass or through a corner of the support.
double GreatestTurnOfFall(const std::vector<Box>& boxes, const domain::PartModel& model) {
  std::vector<Vector3> points = CornersBelow(model);
  points.push_back(model.mass().center);
  double most = 0;
  for (const Vector3& point : points) {
    const double by_spin = VerticalMomentum(boxes, point, Vector3::UnitZ());
    for (double axis = 0; axis < 3.15; axis += 0.1) {
      const Vector3 omega(std::cos(axis), std::sin(axis), 0);
      most = std::max(most, std::abs(VerticalMomentum(boxes, point, omega) / by_spin));
    }
  }
  return most;
}

// A wide part comes to rest on its support as it strikes it.
TEST(FallOf, KeepsTheMomentumAboutTheVerticalAtZero) {
  const domain::Problem problem = Upright(kWide);
  const UncertainWorld world(problem, Propagation::kSound);
  const double most = GreatestTurnOfFall(kWide, *problem.part(kBlock).model);
  EXPECT_NEAR(FallOf(world, kBlock, Pose::Identity()).turn, most, 0.01 * most);
}

// A rigid part with small motions on points, simulated by impulses: each point that goes down into
// the table is stopped, without restitution and with Coulomb friction.
class NaiveRocking {
 public:
  NaiveRocking(const domain::PartModel& model, double friction, const Vector3& lean)
      : mass_(model.mass().mass),
        inverse_(model.mass().inertia.inverse()),
        friction_(friction),
        turned_(lean) {
    for (const Vector3& corner : CornersBelow(model)) {
      const Vector3 at = corner - model.mass().center;
      height_ = std::max(height_, -lean.cross(at).z());
      geometry::Matrix3 across;
      across << 0, -at.z(), at.y(), at.z(), 0, -at.x(), -at.y(), at.x(), 0;
      points_.push_back(
          {at, (geometry::Matrix3::Identity() / mass_ - across * inverse_ * across).inverse()});
    }
  }

  void Step(double time) {
    velocity_.z() -= 9.81 * time;
    for (Point& point : points_) point.impulse.setZero();
    for (int round = 0; round < 15; ++round) {
      for (Point& point : points_) {
        if (height_ + turned_.cross(point.at).z() < 1e-8) Stop(point);
      }
    }
    turned_ += time * spin_;
    height_ += time * velocity_.z();
  }

  double turn() const { return std::abs(turned_.z()); }

 private:
  struct Point {
    Vector3 at;  // from the centre of mass
    geometry::Matrix3 inertia;
    Vector3 impulse = Vector3::Zero();
  };

  void Stop(Point& point) {
    Vector3 now = point.impulse - point.inertia * (velocity_ + spin_.cross(point.at));
    if (now.z() < 0) now.setZero();
    const double slip = now.head<2>().norm() / std::max(friction_ * now.z(), 1e-300);
    if (slip > 1) now.head<2>() /= slip;
    velocity_ += (now - point.impulse) / mass_;
    spin_ += inverse_ * point.at.cross(now - point.impulse);
    point.impulse = now;
  }

  double mass_;
  geometry::Matrix3 inverse_;
  double friction_;
  std::vector<Point> points_;
  Vector3 turned_;
  double height_ = 0;  // of the centre of mass, above where it is if the part stands
  Vector3 velocity_ = Vector3::Zero();
  Vector3 spin_ = Vector3::Zero();
};

// Tall parts that are let go as they lean in any direction rock from side to side. They turn by
// no more than the bound. One of them turns farther than by the fall alone.
TEST(FallOf, BoundsTheTurnOfARockingPart) {
  constexpr double kLean = 1e-3;
  double farther = 0;
  for (const std::vector<Box>& boxes : kRocking) {
    const domain::Problem problem = Upright(boxes);
    const UncertainWorld world(problem, Propagation::kSound);
    const domain::PartModel& model = *problem.part(kBlock).model;
    const double bound = FallOf(world, kBlock, Pose::Identity()).turn;
    double most = 0;
    for (const double friction : {0.1, 0.15}) {
      for (double axis = 0.13; axis < 6.28; axis += 0.4) {
        NaiveRocking part(model, friction, kLean * Vector3(std::cos(axis), std::sin(axis), 0));
        for (int step = 0; step < 10'000; ++step) {
          part.Step(5e-5);
          most = std::max(most, part.turn() / kLean);
        }
      }
    }
    EXPECT_LT(most, bound);
    farther = std::max(farther, most / GreatestTurnOfFall(boxes, model));
  }
  EXPECT_GT(farther, 1.2);
}

}  // namespace
}  // namespace assay::uncertainty::tilting_test
