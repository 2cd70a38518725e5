#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "planner/mesh_import/parts/part_import.h"
#include "planner/plan/plan_files/plan_file.h"
#include "tests/planner/constraint_posting/scenarios.h"
#include "tests/planner/mesh_import/made_mesh.h"

// Two parts have the same stable poses, grasps, plans and certificates, whether their files have
// boxes, prisms or hulls, or are imported from meshes.
namespace assay::constraint_posting::kinds_of_solids_test {
namespace {

using Json = nlohmann::ordered_json;
using geometry::Vector3;
using mesh_import::RectangleOf;

constexpr double kRounding = 1e-9;

// Two opposite corners, in millimetres.
struct Box {
  Vector3 low;
  Vector3 high;
};
const Box kBlock = {{-30, -30, 0}, {30, 30, 50}};
const Box kHole = {{-10.2, -10.2, 20}, {10.2, 10.2, 50}};
const Box kPlate = {{-20, -20, 0}, {20, 20, 25}};
const Box kShaft = {{-10, -10, -30}, {10, 10, 0}};

// Writes a box as a solid of a part file.
using Kind = std::function<std::string(const Box&)>;

std::string AsBox(const Box& box) {
  return fmt::format("{{box: [[{}, {}, {}], [{}, {}, {}]]}}", box.low.x(), box.low.y(), box.low.z(),
                     box.high.x(), box.high.y(), box.high.z());
}

std::string AsPrism(const Box& box) {
  return fmt::format(
      "{{prism: {{outline: [[{0}, {1}], [{2}, {1}], [{2}, {3}], [{0}, {3}]], from: {4}, to: "
      "{5}}}}}",
      box.low.x(), box.low.y(), box.high.x(), box.high.y(), box.low.z(), box.high.z());
}

// Calls `visit` with each corner.
void ForCorners(const Box& box, const std::function<void(double, double, double)>& visit) {
  for (const double x : {box.low.x(), box.high.x()}) {
    for (const double y : {box.low.y(), box.high.y()}) {
      for (const double z : {box.low.z(), box.high.z()}) visit(x, y, z);
    }
  }
}

std::string AsHull(const Box& box) {
  std::string points;
  ForCorners(box, [&](double x, double y, double z) {
    points += fmt::format("{}[{}, {}, {}]", points.empty() ? "" : ", ", x, y, z);
  });
  return "{hull: [" + points + "]}";
}

void Write(const std::filesystem::path& folder, const std::string& file, const std::string& text) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / file) << text;
}

void WriteParts(const std::filesystem::path& models, const Kind& solid) {
  const std::string start =
      "format: assay-part/1\nname: {}\ninitial: {}\nunits: {{length: mm, angle: degree}}\n"
      "density: 1000\nfriction: 0.3\n";
  Write(models / "parts" / "block", "part.yaml",
        fmt::format(fmt::runtime(start), "block", "B") + "solids:\n  body: " + solid(kBlock) +
            "\npockets:\n  hole: {cut_from: body, " + AsBox(kHole).substr(1) +
            "\nfeatures:\n"
            "  1-6: {faces: body, normals: [-z, +z, -y, +x, +y, -x], what: [a, b, c, d, e, f]}\n"
            "  7: {hole: hole, axis: +z, what: hole}\n");
  Write(models / "parts" / "peg", "part.yaml",
        fmt::format(fmt::runtime(start), "peg", "P") + "solids:\n  plate: " + solid(kPlate) +
            "\n  shaft: " + solid(kShaft) +
            "\nfeatures:\n"
            "  1-6: {faces: plate, normals: [-z, +z, -y, +x, +y, -x], what: [a, b, c, d, e, f]}\n"
            "  7: {shaft: shaft, axis: -z, what: shaft}\n");
}

