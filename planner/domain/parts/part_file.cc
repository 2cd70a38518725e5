#include "planner/domain/parts/part_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "planner/base/check.h"
#include "planner/domain/parts/exposed_faces.h"
#include "planner/domain/problem/name.h"
#include "planner/domain/resting/compute_stable_poses.h"
#include "planner/geometry/planar_region.h"

namespace assay::domain {
namespace {

using geometry::Box;

// Poses that stand more precariously are left out: a part that is put down with a few millimetres
// of error must not fall over.
constexpr double kLeastTilt = 2 * kDegrees.factor;
// Greatest angle between a direction and the down direction of the pose that it names, radians.
constexpr double kFarthestName = 30 * kDegrees.factor;
constexpr double kAligned = 1e-6;       // greatest difference of unit vectors that should be equal
constexpr Range kChamfers = {0, 0.02};  // metres

std::string ReadInitial(const Value& value) {
  std::string initial = value.Text();
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  if (initial.empty() || initial.size() > 3 || !std::ranges::all_of(initial, is_capital)) {
    value.Fail(fmt::format("'{}' cannot begin a label", initial), "one to three capital letters");
  }
  return initial;
}

// Returns the index in SidesOf of the side that looks along a direction; -1 if no side does.
int SideTowards(const Box& box, const Vector3& direction) {
  const std::array<Side, 6> sides = SidesOf(box);
  const auto found = std::ranges::find_if(
      sides, [&](const Side& s) { return (s.normal - direction).norm() < kAligned; });
  return found == sides.end() ? -1 : static_cast<int>(found - sides.begin());
}

int ReadSide(const Value& direction, const Box& box, const std::string& solid) {
  const int side = SideTowards(box, ReadDirection(direction));
  if (side < 0) {
    direction.Fail(fmt::format("solid '{}' has no side that looks this way", solid),
                   "a vector along one of the solid's edges");
  }
  return side;
}

// Returns the exposed face that a side of a box is part of; None if the side is covered.
FaceId ExposedFaceOf(const PartModel& model, const Side& side) {
  const FaceId id = FindFace(model.faces(), side.normal, side.offset);
  if (id.IsNone()) return id;
  const Face& face = model.faces()[id.index()];
  return geometry::Meets(face.patches, OnFace(face, side.corners)) ? id : FaceId::None();
}

Vector3 CentroidOf(const Face& face) {
  const Vector2 center = geometry::Centroid(face.patches);
  return face.X_PartFace * Vector3(center.x(), center.y(), 0);
}

// Returns the part of a pocket that is inside its solid. Both are before the solid's turn, and so
// aligned with the axes.
Box Clipped(const Box& pocket, const Box& solid) {
  const auto low = [](const Box& b) -> Vector3 {
    return b.X_FrameBox.translation() - b.half_extents;
  };
  const auto high = [](const Box& b) -> Vector3 {
    return b.X_FrameBox.translation() + b.half_extents;
  };
  return Box::FromCorners(low(pocket).cwiseMax(low(solid)), high(pocket).cwiseMin(high(solid)));
}

// A pocket and the solid that it is cut from, in the part frame.
struct Hollow {
  Box solid;                       // the solid before pockets are cut
  Box pocket;                      // the pocket, widened by the clearance
  Box clipped;                     // the part of the pocket in the solid
  std::array<bool, 3> is_widened;  // along the pocket's own axes
};

// Returns the face in which a pocket ends, on the side of its solid that looks in a direction.
// Returns None if the pocket does not reach that side, or if the pockets leave nothing of this
// side.
FaceId EndOf(const PartModel& model, const Hollow& hollow, const Vector3& direction) {
  const int towards = SideTowards(hollow.solid, direction);
  if (towards < 0) return FaceId::None();
  const Side border = SidesOf(hollow.solid)[static_cast<std::size_t>(towards)];
  const Side end = SidesOf(hollow.clipped)[static_cast<std::size_t>(towards)];
  if (end.offset < border.offset - kRounding) return FaceId::None();
  return FindFace(model.faces(), border.normal, border.offset);
}

// Returns where the first pocket opens in a direction, if the other pockets leave it open. Returns
// none if they do not all end in one plane, or if the mouth is covered.
std::optional<Mouth> FindMouth(const PartModel& model, std::span<const Hollow> hollows,
                               const Vector3& direction) {
  const Hollow& first = hollows.front();
  const FaceId id = EndOf(model, first, direction);
  if (id.IsNone()) return std::nullopt;
  const Face& face = model.faces()[id.index()];
  const auto end = [&](const Box& pocket) {
    const auto side = static_cast<std::size_t>(SideTowards(pocket, direction));
    return OnFace(face, SidesOf(pocket)[side].corners);
  };
  geometry::Polygon outline = end(first.clipped);
  for (const Hollow& other : hollows.subspan(1)) {
    if (EndOf(model, other, direction) != id) return std::nullopt;
    outline = geometry::Intersection(outline, end(other.pocket));
  }
  if (outline.empty() || !IsOpen(face, outline, model.boxes())) return std::nullopt;
  return Mouth{id, std::move(outline)};
}

// Returns the exposed sides of a pocket, seen from within it. A side that is not clipped moves with
// the clearance if its axis is widened.
std::vector<Wall> WallsOf(const PartModel& model, const Hollow& hollow) {
  const std::array<Side, 6> whole = SidesOf(hollow.pocket);
  const std::array<Side, 6> sides = SidesOf(hollow.clipped);
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    Side side = sides[i];
    const bool is_own = std::abs(whole[i].offset - side.offset) < kRounding;
    side.normal = -side.normal;
    side.offset = -side.offset;
    const FaceId id = ExposedFaceOf(model, side);
    if (id.IsNone()) continue;
    walls.push_back(
        {id, OnFace(model.faces()[id.index()], side.corners), is_own && hollow.is_widened[i / 2]});
  }
  return walls;
}

StablePoseId NearestTo(const std::vector<StablePose>& poses, const Vector3& direction) {
  const auto likeness = [&](const StablePose& pose) {
    return -direction.dot(pose.X_TablePart.linear().row(2).transpose());
  };
  const auto nearest = std::ranges::max_element(poses, {}, likeness);
  if (nearest == poses.end() || likeness(*nearest) < std::cos(kFarthestName)) return {};
  return StablePoseId(static_cast<std::size_t>(nearest - poses.begin()));
}

// Gives names to poses. `names` is a map from each name to the direction, in the part frame, that
// points down.
void NameStablePoses(const Value& names, std::vector<StablePose>& poses) {
  for (const auto& [key, direction] : names.Entries()) {
    const std::string name = ReadAnyName(key);
    const StablePoseId id = NearestTo(poses, ReadDirection(direction));
    if (id.IsNone()) {
      direction.Fail("the part rests in no stable pose with this direction down",
                     "a direction at most 30 degrees off");
    }
    StablePose& pose = poses[id.index()];
    if (!pose.name.empty()) {
      direction.Fail(fmt::format("the nearest stable pose is already named '{}'", pose.name),
                     "one name for each stable pose");
    }
    pose.name = name;
  }
}

double ReadDensity(const Value& root) {
  return ReadWithin(root.At("density"), kKilogramsPerCubicMetre, {.low = 1, .high = 1e5});
}

}  // namespace

