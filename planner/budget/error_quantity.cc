#include "planner/budget/error_quantity.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "planner/base/check.h"

namespace assay::budget {
namespace {

using domain::Dimension;

// The bounds of one quantity, in both directions.
using Visit = std::function<void(const std::string& name, Dimension dimension, Interval& bounds)>;

// Calls `visit` with each bound that is neither 0 nor infinite.
void VisitBound(const std::string& name, Dimension dimension, Interval& bounds,
                const Visit& visit) {
  const double greatest = std::max(std::abs(bounds.low), std::abs(bounds.high));
  if (greatest > 0 && std::isfinite(greatest)) visit(name, dimension, bounds);
}

// Calls `visit` for the coordinates of a pose. `Pose` is a PoseError or a SensorModel.
template <class Pose>
void VisitPose(const std::string& owner, Pose& error, const Visit& visit) {
  VisitBound(owner + ".x", Dimension::kLength, error.x, visit);
  VisitBound(owner + ".y", Dimension::kLength, error.y, visit);
  VisitBound(owner + ".z", Dimension::kLength, error.z, visit);
  VisitBound(owner + ".theta", Dimension::kAngle, error.theta, visit);
}

// A tolerance must be less than the value that it belongs to.
void VisitTolerance(const std::string& name, Dimension dimension, double value, double& tolerance,
                    const Visit& visit) {
  constexpr double kMost = 0.999;
  Interval bounds = {-tolerance, tolerance};
  VisitBound(name, dimension, bounds, visit);
  tolerance = std::min(bounds.high, kMost * value);
}

// Returns the least friction of surfaces that mate.
double LeastFriction(const domain::Problem& problem) {
  double least = problem.workcell->rules().friction;
  for (const domain::Part& part : problem.parts) least = std::min(least, part.model->friction());
  return least;
}

void VisitErrors(domain::Problem& problem, const Visit& visit) {
  for (domain::Part& part : problem.parts) VisitPose(part.name, part.error, visit);
  VisitPose("hand", problem.gripper_error, visit);
  std::vector<domain::SensorModel> sensors = problem.workcell->uncertainty_operations().sensors;
  for (domain::SensorModel& sensor : sensors) {
    if (std::ranges::count(problem.sensors, sensor.name) > 0) VisitPose(sensor.name, sensor, visit);
  }
  problem.workcell = problem.workcell->WithSensors(std::move(sensors));
  domain::Tolerances& tolerances = problem.tolerances;
  VisitTolerance("clearance", Dimension::kLength, problem.clearance, tolerances.clearance, visit);
  VisitTolerance("friction", Dimension::kRatio, LeastFriction(problem), tolerances.friction, visit);
  VisitTolerance("pad_friction", Dimension::kRatio, problem.workcell->rules().pad_friction,
                 tolerances.pad_friction, visit);
  Interval velocity = {0, problem.mating_errors.velocity};
  VisitBound("velocity", Dimension::kRatio, velocity, visit);
  problem.mating_errors.velocity = velocity.high;
}

}  // namespace

std::vector<ErrorQuantity> ErrorQuantitiesOf(const domain::Problem& problem) {
  std::vector<ErrorQuantity> quantities;
  domain::Problem copy = problem;
  VisitErrors(copy, [&](const std::string& name, Dimension dimension, Interval& bounds) {
    quantities.push_back({name, dimension, bounds});
  });
  return quantities;
}

domain::Problem WithBounds(const domain::Problem& problem, const std::vector<Interval>& bounds) {
  domain::Problem changed = problem;
  auto next = bounds.begin();
  VisitErrors(changed, [&](const std::string& name, Dimension, Interval& its) {
    ASSAY_CHECK(next != bounds.end(), "no bounds of {}", name);
    its = *next++;
  });
  return changed;
}

domain::Problem WithErrorsTimes(const domain::Problem& problem,
                                const std::vector<double>& multiples) {
  std::vector<Interval> bounds;
  for (const ErrorQuantity& quantity : ErrorQuantitiesOf(problem)) {
    const double multiple = multiples.at(bounds.size());
    bounds.push_back({multiple * quantity.bounds.low, multiple * quantity.bounds.high});
  }
  return WithBounds(problem, bounds);
}

domain::Problem WithErrorsTimes(const domain::Problem& problem, double multiple) {
  return WithErrorsTimes(problem, std::vector<double>(ErrorQuantitiesOf(problem).size(), multiple));
}

}  // namespace assay::budget
