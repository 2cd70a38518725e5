#include "planner/domain/parts/solids/solid_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

#include "planner/domain/parts/exposed_faces.h"
#include "planner/domain/parts/solids/convex_pieces_file.h"
#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/polygon_pieces.h"

namespace assay::domain {
namespace {

using geometry::ConvexHull;
using geometry::Ring;
using geometry::Vector2;
using geometry::Vector3;

constexpr double kShortestSide = 1e-4;  // least length of a solid along each direction, metres
constexpr int kUsualSides = 32;         // sides of the polygon that stands for a circle
constexpr Range kRadii = {5e-5, 100};   // metres
constexpr int kMostCorners = 1000;      // of one outline or hull

struct ShapeReading {
  const Units& units;
  Roundness roundness;
  const Widening& widening;
};

void RequireLength(const Value& place, double length, const Units& units) {
  if (length >= kShortestSide) return;
  place.Fail(fmt::format("the solid is only {} long", InUnit(length, units.length)),
             fmt::format("at least {}", InUnit(kShortestSide, units.length)));
}

SolidShape ReadBox(const Value& corners, const ShapeReading& reading) {
  const std::vector<Value> items = corners.Items();
  if (items.size() != 2) {
    corners.Fail(fmt::format("a box has two corners, not {}", items.size()),
                 "[[x, y, z], [x, y, z]], the lower corner first");
  }
  const Vector3 low = ReadVector3(items[0], reading.units);
  const Vector3 high = ReadVector3(items[1], reading.units);
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] - low[axis] >= kShortestSide) continue;
    corners.Fail(fmt::format("the box has no length along {}", "xyz"[axis]),
                 fmt::format("a second corner at least {} beyond the first",
                             InUnit(kShortestSide, reading.units.length)));
  }
  geometry::Box box = geometry::Box::FromCorners(low, high);
  SolidShape shape;
  for (int axis = 0; axis < 3; ++axis) {
    if (!reading.widening.along[static_cast<std::size_t>(axis)]) continue;
    box.half_extents[axis] += reading.widening.by;
    if (2 * box.half_extents[axis] < kShortestSide) {
      corners.Fail(fmt::format("a clearance of {} closes the pocket",
                               InUnit(reading.widening.by, reading.units.length)),
                   "one that leaves a pocket");
    }
    shape.moved_sides.push_back(Vector3::Unit(axis));
    shape.moved_sides.push_back(-Vector3::Unit(axis));
  }
  shape.pieces = {geometry::HullOf(box)};
  return shape;
}

// Returns the prism or the frustum between two polygons with as many corners, at two heights along
// z. One of the polygons may have a single corner: the tip.
ConvexHull Frustum(const Ring& bottom, double low, const Ring& top, double high) {
  std::vector<Vector3> vertices;
  for (const Vector2& p : bottom) vertices.emplace_back(p.x(), p.y(), low);
  for (const Vector2& p : top) vertices.emplace_back(p.x(), p.y(), high);
  return geometry::HullOf(vertices);
}

