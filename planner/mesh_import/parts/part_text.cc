#include "planner/mesh_import/parts/part_text.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <numbers>

#include "planner/geometry/hull.h"

namespace assay::mesh_import {
namespace {

std::string Trimmed(std::string number) {
  number.erase(number.find_last_not_of('0') + 1);
  if (number.ends_with('.')) number.pop_back();
  return number == "-0" ? "0" : number;
}

// Returns a component of a unit vector.
std::string Component(double value) { return Trimmed(fmt::format("{:.9f}", value)); }

std::string PointText(const Vector3& p) {
  return fmt::format("[{}, {}, {}]", Millimetres(p.x()), Millimetres(p.y()), Millimetres(p.z()));
}

std::string DirectionText(const Vector3& direction) {
  return fmt::format("[{}, {}, {}]", Component(direction.x()), Component(direction.y()),
                     Component(direction.z()));
}

// Writes the posts of one solid in the coordinates in which the file gives them: those of the part,
// or those before the solid's turn, in which its axis is z.
class PostWriter {
 public:
  PostWriter(const Matrix3& R_PartLocal, int sides)
      : axis_(AxisOf(R_PartLocal)), R_PartLocal_(R_PartLocal), sides_(sides) {}

  // Returns the kind with its numbers: "box: [[...], [...]]".
  std::string Text(const Post& post) const {
    if (!post.is_straight) return post.at_low.IsCircle() ? Cone(post) : Hull(post);
    switch (post.at_low.kind) {
      case Contour::Kind::kCircle:
        return fmt::format("cylinder: {{from: {}, to: {}, radius: {}, sides: {}}}",
                           At(post.at_low.center, post.low), At(post.at_low.center, post.high),
                           Millimetres(post.at_low.radius), sides_);
      case Contour::Kind::kRectangle:
        return Box(post);
      case Contour::Kind::kPolygon:
        return fmt::format("prism: {{outline: {}, axis: {}, from: {}, to: {}}}",
                           OutlineText(post.at_low), axis_.value_or('z'), Millimetres(post.low),
                           Millimetres(post.high));
    }
    return {};
  }

  // Returns the turn of the solid, or nothing if it has none.
  std::string Turn() const {
    if (axis_) return {};
    const Eigen::AngleAxisd turn(R_PartLocal_);
    return fmt::format(", turn: {{axis: {}, angle: {}}}", DirectionText(turn.axis()),
                       Component(turn.angle() * 180 / std::numbers::pi));
  }

 private:
  Vector3 Point(const Vector2& at, double height) const {
    const Vector3 local(at.x(), at.y(), height);
    return axis_ ? Vector3(R_PartLocal_ * local) : local;
  }
  std::string At(const Vector2& at, double height) const { return PointText(Point(at, height)); }

  std::string Box(const Post& post) const {
    const Eigen::AlignedBox2d bounds = post.at_low.Bounds();
    const Vector3 a = Point(bounds.min(), post.low);
    const Vector3 b = Point(bounds.max(), post.high);
    return fmt::format("box: [{}, {}]", PointText(a.cwiseMin(b)), PointText(a.cwiseMax(b)));
  }

  std::string Cone(const Post& post) const {
    return fmt::format("cone: {{from: {}, to: {}, radii: [{}, {}], sides: {}}}",
                       At(post.at_low.center, post.low), At(post.at_high.center, post.high),
                       Millimetres(post.at_low.radius), Millimetres(post.at_high.radius), sides_);
  }

  std::string Hull(const Post& post) const {
    std::string text;
    for (const bool top : {false, true}) {
      for (const Vector2& corner : (top ? post.at_high : post.at_low).corners)
        text += (text.empty() ? "" : ", ") + At(corner, top ? post.high : post.low);
    }
    return "hull: [" + text + "]";
  }

  static std::string OutlineText(const Contour& contour) {
    std::string text;
    for (const Vector2& corner : contour.corners) {
      text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", Millimetres(corner.x()),
                          Millimetres(corner.y()));
    }
    return "[" + text + "]";
  }

  const std::optional<char> axis_;
  const Matrix3 R_PartLocal_;
  const int sides_;
};

std::string SolidText(const SketchSolid& solid, int sides) {
  if (!solid.post) return fmt::format("mesh: {{file: {}, units: mm, up: z}}", PieceFileName(solid));
  const PostWriter writer(solid.R_PartLocal, sides);
  return writer.Text(*solid.post) + writer.Turn();
}

std::string PocketText(const PartSketch& sketch, const SketchPocket& pocket, int sides) {
  const SketchSolid& solid = sketch.solids[static_cast<std::size_t>(pocket.solid)];
  return fmt::format("cut_from: {}, {}", solid.name,
                     PostWriter(solid.R_PartLocal, sides).Text(pocket.pocket.post));
}

std::string FeatureText(const SketchFeature& feature) {
  const bool is_face = feature.kind == SketchFeature::Kind::kFace;
  const char* key = is_face                                      ? "face"
                    : feature.kind == SketchFeature::Kind::kHole ? "hole"
                                                                 : "shaft";
  std::string text =
      fmt::format("{}: {}, {}: {}, what: \"{}\"", key, feature.of, is_face ? "normal" : "axis",
                  DirectionText(feature.direction), feature.what);
  if (feature.chamfer > 0) text += ", chamfer: " + Millimetres(feature.chamfer);
  return text;
}

}  // namespace

std::string InitialOf(const std::string& name) {
  std::string initial;
  bool begins = true;
  for (const char c : name) {
    const bool is_letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
    if (is_letter && begins && initial.size() < 3)
      initial += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    begins = !is_letter;
  }
  return initial.empty() ? "P" : initial;
}

std::string Millimetres(double metres) { return Trimmed(fmt::format("{:.4f}", metres * 1000)); }

std::string PartText(const PartSketch& sketch, const PartMaterial& material, int sides) {
  std::string text = fmt::format(
      "format: assay-part/1\nname: {}\ninitial: {}\nunits: {{length: mm, angle: degree}}\n"
      "density: {:.6g}\nfriction: {:.6g}\nsolids:\n",
      sketch.name, InitialOf(sketch.name), material.density, material.friction);
  for (const SketchSolid& solid : sketch.solids)
    text += fmt::format("  {}: {{{}}}\n", solid.name, SolidText(solid, sides));
  if (!sketch.pockets.empty()) text += "pockets:\n";
  for (const SketchPocket& pocket : sketch.pockets)
    text += fmt::format("  {}: {{{}}}\n", pocket.name, PocketText(sketch, pocket, sides));
  if (!sketch.features.empty()) text += "features:\n";
  for (std::size_t i = 0; i < sketch.features.size(); ++i)
    text += fmt::format("  {}: {{{}}}\n", i + 1, FeatureText(sketch.features[i]));
  return text;
}

std::string PieceFileName(const SketchSolid& solid) { return solid.name + ".obj"; }

std::string PieceText(const SketchSolid& solid) {
  std::string text;
  int first = 1;
  int number = 0;
  for (const geometry::ConvexHull& piece : solid.pieces) {
    text += fmt::format("o piece-{}\n", ++number);
    for (const Vector3& vertex : piece.vertices) {
      text += fmt::format("v {} {} {}\n", Millimetres(vertex.x()), Millimetres(vertex.y()),
                          Millimetres(vertex.z()));
    }
    for (const geometry::Facet& facet : piece.facets) {
      text += "f";
      for (const int i : facet.loop) text += fmt::format(" {}", first + i);
      text += "\n";
    }
    first += static_cast<int>(piece.vertices.size());
  }
  return text;
}

}  // namespace assay::mesh_import
