#include "planner/mesh_import/parts/body_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "planner/geometry/hull.h"
#include "planner/mesh_import/decomposition/concave_planes.h"
#include "planner/mesh_import/decomposition/convex_decomposition.h"
#include "planner/mesh_import/decomposition/piece_distance.h"
#include "planner/mesh_import/repair/shells.h"
#include "planner/mesh_import/sections/common_axis.h"
#include "planner/mesh_import/sections/extrusion_axis.h"
#include "planner/mesh_import/sections/stack_distance.h"
#include "planner/mesh_import/sections/stepped_columns.h"

namespace assay::mesh_import {
namespace {

constexpr double kTolerance = 1e-4;      // share of the size that counts as rounding
constexpr double kMostLeftOut = 0.008;   // share of the size, at rounded corners
constexpr double kMostStep = 0.007;      // share of the size, of steps in place of slants
constexpr double kMostVolumeOff = 0.05;  // share of the volume
constexpr double kDeepest = 0.005;       // share of the size: pieces are cut until they fit
constexpr std::size_t kMostPosts = 60;
constexpr std::size_t kFewPosts = 6;  // a stack of more may be simpler as a convex piece
constexpr int kConvexPoints = 200;
// Limits of splitting a body into stacks: the number of cuts one after the other, and the number of
// tries in all.
constexpr int kDeepestSplit = 3;
// A body with many triangles has fewer tries, because each takes longer.
constexpr int kMostTriesToSplit = 60;
constexpr int kTrianglesToTry = 120'000;
constexpr double kPlaneTolerance = 5e-5;  // share of the size
constexpr double kLeastPart = 1e-6;       // share of the volume of a part that counts
constexpr std::size_t kMostToDecompose = 100'000;

// A stack that was found along one axis, or the reason why there is none.
struct Attempt {
  BodyShape shape;
  double length = 0;  // along the axis
};

// How a body is cut into columns.
using Cut = Columns (*)(const TriangleMesh&, const ColumnRules&);

Attempt TryAxis(const TriangleMesh& body, const Vector3& axis, Cut cut) {
  Attempt attempt;
  BodyShape& shape = attempt.shape;
  shape.R_FileLocal = FrameOfExtrusion(body, axis);
  const TriangleMesh local = body.Transformed(shape.R_FileLocal.transpose());
  const double size = body.Size();
  const ColumnRules rules = {.tolerance = kTolerance * size,
                             .most_left_out = kMostLeftOut * size,
                             .most_step = kMostStep * size};
  attempt.length = local.Bounds().sizes().z();
  const auto at = [&](int triangle) {
    const Triangle& found = body.triangles[static_cast<std::size_t>(triangle)];
    return found.line > 0 ? fmt::format("triangle {} (line {})", found.number, found.line)
                          : fmt::format("triangle {}", found.number);
  };
  Columns columns = cut(local, rules);
  if (!columns.reason.empty()) {
    shape.reason = fmt::format("{} (at {})", columns.reason, at(columns.triangle));
    return attempt;
  }
  GiveCommonAxes(columns.columns, rules.tolerance);
  shape.stack = StackOf(columns.columns, rules);
  shape.reason = shape.stack.reason;
  if (shape.reason.empty() && shape.stack.Count() > kMostPosts)
    shape.reason = fmt::format("it would have {} solids and pockets", shape.stack.Count());
  if (!shape.reason.empty()) return attempt;
  const StackDistance off = DistanceBetween(local, shape.stack, rules.tolerance);
  shape.distance = off.distance;
  shape.volume_share = off.volume_share;
  if (off.distance > kMostDistance * size) {
    shape.reason = fmt::format("{} would be {:.3g} mm off, more than {:.3g} mm (1 % of the size)",
                               at(off.triangle), off.distance * 1e3, kMostDistance * size * 1e3);
  } else if (std::abs(off.volume_share) > kMostVolumeOff) {
    shape.reason = fmt::format("its volume would be {:.3g} % off", 100 * off.volume_share);
  }
  shape.is_stack = shape.reason.empty();
  return attempt;
}

bool IsBetter(const Attempt& a, const Attempt& b, double size) {
  if (a.shape.is_stack != b.shape.is_stack) return a.shape.is_stack;
  if (!a.shape.is_stack) return false;
  if (a.shape.stack.Cost() != b.shape.stack.Cost())
    return a.shape.stack.Cost() < b.shape.stack.Cost();
  return a.length > b.length + kTolerance * size;
}

BodyShape BestStack(const TriangleMesh& body, Cut cut) {
  std::optional<Attempt> best;
  for (const Vector3& axis : ExtrusionAxes(body)) {
    Attempt attempt = TryAxis(body, axis, cut);
    if (!best || IsBetter(attempt, *best, body.Size())) best = std::move(attempt);
  }
  if (!best) best = Attempt{.shape = {.reason = "no direction lies along its sides"}};
  best->shape.triangles = static_cast<int>(body.triangles.size());
  best->shape.volume = body.Volume();
  best->shape.centroid = body.CenterOfVolume();
  return std::move(best->shape);
}

// Returns whether a body is convex, but for what one piece may be off.
bool IsNearlyConvex(const TriangleMesh& body) {
  const std::optional<geometry::ConvexHull> hull = HullOfExtremes(body.vertices, kConvexPoints);
  return hull && DepthOf(body, *hull) <= kDeepest * body.Size();
}

// Cuts a body into stacks by planes through its concave edges.
class StackSplitter {
 public:
  explicit StackSplitter(const TriangleMesh& body)
      : least_volume_(kLeastPart * body.Volume()),
        tolerance_(kPlaneTolerance * body.Size()),
        tries_(std::min(kMostTriesToSplit,
                        kTrianglesToTry / static_cast<int>(body.triangles.size()))) {}