std::shared_ptr<const PartModel> PartFile::Load(const std::filesystem::path& file,
                                                double clearance) {
  return Read(Document::Load(file), clearance);
}

std::shared_ptr<const PartModel> PartFile::WithClearance(const PartModel& model, double clearance) {
  return Read(model.file_, clearance);
}

geometry::MassProperties PartFile::MassWithClearance(const PartModel& model, double clearance) {
  return ReadMass(model.file_, clearance);
}

std::shared_ptr<const PartModel> PartFile::Read(const Document& document, double clearance) {
  ASSAY_CHECK(std::isfinite(clearance));
  document.RequireFormat("assay-part/1");
  const Value& root = document.root();
  root.AllowOnly({"format", "name", "initial", "units", "density", "friction", "solids", "pockets",
                  "features", "stable_poses"});
  const std::shared_ptr<PartModel> model(new PartModel(document, clearance));
  model->name_ = ReadAnyName(root.At("name"));
  model->initial_ = ReadInitial(root.At("initial"));
  model->friction_ = ReadWithin(root.At("friction"), kRatio, {.low = 0.001, .high = 10});
  const PartFile file(root, clearance);
  file.solids_.CheckHangsTogether(root.At("solids"));
  file.BuildShape(*model, ReadDensity(root));
  if (const auto features = root.Find("features")) file.ReadFeatures(*features, *model);
  model->stable_poses_ = ComputeStablePoses(*model, kLeastTilt);
  if (const auto names = root.Find("stable_poses")) NameStablePoses(*names, model->stable_poses_);
  return model;
}

geometry::MassProperties PartFile::ReadMass(const Document& document, double clearance) {
  const PartFile file(document.root(), clearance);
  return geometry::MassOf(file.solids_.Pieces(), ReadDensity(document.root()));
}

PartFile::PartFile(const Value& root, double clearance)
    : units_(ReadUnits(root)), solids_(root, units_, clearance) {}

void PartFile::BuildShape(PartModel& model, double density) const {
  model.boxes_ = solids_.Pieces();
  for (const Solid& solid : solids_.solids()) {
    model.colors_.insert(model.colors_.end(), solid.pieces.size(), solid.color);
  }
  std::vector<Vector3> corners;
  for (const Box& box : model.boxes_) {
    for (const Vector3& corner : box.Corners()) corners.push_back(corner);
  }
  model.shape_ = geometry::CollisionShape(model.boxes_);
  model.hull_ = geometry::HullOf(corners);
  model.mass_ = geometry::MassOf(model.boxes_, density);
  model.faces_ = ExposedFaces(model.boxes_);
}

void PartFile::ReadFeatures(const Value& features, PartModel& model) const {
  for (const auto& [key, entry] : features.Entries()) {
    Feature feature = ReadFeature(entry, model);
    feature.number = FeatureNumber(key.Integer(1, 9999));
    if (model.FindFeature(feature.number) != nullptr) {
      key.Fail(fmt::format("feature {} is given twice", feature.number.index()));
    }
    model.features_.push_back(std::move(feature));
  }
  std::ranges::sort(model.features_, {}, &Feature::number);
}

