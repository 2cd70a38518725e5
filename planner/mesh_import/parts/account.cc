#include "planner/mesh_import/parts/account.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/counted.h"

namespace assay::mesh_import {
namespace {

std::string UnitSentence(const ImportedPart& part) {
  if (!part.unit) return "The files tell their unit.";
  const char* how =
      part.options.unit ? "as asked for" : "found from the size; --units sets another";
  return fmt::format("The unit of the files is {} ({}).", Name(*part.unit), how);
}

std::string FrameSentence(const ImportedPart& part) {
  const Matrix3& R = part.sketch.R_FilePart;
  if (R.isIdentity(0)) return "The frame of the part is that of the files.";
  const auto axis = [&](int i) {
    return fmt::format("({:.6f}, {:.6f}, {:.6f})", R(0, i), R(1, i), R(2, i));
  };
  return fmt::format(
      "The part is turned so that it lies along its axes: in the files, the part's x is along {}, "
      "its y along {}, and its z along {}. The origin is that of the files.",
      axis(0), axis(1), axis(2));
}

// Returns a text that says whether the circle goes through the corners or touches the sides in the
// file, and how far the part's polygon is off the circle.
std::string CircleText(const Contour& circle, int sides) {
  const double half = std::numbers::pi / static_cast<double>(circle.corners.size());
  const double excess = circle.radius * (1 / std::cos(std::numbers::pi / sides) - 1);
  return fmt::format(
      "a circle of diameter {} mm through the {} of {} {} in the file (the other diameter is {} "
      "mm); with {} sides, the part's polygon is up to {} mm off the circle",
      Millimetres(2 * circle.radius), circle.is_circle_of_sides ? "sides" : "corners",
      circle.corners.size(), circle.is_circle_of_sides ? "sides" : "corners",
      Millimetres(2 * circle.radius *
                  (circle.is_circle_of_sides ? 1 / std::cos(half) : std::cos(half))),
      sides, Millimetres(excess));
}

std::string ChamferText(const Chamfer& chamfer, const char* end) {
  if (chamfer.across == 0) return {};
  return fmt::format("; at its {} end a chamfer of {} mm across and {} mm along", end,
                     Millimetres(chamfer.across), Millimetres(chamfer.along));
}

std::string PostText(const Post& post, int sides) {
  const Contour& contour = post.at_low;
  const Vector2 sizes = contour.Bounds().sizes();
  std::string text;
  if (contour.IsCircle()) {
    text = CircleText(contour, sides);
  } else if (contour.kind == Contour::Kind::kRectangle) {
    text = fmt::format("{} x {} mm", Millimetres(sizes.x()), Millimetres(sizes.y()));
  } else {
    text = fmt::format("a polygon with {} corners, {} x {} mm", contour.corners.size(),
                       Millimetres(sizes.x()), Millimetres(sizes.y()));
  }
  if (contour.left_out > 0) {
    text += fmt::format("; its rounded or bevelled corners, up to {} mm, are left out",
                        Millimetres(contour.left_out));
  }
  if (!post.is_straight) text += ", tapered";
  text +=
      fmt::format("; {} to {} mm along its axis", Millimetres(post.low), Millimetres(post.high));
  return text + ChamferText(post.chamfer_low, "lower") + ChamferText(post.chamfer_high, "upper");
}

std::string PieceSentence(const BodyAccount& body) {
  return fmt::format(
      "A body of {} ({}) is no stack of extrusions: {}. It becomes {}, with {:.2f} times the "
      "body's volume, at most {} mm from its surface. It cannot be mated.",
      body.file, Counted(body.shape.triangles, "triangle"), body.shape.reason,
      Counted(static_cast<int>(body.shape.pieces.size()), "convex piece"),
      1 + body.shape.volume_share, Millimetres(body.shape.distance));
}

std::string StackSentence(const BodyAccount& body) {
  const Stack& stack = body.shape.stack;
  std::string text = fmt::format(
      "A body of {} ({}) is a stack of extrusions: {} and {}. It is at most {} mm from the file, "
      "measured with its chamfers and with true circles.",
      body.file, Counted(body.shape.triangles, "triangle"),
      Counted(static_cast<int>(stack.solids.size()), "solid"),
      Counted(static_cast<int>(stack.pockets.size()), "pocket"), Millimetres(body.shape.distance));
  const auto steps =
      std::ranges::count_if(stack.solids, &Post::is_step) +
      std::ranges::count_if(stack.pockets, [](const auto& pocket) { return pocket.post.is_step; });
  if (steps > 0) {
    text += fmt::format(
        " Where its section changes gradually, {} stand for it, which have less material.",
        Counted(static_cast<int>(steps), "step"));
  }
  return text;
}

std::vector<std::string> DimensionsOf(const ImportedPart& part) {
  std::vector<std::string> lines;
  for (const SketchSolid& solid : part.sketch.solids) {
    if (solid.post)
      lines.push_back(
          fmt::format("{}: {}.", solid.name, PostText(*solid.post, part.options.sides)));
  }
  for (const SketchPocket& pocket : part.sketch.pockets) {
    lines.push_back(
        fmt::format("{}: {}.", pocket.name, PostText(pocket.pocket.post, part.options.sides)));
  }
  return lines;
}

std::string MaterialSentence(const ImportedPart& part) {
  const PartMaterial usual;
  const PartMaterial& material = part.options.material;
  const auto assumed = [](bool is_usual) { return is_usual ? " (assumed)" : ""; };
  return fmt::format(
      "The volume is {:.4g} cm^3. With a density of {:.6g} kg/m^3{} the mass is {:.4g} kg. The "
      "friction is {:.6g}{}.",
      part.Volume() * 1e6, material.density, assumed(material.density == usual.density),
      part.Volume() * material.density, material.friction,
      assumed(material.friction == usual.friction));
}

}  // namespace

std::vector<std::string> AccountOf(const ImportedPart& part) {
  std::vector<std::string> account = {UnitSentence(part), FrameSentence(part)};
  for (const std::string& repair : part.repairs) account.push_back(repair);
  for (const BodyAccount& body : part.bodies)
    account.push_back(body.shape.is_stack ? StackSentence(body) : PieceSentence(body));
  for (std::string& line : DimensionsOf(part)) account.push_back(std::move(line));
  account.push_back(MaterialSentence(part));
  if (!part.sketch.CanBeMated())
    account.push_back("The part has no hole and no shaft, and so it cannot be mated.");
  return account;
}

std::string ReadmeText(const ImportedPart& part) {
  std::string text = fmt::format("# {}\n\n`assay import` made this part of {}.\n\n",
                                 part.sketch.name, fmt::join(part.files, ", "));
  for (const std::string& sentence : AccountOf(part)) text += "- " + sentence + "\n";
  if (part.sketch.features.empty()) return text;
  text += "\n| feature | what it is |\n| --- | --- |\n";
  for (std::size_t i = 0; i < part.sketch.features.size(); ++i)
    text += fmt::format("| {} | {} |\n", i + 1, part.sketch.features[i].what);
  return text;
}

}  // namespace assay::mesh_import
