#include "planner/domain/parts/part_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <optional>
#include <span>

#include "planner/domain/parts/exposed_faces.h"
#include "planner/domain/parts/hollow.h"
#include "planner/domain/parts/part_shape.h"
#include "planner/domain/problem/name.h"
#include "planner/domain/resting/compute_stable_poses.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/planar_region.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::domain {
namespace {

using geometry::ConvexHull;

// Poses that stand more precariously are left out: a part that is put down with a few millimetres
// of error must not fall over.
constexpr double kLeastTilt = 2 * kDegrees.factor;
// Greatest angle between a direction and the down direction of the pose that it names, radians.
constexpr double kFarthestName = 30 * kDegrees.factor;
constexpr double kAligned = 1e-6;  // greatest difference of unit vectors that should be equal
constexpr int kMostFeatures = 9999;

std::string ReadInitial(const Value& value) {
  std::string initial = value.Text();
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  if (initial.empty() || initial.size() > 3 || !std::ranges::all_of(initial, is_capital)) {
    value.Fail(fmt::format("'{}' cannot begin a label", initial), "one to three capital letters");
  }
  return initial;
}

std::vector<Side> ReadSides(const Value& direction, std::span<const ConvexHull> solids,
                            const std::string& name) {
  std::vector<Side> sides = SidesTowards(solids, ReadDirection(direction));
  if (sides.empty()) {
    direction.Fail(fmt::format("solid '{}' has no side that looks this way", name),
                   "the direction in which a flat side of the solid looks");
  }
  return sides;
}

Vector3 CentroidOf(const Face& face) {
  const Vector2 center = geometry::Centroid(face.patches);
  return face.X_PartFace * Vector3(center.x(), center.y(), 0);
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
                     "a direction at most 30 degrees from one in which it rests; parts do not rest "
                     "on round sides, because they roll");
    }
    StablePose& pose = poses[id.index()];
    if (!pose.name.empty()) {
      direction.Fail(fmt::format("the nearest stable pose is already named '{}'", pose.name),
                     "one name for each stable pose");
    }
    pose.name = name;
  }
}

// Reads the key of several features: "1-6", the first number and the last one.
int ReadFirstNumber(const Value& key, std::ptrdiff_t count) {
  const std::string text = key.Text();
  int first = 0;
  int last = 0;
  char rest = 0;
  const bool is_range = std::sscanf(text.c_str(), "%d-%d%c", &first, &last, &rest) == 2;
  if (is_range && first >= 1 && last <= kMostFeatures && last - first + 1 == count) return first;
  key.Fail(fmt::format("'{}' does not number {} faces", text, count),
           fmt::format("the first and the last number, such as 1-{}", count));
}

double ReadDensity(const Value& root) {
  return ReadWithin(root.At("density"), kKilogramsPerCubicMetre, {.low = 1, .high = 1e5});
}

}  // namespace

PartReader::PartReader(const Value& root, double clearance)
    : root_(root),
      units_(ReadUnits(root)),
      clearance_(clearance),
      solids_(root, units_, clearance) {}

std::shared_ptr<const PartModel> PartReader::Model(const Document& document) const {
  const std::shared_ptr<PartModel> model(new PartModel(document, clearance_));
  model->name_ = ReadAnyName(root_.At("name"));
  model->initial_ = ReadInitial(root_.At("initial"));
  model->friction_ = ReadWithin(root_.At("friction"), kRatio, {.low = 0.001, .high = 10});
  solids_.CheckHangsTogether(root_.At("solids"));
  BuildShape(*model, ReadDensity(root_));
  if (const auto features = root_.Find("features")) ReadFeatures(*features, *model);
  model->stable_poses_ = ComputeStablePoses(*model, kLeastTilt);
  if (const auto names = root_.Find("stable_poses")) NameStablePoses(*names, model->stable_poses_);
  return model;
}

geometry::MassProperties PartReader::Mass() const {
  return geometry::MassOf(solids_.Pieces(), ReadDensity(root_));
}

void PartReader::BuildShape(PartModel& model, double density) const {
  model.shape_ =
      std::make_shared<const PartShape>(solids_.Pieces(), solids_.RoundSolids(), density);
  for (const Solid& solid : solids_.solids()) {
    model.colors_.insert(model.colors_.end(), solid.pieces.size(), solid.color);
  }
  model.faces_ = ExposedFaces(model.pieces());
}

void PartReader::ReadFeatures(const Value& features, PartModel& model) const {
  const auto add = [&](const Value& key, int number, Feature feature) {
    feature.number = FeatureNumber(number);
    if (model.FindFeature(feature.number) != nullptr) {
      key.Fail(fmt::format("feature {} is given twice", number));
    }
    model.features_.push_back(std::move(feature));
  };
  for (const auto& [key, entry] : features.Entries()) {
    if (!entry.Find("faces")) {
      add(key, key.Integer(1, kMostFeatures), ReadFeature(entry, model));
      continue;
    }
    std::vector<Feature> faces = ReadFaces(entry, model);
    const int first = ReadFirstNumber(key, std::ssize(faces));
    for (int i = 0; i < std::ssize(faces); ++i) {
      add(key, first + i, std::move(faces[static_cast<std::size_t>(i)]));
    }
  }
  std::ranges::sort(model.features_, {}, &Feature::number);
}