// Returns the plan with the parts of these models. The features with these numbers mate.
Json PlanWith(const std::filesystem::path& models, std::size_t shaft = 7, std::size_t hole = 7) {
  const std::string text = fmt::format(R"(
format: assay-scenario/1
units: {{length: mm, angle: degree}}
workcell: puma762-table
clearance: 0.2
parts:
  block:
    model: block
    pose: {{columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [650, 50, 0]]}}
    error: {{x: 0.05, y: 0.05, z: 0.05, theta: 0.05}}
  peg:
    model: peg
    pose: {{columns: [[1, 0, 0], [0, 0, 1], [0, -1, 0], [550, -200, 20]]}}
    error: {{x: 0.05, y: 0.05, z: 0.05, theta: 0.05}}
gripper: {{error: {{x: 0.02, y: 0.02, z: 0.02, theta: 0.01}}}}
goal:
  - assembled:
      held: peg
      fixed: block
      features: [[{}], [{}]]
      pose: {{columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 50]]}}
      mating_vector: [0, 0, -40]
)",
                                       shaft, hole);
  domain::ModelPath path(models);
  path.Append(std::string(ASSAY_SOURCE_DIR) + "/models");
  const domain::Problem problem = domain::ReadProblem(Document::Parse(text, "scenario.yaml"), path);
  const plan::PlanResult result = MakeCertifiedPlan(problem, {}, {});
  EXPECT_EQ(result.outcome, Outcome::kFound);
  Json json = plan::ToJson(result, problem, "scenario.yaml");
  json.erase("counters");
  for (const domain::Part& part : problem.parts) {
    std::vector<double> tilts;  // an import may have another order
    for (const domain::StablePose& pose : part.model->stable_poses())
      tilts.push_back(pose.tilt_margin);
    std::ranges::sort(tilts);
    json["tilts of stable poses"].push_back(tilts);
  }
  return json;
}

enum class Names { kSame, kOther };

// Expects numbers that are the same except for rounding, and the same texts if the parts have the
// same names of features. Expressions are not compared, because the order of their terms may
// differ.
void ExpectSame(const Json& a, const Json& b, Names names, const std::string& place = "") {
  if (a.is_number() && b.is_number()) {
    EXPECT_NEAR(a.get<double>(), b.get<double>(), kRounding) << place;
  } else if (a.is_structured() && a.type() == b.type() && a.size() == b.size()) {
    for (const auto& [key, value] : a.items()) {
      if (key == "expression" || key == "shared") continue;
      if (key == "features" && names == Names::kOther) continue;
      const Json& other = a.is_array() ? b[static_cast<std::size_t>(std::stoi(key))] : b[key];
      ExpectSame(value, other, names, place + "." + key);
    }
  } else if (!(a.is_string() && b.is_string() && names == Names::kOther)) {
    EXPECT_EQ(a, b) << place;
  }
}

// Writes a part that is imported from a mesh, and returns the number of its feature of one kind.
std::size_t WriteImported(const std::filesystem::path& models, const std::string& name,
                          const mesh_import::TriangleMesh& mesh,
                          mesh_import::SketchFeature::Kind kind) {
  mesh_import::ImportOptions options;
  options.unit = mesh_import::MeshUnit::kMillimetre;
  options.material = {.density = 1000, .friction = 0.3};
  const mesh_import::ImportedPart part = mesh_import::Import(
      {mesh_import::Written(name + ".obj", mesh_import::ObjText(mesh))}, name, options);
  Write(models / "parts" / name, "part.yaml", part.PartFile());
  const auto& features = part.sketch.features;
  const auto found = std::ranges::find(features, kind, &mesh_import::SketchFeature::kind);
  EXPECT_NE(found, features.end());
  return static_cast<std::size_t>(found - features.begin()) + 1;
}

mesh_import::TriangleMesh PegMesh() {
  mesh_import::TriangleMesh mesh =
      mesh_import::FootWithStem(RectangleOf(40, 40), RectangleOf(20, 20), 25, 55);
  for (Vector3& p : mesh.vertices) p = Vector3(p.x(), -p.y(), 25 - p.z());
  return mesh;
}

TEST(KindsOfSolids, HaveTheSamePlansAndCertificates) {
  const std::filesystem::path models = ScratchFile("kinds-of-solids");
  WriteParts(models, AsBox);
  const Json plan = PlanWith(models);
  ASSERT_GE(plan["actions"].size(), 2U);
  for (const Kind& kind : {Kind(AsPrism), Kind(AsHull)}) {
    WriteParts(models, kind);
    ExpectSame(plan, PlanWith(models), Names::kSame);
  }
  using Feature = mesh_import::SketchFeature::Kind;
  const std::size_t shaft = WriteImported(models, "peg", PegMesh(), Feature::kShaft);
  const std::size_t hole = WriteImported(
      models, "block",
      mesh_import::BlockWithBlindHole(RectangleOf(60, 60), RectangleOf(20.4, 20.4), 20, 50),
      Feature::kHole);
  ExpectSame(plan, PlanWith(models, shaft, hole), Names::kOther);
}

}  // namespace
}  // namespace assay::constraint_posting::kinds_of_solids_test