Feature PartFile::ReadFeature(const Value& entry, const PartModel& model) const {
  Feature feature;
  if (entry.Find("face")) {
    ReadFace(entry, model, feature);
  } else if (entry.Find("hole")) {
    ReadHole(entry, model, feature);
  } else if (entry.Find("shaft")) {
    ReadShaft(entry, model, feature);
  } else {
    entry.Fail("a feature is a face, a hole or a shaft", "one of the keys face, hole, shaft");
  }
  if (const auto what = entry.Find("what")) feature.description = ReadAnyName(*what);
  if (const auto chamfer = entry.Find("chamfer")) {
    feature.chamfer = ReadWithin(*chamfer, units_.length, kChamfers);
  }
  return feature;
}

void PartFile::ReadFace(const Value& entry, const PartModel& model, Feature& feature) const {
  entry.AllowOnly({"face", "normal", "what"});
  const Solid& solid = solids_.SolidNamed(entry.At("face"));
  const Box box = solid.WholeInPart();
  const Value normal = entry.At("normal");
  const int side = ReadSide(normal, box, solid.name);
  const FaceId id = ExposedFaceOf(model, SidesOf(box)[static_cast<std::size_t>(side)]);
  if (id.IsNone()) {
    normal.Fail(fmt::format("the side of solid '{}' that looks this way is covered", solid.name),
                "the normal of an exposed side");
  }
  const Face& face = model.faces()[id.index()];
  feature.description = "face";
  feature.faces = {id};
  feature.X_PartFeature = FrameAlong(CentroidOf(face), face.normal);
}

// The axis runs through the first pocket.
void PartFile::ReadHole(const Value& entry, const PartModel& model, Feature& feature) const {
  entry.AllowOnly({"hole", "axis", "what", "chamfer"});
  const Value axis = entry.At("axis");
  std::vector<Hollow> hollows;
  for (const PartSolids::Pocket* const pocket : solids_.PocketsNamed(entry.At("hole"))) {
    const Solid& solid = solids_.SolidOf(*pocket);
    const Pose& X = solid.X_PartSolid;
    hollows.push_back({.solid = solid.WholeInPart(),
                       .pocket = pocket->box.Transformed(X),
                       .clipped = Clipped(pocket->box, solid.whole).Transformed(X),
                       .is_widened = pocket->is_widened});
    ReadSide(axis, hollows.back().solid, solid.name);
  }
  const Hollow& first = hollows.front();
  const int side = SideTowards(first.solid, ReadDirection(axis));
  const Side end = SidesOf(first.clipped)[static_cast<std::size_t>(side)];
  const std::optional<Mouth> mouth = FindMouth(model, hollows, end.normal);
  if (!mouth) {
    axis.Fail(hollows.size() == 1 ? "the pocket has no open mouth on this side"
                                  : "the pockets have no open mouth in common on this side",
              "the direction in which the hole opens");
  }
  feature.description = "hole";
  feature.mouths = {*mouth};
  const std::optional<Mouth> other = FindMouth(model, hollows, -end.normal);
  if (other) feature.mouths.push_back(*other);
  for (const Hollow& hollow : hollows) {
    const std::vector<Wall> walls = WallsOf(model, hollow);
    feature.walls.insert(feature.walls.end(), walls.begin(), walls.end());
  }
  const Vector3 center = (end.corners[0] + end.corners[3]) / 2;  // diagonally opposite corners
  feature.X_PartFeature = FrameAlong(center, end.normal);
}

// The tip is where the solids reach farthest along the axis. The axis runs through the first solid.
void PartFile::ReadShaft(const Value& entry, const PartModel& model, Feature& feature) const {
  entry.AllowOnly({"shaft", "axis", "what", "chamfer"});
  const std::vector<const Solid*> solids = solids_.SolidsNamed(entry.At("shaft"));
  const Box core = solids.front()->WholeInPart();
  const int towards = ReadSide(entry.At("axis"), core, solids.front()->name);
  const Vector3 axis = SidesOf(core)[static_cast<std::size_t>(towards)].normal;
  const Vector3 middle = core.X_FrameBox.translation();
  double tip = 0;  // distance from the middle, metres
  for (const Solid* const solid : solids) {
    for (const Side& side : SidesOf(solid->WholeInPart())) {
      for (const Vector3& corner : side.corners) tip = std::max(tip, axis.dot(corner - middle));
      const FaceId id = ExposedFaceOf(model, side);
      if (!id.IsNone()) feature.faces.push_back(id);
    }
  }
  std::ranges::sort(feature.faces);
  feature.faces.erase(std::unique(feature.faces.begin(), feature.faces.end()), feature.faces.end());
  if (feature.faces.empty()) entry.Fail("the shaft is covered on all sides");
  feature.description = "shaft";
  feature.X_PartFeature = FrameAlong(middle + tip * axis, axis);
}

}  // namespace assay::domain