std::vector<Feature> PartReader::ReadFaces(const Value& entry, const PartModel& model) const {
  entry.AllowOnly({"faces", "normals", "what"});
  const Solid& solid = solids_.SolidNamed(entry.At("faces"));
  const std::vector<Value> normals = entry.At("normals").Items();
  const std::vector<Value> names = entry.At("what").Items();
  if (normals.empty() || names.size() != normals.size()) {
    entry.At("what").Fail(fmt::format("{} names of {} faces", names.size(), normals.size()),
                          "one name for each normal, at least one");
  }
  std::vector<Feature> faces(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    ReadFace(solid, normals[i], model, faces[i]);
    faces[i].description = ReadAnyName(names[i]);
  }
  return faces;
}

Feature PartReader::ReadFeature(const Value& entry, const PartModel& model) const {
  Feature feature;
  if (entry.Find("face")) {
    entry.AllowOnly({"face", "normal", "what"});
    ReadFace(solids_.SolidNamed(entry.At("face")), entry.At("normal"), model, feature);
  } else if (entry.Find("hole")) {
    ReadHole(entry, model, feature);
  } else if (entry.Find("shaft")) {
    ReadShaft(entry, model, feature);
  } else {
    entry.Fail("a feature is a face, a hole or a shaft", "one of the keys face, hole, shaft");
  }
  if (const auto what = entry.Find("what")) feature.description = ReadAnyName(*what);
  if (const auto chamfer = entry.Find("chamfer")) {
    feature.chamfer = ReadLength(*chamfer, units_);
  }
  return feature;
}

void PartReader::ReadFace(const Solid& solid, const Value& normal, const PartModel& model,
                          Feature& feature) {
  FaceId id = FaceId::None();
  for (const Side& side : ReadSides(normal, solid.whole, solid.name)) {
    if (id.IsNone()) id = ExposedFaceOf(model.faces(), side);
  }
  if (id.IsNone()) {
    normal.Fail(fmt::format("the side of solid '{}' that looks this way is covered", solid.name),
                "the normal of an exposed side");
  }
  const Face& face = model.faces()[id.index()];
  feature.description = "face";
  feature.faces = {id};
  feature.X_PartFeature = FrameAlong(CentroidOf(face), face.normal);
}

void PartReader::ReadHole(const Value& entry, const PartModel& model, Feature& feature) const {
  entry.AllowOnly({"hole", "axis", "what", "chamfer"});
  const Value axis = entry.At("axis");
  std::vector<Hollow> hollows;
  for (const PartSolids::Pocket* const pocket : solids_.PocketsNamed(entry.At("hole"))) {
    const Solid& solid = solids_.SolidOf(*pocket);
    ReadSides(axis, solid.whole, solid.name);
    hollows.push_back(HollowOf(solids_, *pocket));
  }
  const Vector3 out = SidesTowards(hollows.front().solid.whole, ReadDirection(axis)).front().normal;
  const std::optional<Mouth> mouth = FindMouth(model, hollows, out);
  if (!mouth) {
    axis.Fail(hollows.size() == 1 ? "the pocket has no open mouth on this side"
                                  : "the pockets have no open mouth in common on this side",
              "the direction in which the hole opens");
  }
  feature.description = "hole";
  feature.mouths = {*mouth};
  const std::optional<Mouth> other = FindMouth(model, hollows, -out);
  if (other) feature.mouths.push_back(*other);
  for (const Hollow& hollow : hollows) {
    std::ranges::move(WallsOf(model, hollow), std::back_inserter(feature.walls));
  }
  feature.X_PartFeature =
      FrameAlong(CenterAt(model.faces()[mouth->face.index()], hollows.front()), out);
}

// The tip is where the solids reach farthest along the axis. The axis runs through the first solid.
void PartReader::ReadShaft(const Value& entry, const PartModel& model, Feature& feature) const {
  entry.AllowOnly({"shaft", "axis", "what", "chamfer"});
  const std::vector<const Solid*> solids = solids_.SolidsNamed(entry.At("shaft"));
  const Solid& core = *solids.front();
  const Vector3 axis = ReadSides(entry.At("axis"), core.whole, core.name).front().normal;
  const Vector3 middle = geometry::MassOf(core.whole, 1).center;
  double tip = 0;  // distance from the middle, metres
  for (const Solid* const solid : solids) {
    tip = std::max(tip, FarthestAlong(solid->whole, axis) - axis.dot(middle));
    for (const ConvexHull& piece : solid->whole) {
      for (const Side& side : SidesOf(piece)) {
        const FaceId id = ExposedFaceOf(model.faces(), side);
        if (!id.IsNone()) feature.faces.push_back(id);
      }
    }
  }
  std::ranges::sort(feature.faces);
  feature.faces.erase(std::unique(feature.faces.begin(), feature.faces.end()), feature.faces.end());
  if (feature.faces.empty()) entry.Fail("the shaft is covered on all sides");
  feature.description = "shaft";
  feature.X_PartFeature = FrameAlong(middle + tip * axis, axis);
}

}  // namespace assay::domain