// Returns a regular polygon with one side at the greatest x. Its sides touch the circle of this
// radius from outside.
Ring RegularPolygon(int sides, double apothem) {
  Ring ring;
  for (int i = 0; i < sides; ++i) {
    const double angle = (2 * i + 1) * std::numbers::pi / sides;
    ring.push_back(apothem / std::cos(std::numbers::pi / sides) *
                   Vector2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

// Adds the normals of the sides of a regular polygon, in space.
void AddSides(int sides, const geometry::Matrix3& R_FileShape, double slope, SolidShape& shape) {
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * i * std::numbers::pi / sides;
    shape.moved_sides.push_back(R_FileShape *
                                Vector3(std::cos(angle), std::sin(angle), slope).normalized());
  }
}

int ReadSides(const Value& entry) {
  const auto sides = entry.Find("sides");
  if (!sides) return kUsualSides;
  const int count = sides->Integer(4, 256);
  if (count % 4 != 0) {
    sides->Fail(fmt::format("{} is no multiple of 4", count), "8, 12, 16, ... up to 256");
  }
  return count;
}

// A round solid about the line between two points.
struct Axle {
  Pose X_FileShape;  // origin at the first point, z towards the second one
  double length = 0;
};

Axle ReadAxle(const Value& entry, const Units& units) {
  const Vector3 from = ReadVector3(entry.At("from"), units);
  const Vector3 to = ReadVector3(entry.At("to"), units);
  const double length = (to - from).norm();
  RequireLength(entry.At("to"), length, units);
  return {FrameAlong(from, (to - from) / length), length};
}

double WidenedRadius(const Value& place, double radius, const ShapeReading& reading) {
  if (!reading.widening.across) return radius;
  const double widened = radius + reading.widening.by;
  if (widened >= kRadii.low) return widened;
  place.Fail(fmt::format("a clearance of {} closes the pocket",
                         InUnit(reading.widening.by, reading.units.length)),
             "one that leaves a pocket");
}

// Returns the distance of the polygon's sides from the middle of its circle.
double ApothemOf(double radius, int sides, Roundness roundness) {
  return roundness == Roundness::kAround ? radius : radius * std::cos(std::numbers::pi / sides);
}

geometry::RoundSolid RoundAbout(const Axle& axle, std::array<double, 2> radii, int sides) {
  const Vector3 from = axle.X_FileShape.translation();
  return {{from, axle.X_FileShape * Vector3(0, 0, axle.length)}, radii, sides};
}

SolidShape ReadCylinder(const Value& entry, const ShapeReading& reading) {
  entry.AllowOnly({"from", "to", "radius", "sides"});
  const Axle axle = ReadAxle(entry, reading.units);
  const int sides = ReadSides(entry);
  const Value place = entry.At("radius");
  const double radius =
      WidenedRadius(place, ReadWithin(place, reading.units.length, kRadii), reading);
  const Ring ring = RegularPolygon(sides, ApothemOf(radius, sides, reading.roundness));
  SolidShape shape;
  shape.round = RoundAbout(axle, {radius, radius}, sides);
  shape.pieces = {Transformed(Frustum(ring, 0, ring, axle.length), axle.X_FileShape)};
  if (reading.widening.across) AddSides(sides, axle.X_FileShape.linear(), 0, shape);
  return shape;
}

SolidShape ReadCone(const Value& entry, const ShapeReading& reading) {
  entry.AllowOnly({"from", "to", "radii", "sides"});
  const Axle axle = ReadAxle(entry, reading.units);
  const int sides = ReadSides(entry);
  const Value radii = entry.At("radii");
  const std::vector<Value> items = radii.Items();
  if (items.size() != 2) {
    radii.Fail(fmt::format("a cone has two radii, not {}", items.size()),
               "[radius at `from`, radius at `to`]");
  }
  std::array<Ring, 2> rings;
  std::array<double, 2> widened{};
  std::array<double, 2> apothems{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double radius = ReadWithin(items[i], reading.units.length, {0, kRadii.high});
    const bool is_tip = radius < kRadii.low;
    widened[i] = is_tip ? 0 : WidenedRadius(items[i], radius, reading);
    apothems[i] = ApothemOf(widened[i], sides, reading.roundness);
    rings[i] = is_tip ? Ring{Vector2::Zero()} : RegularPolygon(sides, apothems[i]);
  }
  if (rings[0].size() == 1 && rings[1].size() == 1) {
    radii.Fail("both ends of the cone are points",
               fmt::format("one radius of at least {}", InUnit(kRadii.low, reading.units.length)));
  }
  SolidShape shape;
  shape.round = RoundAbout(axle, widened, sides);
  shape.pieces = {Transformed(Frustum(rings[0], 0, rings[1], axle.length), axle.X_FileShape)};
  if (reading.widening.across) {
    AddSides(sides, axle.X_FileShape.linear(), (apothems[0] - apothems[1]) / axle.length, shape);
  }
  return shape;
}

Ring ReadRing(const Value& corners, const Units& units) {
  Ring ring;
  for (const Value& corner : corners.Items()) ring.push_back(ReadVector2(corner, units));
  if (std::ssize(ring) > kMostCorners) {
    corners.Fail(fmt::format("the outline has {} corners", ring.size()),
                 fmt::format("at most {}", kMostCorners));
  }
  if (!geometry::IsSimple(ring)) {
    corners.Fail("the outline has fewer than three corners, or its sides meet",
                 "the corners of a polygon in order, each given once");
  }
  return ring;
}

std::vector<Ring> ReadHoles(const Value& holes, const Ring& outline, const Units& units) {
  std::vector<Ring> rings;
  for (const Value& hole : holes.Items()) {
    Ring ring = ReadRing(hole, units);
    const auto meets = [&](const Ring& other) {
      return geometry::SidesMeet(ring, other) || geometry::IsInside(other, ring.front()) ||
             geometry::IsInside(ring, other.front());
    };
    if (geometry::SidesMeet(ring, outline) || !geometry::IsInside(outline, ring.front())) {
      hole.Fail("the hole is not inside the outline", "a hole with matter all around");
    }
    if (std::ranges::any_of(rings, meets)) {
      hole.Fail("the hole meets another one", "holes with matter between them");
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

// A prism's outline: a regular polygon or a list of corners.
struct Section {
  Ring outline;
  std::vector<Ring> holes;
};

Section ReadSection(const Value& entry, const Units& units) {
  Section section;
  if (const auto regular = entry.Find("regular")) {
    regular->AllowOnly({"sides", "across_flats", "center"});
    const double across =
        ReadWithin(regular->At("across_flats"), units.length, {kShortestSide, 2 * kRadii.high});
    section.outline = RegularPolygon(regular->At("sides").Integer(3, 256), across / 2);
    if (const auto center = regular->Find("center")) {
      for (Vector2& p : section.outline) p += ReadVector2(*center, units);
    }
  } else {
    section.outline = ReadRing(entry.At("outline"), units);
  }
  if (const auto holes = entry.Find("holes")) {
    section.holes = ReadHoles(*holes, section.outline, units);
  }
  return section;
}

// Returns the convex polygon of a pocket that is widened across its axis.
Ring WidenedOutline(const Value& entry, const Section& section, const ShapeReading& reading) {
  const std::vector<geometry::Polygon> pieces =
      geometry::ConvexPieces(section.outline, section.holes);
  if (pieces.size() != 1) {
    entry.Fail("only a convex prism can be widened across its axis", "a convex outline");
  }
  Ring widened = geometry::MovedOutward(pieces.front(), reading.widening.by);
  const auto turned = [&](std::size_t i) {
    const std::size_t next = (i + 1) % widened.size();
    return (widened[next] - widened[i]).dot(pieces.front()[next] - pieces.front()[i]) <= 0;
  };
  for (std::size_t i = 0; i < widened.size(); ++i) {
    if (!turned(i)) continue;
    entry.Fail(fmt::format("a clearance of {} closes the pocket",
                           InUnit(reading.widening.by, reading.units.length)),
               "one that leaves a pocket");
  }
  return widened;
}

SolidShape ReadPrism(const Value& entry, const ShapeReading& reading) {
  entry.AllowOnly({"outline", "regular", "holes", "axis", "from", "to"});
  const int axis = entry.Find("axis") ? entry.At("axis").OneOf({"x", "y", "z"}) : 2;
  const double from = ReadLength(entry.At("from"), reading.units);
  const double to = ReadLength(entry.At("to"), reading.units);
  RequireLength(entry.At("to"), to - from, reading.units);
  geometry::Matrix3 R_FileShape;  // u, v and the axis, cyclically x, y, z
  R_FileShape << Vector3::Unit((axis + 1) % 3), Vector3::Unit((axis + 2) % 3), Vector3::Unit(axis);
  const Section section = ReadSection(entry, reading.units);
  std::vector<Ring> rings;
  SolidShape shape;
  if (reading.widening.across) {
    rings = {WidenedOutline(entry, section, reading)};
    for (std::size_t i = 0; i < rings.front().size(); ++i) {
      const Vector2 side = rings.front()[(i + 1) % rings.front().size()] - rings.front()[i];
      shape.moved_sides.push_back(R_FileShape * Vector3(side.y(), -side.x(), 0).normalized());
    }
  } else {
    rings = geometry::ConvexPieces(section.outline, section.holes);
  }
  Pose X_FileShape = Pose::Identity();
  X_FileShape.linear() = R_FileShape;
  for (const Ring& ring : rings) {
    shape.pieces.push_back(Transformed(Frustum(ring, from, ring, to), X_FileShape));
  }
  return shape;
}

SolidShape ReadHull(const Value& points, const ShapeReading& reading) {
  std::vector<Vector3> vertices;
  for (const Value& point : points.Items()) vertices.push_back(ReadVector3(point, reading.units));
  if (std::ssize(vertices) > kMostCorners) {
    points.Fail(fmt::format("the hull has {} points", vertices.size()),
                fmt::format("at most {}", kMostCorners));
  }
  if (!geometry::SpanSpace(vertices, kShortestSide)) {
    points.Fail("the points lie in one plane",
                fmt::format("at least four points, {} or more apart in every direction",
                            InUnit(kShortestSide, reading.units.length)));
  }
  return {{geometry::HullOf(vertices)}, {}, {}};
}

// Reads a file beside the part file. Its axis `up` becomes the part's z.
SolidShape ReadMesh(const Value& entry, const ShapeReading& reading) {
  entry.AllowOnly({"file", "units", "up"});
  const Value name = entry.At("file");
  const std::filesystem::path file = name.Text();
  if (file.has_parent_path() || file.empty()) {
    name.Fail(fmt::format("'{}' is no file beside the part file", file.string()),
              "the name of an OBJ file in the folder of the part");
  }
  const double unit =
      entry.Find("units") ? ReadLengthUnit(entry.At("units")).factor : reading.units.length.factor;
  const int up = entry.Find("up") ? entry.At("up").OneOf({"x", "y", "z"}) : 2;
  Pose X_PartFile = Pose::Identity();
  X_PartFile.linear().row(0) = Vector3::Unit((up + 1) % 3).transpose();
  X_PartFile.linear().row(1) = Vector3::Unit((up + 2) % 3).transpose();
  X_PartFile.linear().row(2) = Vector3::Unit(up).transpose();
  const std::filesystem::path folder = std::filesystem::path(entry.Place().file).parent_path();
  return {Transformed(ReadConvexPieces(folder / file, unit), X_PartFile), {}, {}};
}

struct ShapeKind {
  std::string name;
  SolidShape (*read)(const Value& value, const ShapeReading& reading);
};
const std::vector<ShapeKind>& AllShapeKinds() {
  static const std::vector<ShapeKind> kinds = {{"box", ReadBox},           {"prism", ReadPrism},
                                               {"cylinder", ReadCylinder}, {"cone", ReadCone},
                                               {"hull", ReadHull},         {"mesh", ReadMesh}};
  return kinds;
}

}  // namespace

const std::vector<std::string>& ShapeKinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const ShapeKind& kind : AllShapeKinds()) all.push_back(kind.name);
    return all;
  }();
  return names;
}

SolidShape ReadShape(const Value& entry, const Units& units, Roundness roundness,
                     const Widening& widening) {
  const ShapeKind* given = nullptr;
  for (const ShapeKind& kind : AllShapeKinds()) {
    if (!entry.Find(kind.name)) continue;
    if (given != nullptr) {
      entry.Fail(fmt::format("the entry has both a {} and a {}", given->name, kind.name),
                 "one shape for each name");
    }
    given = &kind;
  }
  if (given == nullptr) {
    entry.Fail("the entry has no shape",
               fmt::format("one of the keys {}", fmt::join(ShapeKinds(), ", ")));
  }
  const Value value = entry.At(given->name);
  if (widening.across && (given->name == "box" || given->name == "hull" || given->name == "mesh")) {
    entry.At("widen").Fail(fmt::format("a {} is not widened across an axis", given->name),
                           "a list of axes for a box");
  }
  if (!widening.across && given->name != "box" && std::ranges::count(widening.along, true) > 0) {
    entry.At("widen").Fail(fmt::format("a {} is not widened along axes", given->name), "across");
  }
  return given->read(value, {units, roundness, widening});
}

}  // namespace assay::domain
