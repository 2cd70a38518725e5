#include "planner/motion/collision/swept_volume.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/base/check.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::motion {
namespace {

using geometry::RoundedHull;

RoundedHull Merged(const RoundedHull& a, const RoundedHull& b) {
  std::vector<Vector3> points = a.vertices();
  points.insert(points.end(), b.vertices().begin(), b.vertices().end());
  return RoundedHull(points, std::max(a.radius(), b.radius()));
}

// Collects the steps of one hull of a body.
class Sweep {
 public:
  Sweep(BodyId body, double added_volume, std::vector<SweptPiece>& pieces)
      : body_(body), added_volume_(added_volume), pieces_(pieces) {}

  void Add(const RoundedHull& step) {
    const double volume = Volume(step.core());
    if (open_) {
      RoundedHull merged = Merged(*open_, step);
      const double together = open_volume_ + volume;
      if (Volume(merged.core()) <= (1 + added_volume_) * together) {
        open_ = std::move(merged);
        open_volume_ = together;
        return;
      }
    }
    Finish();
    open_ = step;
    open_volume_ = volume;
  }

  void Finish() {
    if (open_) pieces_.push_back({body_, *std::move(open_)});
    open_.reset();
  }

 private:
  BodyId body_;
  double added_volume_;
  std::vector<SweptPiece>& pieces_;
  std::optional<RoundedHull> open_;
  double open_volume_ = 0;  // sum over the steps in it, with overlaps counted twice
};

// Returns the path in steps that are short enough for one body.
JointPath Steps(const Body& body, const JointPath& path, double sagitta) {
  JointPath steps = {path.front()};
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const JointVector way = path[i + 1] - path[i];
    const double shares = std::sqrt(SagittaBound(body, way.cwiseAbs()) / sagitta);
    const int count = std::max(1, static_cast<int>(std::ceil(shares)));
    for (int k = 1; k <= count; ++k)
      steps.push_back(path[i] + static_cast<double>(k) / count * way);
  }
  // If the arm stands still, there is one step of length 0.
  if (steps.size() == 1) steps.push_back(steps.front());
  return steps;
}

RoundedHull BetweenPoses(const RoundedHull& hull, const Pose& X_WorldStart, const Pose& X_WorldEnd,
                         double growth) {
  std::vector<Vector3> points;
  for (const Vector3& vertex : hull.vertices()) {
    points.push_back(X_WorldStart * vertex);
    points.push_back(X_WorldEnd * vertex);
  }
  return RoundedHull(points, hull.radius() + growth);
}

void SweepBody(const CollisionScene& scene, BodyId id, const JointPath& path,
               const SweepAccuracy& accuracy, std::vector<SweptPiece>& pieces) {
  const Body& body = scene.body(id);
  const JointPath steps = Steps(body, path, accuracy.sagitta);
  std::vector<Pose> X_WorldLink;
  for (const JointVector& q : steps) {
    X_WorldLink.push_back(scene.workcell().X_WorldBase() * scene.arm().LinkPoses(q)[body.link]);
  }
  for (const RoundedHull& hull : body.hulls) {
    Sweep sweep(id, accuracy.added_volume, pieces);
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
      const double growth = SagittaBound(body, (steps[i + 1] - steps[i]).cwiseAbs());
      sweep.Add(BetweenPoses(hull, X_WorldLink[i], X_WorldLink[i + 1], growth));
    }
    sweep.Finish();
  }
}

}  // namespace

double SagittaBound(const Body& body, const JointVector& turn) {
  double acceleration = 0;
  for (int k = 0; k < body.link; ++k) {
    for (int l = 0; l < body.link; ++l) {
      acceleration += turn[k] * turn[l] * body.reach[static_cast<std::size_t>(std::max(k, l))];
    }
  }
  return acceleration / 8;
}

std::vector<SweptPiece> SweptVolume(const CollisionScene& scene, const JointPath& path,
                                    const SweepAccuracy& accuracy) {
  ASSAY_CHECK(!path.empty() && accuracy.sagitta > 0);
  std::vector<SweptPiece> pieces;
  for (std::size_t b = 0; b < scene.bodies().size(); ++b) {
    if (scene.bodies()[b].link > 0) SweepBody(scene, BodyId(b), path, accuracy, pieces);
  }
  return pieces;
}

std::optional<BodyPair> InTheWay(const CollisionScene& scene, const std::vector<SweptPiece>& pieces,
                                 double clearance) {
  const Pose& X_WorldBase = scene.workcell().X_WorldBase();
  for (const BodyPair& pair : scene.pairs()) {
    const Body& standing = scene.body(pair.first);
    if (standing.link > 0) continue;
    for (const SweptPiece& piece : pieces) {
      if (piece.body != pair.second) continue;
      const auto is_near = [&](const RoundedHull& hull) {
        return geometry::Separation(piece.hull, Pose::Identity(), hull, X_WorldBase, clearance) <
               clearance;
      };
      if (std::ranges::any_of(standing.hulls, is_near)) return pair;
    }
  }
  return std::nullopt;
}

}  // namespace assay::motion
