#include "sim/scene/exchange/exported_body.h"

#include <gtest/gtest.h>

#include <sstream>

#include "planner/domain/parts/part_file.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/mujoco/data.h"

namespace assay::scene::exported_body_test {
namespace {

using geometry::Pose;
using geometry::Vector3;

// Parts of boxes alone, of round pieces alone, and of both.
constexpr const char* kParts[] = {"peg", "can", "round-block"};

ExportedBody BodyOf(const std::string& name) {
  return {.name = name,
          .model = domain::PartFile::Load(
              std::string(ASSAY_SOURCE_DIR) + "/models/parts/" + name + "/part.yaml", 0.0005)};
}

// Oracle: the volume that the triangles of an OBJ file's faces enclose. Each face is a fan of
// triangles, and each triangle adds the signed volume of its tetrahedron with the origin.
double VolumeOfObj(const std::string& text) {
  std::vector<Vector3> vertices;
  double volume = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vector3& p = vertices.emplace_back();
      words >> p.x() >> p.y() >> p.z();
    } else if (kind == "f") {
      std::vector<Vector3> corners;
      for (std::size_t i = 0; words >> i;) corners.push_back(vertices.at(i - 1));
      for (std::size_t i = 2; i < corners.size(); ++i) {
        volume += corners[0].dot(corners[i - 1].cross(corners[i])) / 6;
      }
    }
  }
  return volume;
}

TEST(ExportedBody, ObjEnclosesThePieces) {
  for (const char* name : kParts) {
    ExportedBody body = BodyOf(name);
    double volume = 0;
    for (const auto& piece : body.model->pieces()) volume += geometry::Volume(piece);
    body.X_WorldPart = geometry::Translation(0.1, 0.2, 0.3) * geometry::RotationZ(0.4);
    EXPECT_NEAR(VolumeOfObj(BodiesToObj({body})), volume, 1e-9 * volume) << name;
    EXPECT_NEAR(VolumeOfObj(BodiesToObj({body, body})), 2 * volume, 1e-9 * volume) << name;
  }
}

// A body falls freely, with its centre of mass where the part has it.
TEST(ExportedBody, MjcfFallsFreely) {
  for (const char* name : kParts) {
    const ExportedBody body = BodyOf(name);
    mujoco::Data data(mujoco::Model::FromMjcf(BodiesToMjcf("falling", {body})));
    data.Forward();
    std::vector<double> force(6, 0);
    data.MultiplyByInertia(std::vector<double>{0, 0, 1, 0, 0, 0}, force);
    EXPECT_NEAR(force[2], body.model->mass().mass, 1e-9) << name;
    EXPECT_NEAR(force[3] / force[2], body.model->mass().center.y(), 1e-9) << name;
    EXPECT_NEAR(force[4] / force[2], -body.model->mass().center.x(), 1e-9) << name;
    for (int i = 0; i < 200; ++i) data.StepUnmodified();
    const double t = data.time();
    EXPECT_NEAR(data.qpos()[2], -9.81 * t * t / 2, 0.01 * t) << name;
    EXPECT_FALSE(data.HasWarnings()) << name;
  }
}

// The boxes of a part stand in the URDF file, and its other pieces in files beside it.
TEST(ExportedBody, UrdfNamesTheMeshesOfRoundPieces) {
  const std::vector<ExportedFile> files = BodiesToUrdf("p", {BodyOf("round-block")});
  ASSERT_GT(files.size(), 1u) << "round pieces are meshes";
  double volume = 0;
  for (std::size_t i = 1; i < files.size(); ++i) {
    EXPECT_NE(files[0].text.find("filename=\"" + files[i].name + "\""), std::string::npos);
    EXPECT_GT(VolumeOfObj(files[i].text), 0);
    volume += VolumeOfObj(files[i].text);
  }
  const ExportedBody block = BodyOf("round-block");
  double whole = 0;
  for (const auto& piece : block.model->pieces()) whole += geometry::Volume(piece);
  EXPECT_LE(volume, whole * (1 + 1e-9));
}

}  // namespace
}  // namespace assay::scene::exported_body_test