  // Returns stacks whose union is the body, or none.
  std::vector<BodyShape> Split(const TriangleMesh& body, int depth) {
    for (CutPlane plane : ConcavePlanesOf(body)) {
      plane.tolerance = tolerance_;
      const auto [below, above] = CutBy(body, plane);
      if (below.triangles.empty() || above.triangles.empty()) continue;
      std::vector<BodyShape> stacks;
      if (AddStacks(below, depth, stacks) && AddStacks(above, depth, stacks)) return stacks;
    }
    return {};
  }

 private:
  bool AddStacks(const TriangleMesh& mesh, int depth, std::vector<BodyShape>& stacks) {
    for (const TriangleMesh& part : ShellsOf(mesh)) {
      if (part.Volume() <= least_volume_) continue;
      if (--tries_ < 0) return false;
      BodyShape shape = BestStack(part, ColumnsOf);
      if (shape.is_stack) {
        stacks.push_back(std::move(shape));
        continue;
      }
      std::vector<BodyShape> split = depth > 1 ? Split(part, depth - 1) : std::vector<BodyShape>();
      if (split.empty()) return false;
      std::ranges::move(split, std::back_inserter(stacks));
    }
    return true;
  }

  const double least_volume_;
  const double tolerance_;
  int tries_;
};

}  // namespace

std::vector<BodyShape> ShapesOf(const TriangleMesh& body) {
  BodyShape shape = BestStack(body, ColumnsOf);
  const auto is_simple = [](const BodyShape& of) {
    return of.is_stack && of.stack.Count() <= kFewPosts;
  };
  // A body that is nearly convex, such as a ball, becomes one convex piece. As a stack it would
  // have many layers.
  const bool is_convex = !is_simple(shape) && IsNearlyConvex(body);
  if (is_convex && shape.is_stack) {
    shape.is_stack = false;
    shape.reason = fmt::format("as a stack it would have {} solids", shape.stack.Count());
  }
  if (shape.is_stack) return {std::move(shape)};
  if (body.triangles.size() > kMostToDecompose) {
    Refuse(body, body.triangles.front(),
           fmt::format("this belongs to a body of {} triangles that is no stack of extrusions: {}",
                       body.triangles.size(), shape.reason),
           fmt::format("at most {} triangles in such a body", kMostToDecompose));
  }
  std::vector<BodyShape> stacks;
  if (!is_convex) stacks = StackSplitter(body).Split(body, kDeepestSplit);
  if (!stacks.empty()) {
    std::ranges::stable_sort(stacks, std::ranges::greater(), &BodyShape::volume);
    return stacks;
  }
  BodyShape stepped = BestStack(body, SteppedColumnsOf);
  if (stepped.is_stack && (!is_convex || is_simple(stepped))) return {std::move(stepped)};
  if (!is_convex) shape.reason += "; as steps, " + stepped.reason;
  Decomposition decomposition = Decompose(body, {.depth = kDeepest * body.Size()});
  shape.R_FileLocal = Matrix3::Identity();
  shape.stack = {};
  shape.pieces = std::move(decomposition.pieces);
  shape.distance = decomposition.distance;
  shape.volume_share = decomposition.volume_share;
  return {std::move(shape)};
}

}  // namespace assay::mesh_import
