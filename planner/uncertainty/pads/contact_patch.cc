#include "planner/uncertainty/pads/contact_patch.h"

#include <algorithm>
#include <cmath>

#include "planner/domain/grasps/round_side.h"
#include "planner/geometry/polygon.h"

namespace assay::uncertainty {
namespace {

using geometry::Patches;
using geometry::Polygon;
using geometry::Pose;
using geometry::Vector3;

constexpr double kOnFace = 1e-5;    // metres
constexpr double kSameFace = 1e-6;  // 1 - cosine
constexpr double kRim = 1e-6;       // metres: pads that stick out by less lie on their faces

// Returns the patches of a face in the tool's x and z.
Patches InTool(const domain::Face& face, const plan::Hold& hold) {
  const Pose X_ToolFace = hold.X_PartTool.inverse() * face.X_PartFace;
  Patches seen;
  for (const Polygon& patch : face.patches) {
    std::vector<Vector2> corners;
    for (const Vector2& p : patch) {
      const Vector3 corner = X_ToolFace * Vector3(p.x(), p.y(), 0);
      corners.emplace_back(corner.x(), corner.z());
    }
    seen.push_back(geometry::Hull2(corners));
  }
  return seen;
}

Polygon RectangleOf(const Vector2& half) {
  return {-half, Vector2(half.x(), -half.y()), half, Vector2(-half.x(), half.y())};
}

}  // namespace

const domain::Face* FaceAt(const domain::PartModel& model, const plan::Hold& hold, double side) {
  const Vector3 normal = side * hold.X_PartTool.linear().col(1);
  const double offset = normal.dot(hold.X_PartTool.translation()) + hold.width / 2;
  const auto is_it = [&](const domain::Face& face) {
    return face.normal.dot(normal) > 1 - kSameFace && std::abs(face.offset - offset) < kOnFace;
  };
  const auto found = std::ranges::find_if(model.faces(), is_it);
  return found == model.faces().end() ? nullptr : &*found;
}

Polygon OnFaceOf(const domain::Face& face, const plan::Hold& hold, double side,
                 const Vector2& middle, const Vector2& half) {
  const Pose X_FaceTool = face.X_PartFace.inverse() * hold.X_PartTool;
  std::vector<Vector2> corners;
  for (const double x : {-half.x(), half.x()}) {
    for (const double z : {-half.y(), half.y()}) {
      const Vector3 corner(middle.x() + x, side * hold.width / 2, middle.y() + z);
      corners.push_back((X_FaceTool * corner).head<2>());
    }
  }
  return geometry::Hull2(corners);
}

bool LieOnFaces(const domain::PartModel& model, const plan::Hold& hold, const Vector2& pad) {
  return std::ranges::all_of(std::initializer_list<double>{1, -1}, [&](double side) {
    const domain::Face* face = FaceAt(model, hold, side);
    return face != nullptr &&
           face->Covers(OnFaceOf(*face, hold, side, Vector2::Zero(), pad.array() - kRim));
  });
}

Patches TouchedPatch(const domain::PartModel& model, const plan::Hold& hold, double side,
                     const Vector2& within) {
  const domain::Face* face = FaceAt(model, hold, side);
  if (face == nullptr) return {};
  return geometry::Common(InTool(*face, hold), {RectangleOf(within)});
}

Patches OppositePatch(const domain::PartModel& model, const plan::Hold& hold,
                      const Vector2& within) {
  const domain::Face* left = FaceAt(model, hold, 1);
  const domain::Face* right = FaceAt(model, hold, -1);
  if (left == nullptr || right == nullptr || !(within.minCoeff() > 0)) return {};
  return geometry::Common(geometry::Common(InTool(*left, hold), InTool(*right, hold)),
                          {RectangleOf(within)});
}

Eigen::AlignedBox2d BoundsOf(const Patches& patches) {
  Eigen::AlignedBox2d bounds;
  for (const Polygon& patch : patches) {
    for (const Vector2& p : patch) bounds.extend(p);
  }
  return bounds;
}

std::optional<double> RoundAboutApproach(const domain::PartModel& model, const plan::Hold& hold,
                                         const Vector2& pad, double reach) {
  const auto side = domain::RoundSideAbout(model, hold.X_PartTool, hold.width / 2);
  const Patches patch = OppositePatch(model, hold, pad);
  if (!side || patch.empty()) return std::nullopt;
  const Eigen::AlignedBox2d bounds = BoundsOf(patch);
  const Interval heights = {bounds.min().y(), bounds.max().y()};
  const bool is_whole = domain::IsRoundBetween(model, *side, heights) &&
                        domain::IsInsideCircle(model, *side, {-reach, reach});
  return is_whole ? std::optional(side->half_step) : std::nullopt;
}

}  // namespace assay::uncertainty
