#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/box.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "planner/kinematics/grippers/gripper.h"
#include "planner/plan/certificates/condition_table.h"
#include "sim/check/measurements/fit.h"
#include "sim/check/measurements/measurement.h"

namespace assay::check {
namespace {

using geometry::Box;
using geometry::CollisionShape;
using geometry::Pose;
using geometry::Vector3;

constexpr double kFlush = 1e-6;  // metres by which a face may stand out of its plane
constexpr int kPlaces = 16;      // points along a straight line

// Measures the distances of the hand from the parts in one step.
class HandDistances {
 public:
  explicit HandDistances(const MeasuredStep& step) : step_(step), problem_(step.problem()) {}

  // Returns the least distance of the hand from a part at the place where the hand acts, and at the
  // place where it was stopped on its way. The open hand is also measured along the straight line
  // to its work or from it.
  double From(std::size_t part) const {
    const StepEvents& events = step_.events();
    double nearest = kInfinity;
    for (const execution::Snapshot* snapshot : {events.reached, events.acted, events.stopped}) {
      if (snapshot == nullptr) continue;
      const bool is_held = domain::PartId(part) == step_.part();
      nearest = std::min(nearest, is_held ? BesidePads(*snapshot) : FromHand(part, *snapshot));
    }
    if (events.reached != nullptr) nearest = std::min(nearest, Opened(part, *events.reached));
    return nearest;
  }

 private:
  double FromHand(std::size_t part, const execution::Snapshot& at) const {
    return geometry::Distance(problem_.workcell->HandShape(step_.OpeningAt(at)), at.tool.truth,
                              problem_.parts[part].model->shape(), at.parts[part].truth);
  }

  // Returns the least distance of the open hand from the part along the straight line on which the
  // hand comes to its work or leaves it.
  double Opened(std::size_t part, const execution::Snapshot& at) const {
    const CollisionShape hand = problem_.workcell->HandShape(step_.gripper().max_opening());
    double nearest = kInfinity;
    for (int i = 0; i <= kPlaces; ++i) {
      const double back = problem_.workcell->rules().approach_distance * i / kPlaces;
      nearest = std::min(
          nearest, geometry::Distance(hand, at.tool.truth * geometry::Translation(0, 0, -back),
                                      problem_.parts[part].model->shape(), at.parts[part].truth));
    }
    return nearest;
  }

  // Returns the lesser of two distances. The first is the distance of the hand from the part
  // between its pads. The second is the least distance of a finger from pieces of that part; only
  // pieces that stand out of the plane in which the finger's pad should touch are measured.
  double BesidePads(const execution::Snapshot& at) const {
    const std::vector<Box> fingers = step_.gripper().FingerBoxes(step_.OpeningAt(at));
    double nearest = geometry::Distance(CollisionShape(step_.gripper().HandBoxes()), at.tool.truth,
                                        step_.shape(), step_.PartAt(at));
    for (const double side : {-1.0, 1.0}) {
      std::vector<Box> finger;
      std::ranges::copy_if(fingers, std::back_inserter(finger), [&](const Box& box) {
        return side * box.X_FrameBox.translation().y() > 0;
      });
      nearest =
          std::min(nearest, geometry::Distance(CollisionShape(finger), at.tool.truth,
                                               CollisionShape(BeyondPad(side)), step_.PartAt(at)));
    }
    return nearest;
  }

  std::vector<geometry::ConvexHull> BeyondPad(double side) const {
    const Pose& X_PartTool = step_.hold().X_PartTool;
    const Vector3 outward = side * X_PartTool.linear().col(1);
    std::vector<geometry::ConvexHull> beyond;
    for (const geometry::ConvexHull& piece : problem_.part(step_.part()).model->pieces()) {
      const double farthest = GreatestAlong(piece, outward) - outward.dot(X_PartTool.translation());
      if (farthest > step_.hold().width / 2 + kFlush) beyond.push_back(piece);
    }
    return beyond;
  }

  const MeasuredStep& step_;
  const domain::Problem& problem_;
};

// Hand and fingers touch no part, except the faces on which the pads close.
std::vector<MeasuredMargin> HandClear(const MeasuredStep& step) {
  const HandDistances distances(step);
  std::vector<MeasuredMargin> measured;
  for (std::size_t p = 0; p < step.problem().parts.size(); ++p) {
    AddClearance(fmt::format("the hand stays clear of {}", step.problem().parts[p].name),
                 distances.From(p), measured);
  }
  return measured;
}

}  // namespace

std::vector<Measurement> HandMeasurements() {
  return {{plan::condition::kHandClear, HandClear},
          {plan::condition::kHolding},
          {plan::condition::kReach},
          {plan::condition::kWayClear}};
}

}  // namespace assay::check
