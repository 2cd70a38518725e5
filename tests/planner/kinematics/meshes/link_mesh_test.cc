#include "planner/kinematics/meshes/link_mesh.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

#include "planner/geometry/hull.h"
#include "planner/kinematics/urdf_model.h"
#include "tests/scratch_file.h"

namespace assay::kinematics::link_mesh_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// A cube from 0 to 100 in each direction, with a dent in its upper face.
constexpr const char* kDentedCube = R"(
v 0 0 0
v 100 0 0
v 100 100 0
v 0 100 0
v 0 0 100
v 100 0 100
v 100 100 100
v 0 100 100
v 50 50 60
f 1 4 3 2
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
f 5 6 9
f 6 7 9
f 7 8 9
f 8 5 9
)";

// A folder with a robot in PACKAGE/urdf, and its mesh in PACKAGE/meshes.
class RobotFolder {
 public:
  RobotFolder() : folder_(ScratchFile("robot")) {
    Write("arm_description/meshes/link.obj", kDentedCube);
  }
  ~RobotFolder() { fs::remove_all(folder_); }
  RobotFolder(const RobotFolder&) = delete;
  RobotFolder& operator=(const RobotFolder&) = delete;

  const fs::path& folder() const { return folder_; }
  void Write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }
  // Returns a URDF file with a link that is drawn as one mesh and collides as another.
  fs::path Robot(const std::string& visual, const std::string& collision,
                 const fs::path& urdf = "arm_description/urdf/arm.urdf") const {
    Write(urdf, fmt::format(R"(<robot name="arm">
 <link name="base">
  <visual><geometry><mesh filename="{}"/></geometry></visual>
  <collision>
   <origin xyz="0 0 1"/><geometry><mesh filename="{}" scale="0.001 0.002 -0.001"/></geometry>
  </collision>
 </link>
</robot>)",
                            visual, collision));
    return folder_ / urdf;
  }

 private:
  fs::path folder_;
};

std::string ErrorOf(const fs::path& urdf) {
  try {
    ReadUrdf(urdf);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(LinkMesh, ALinkHasTheHullOfItsMeshInMetres) {
  const RobotFolder robot;
  const std::string mesh = "package://arm_description/meshes/link.obj";
  const RobotModel model = ReadUrdf(robot.Robot(mesh, mesh));
  ASSERT_THAT(model.links.front().collisions, SizeIs(1));
  ASSERT_THAT(model.links.front().visuals, SizeIs(1));
  const Collision& collision = model.links.front().collisions.front();
  EXPECT_EQ(collision.X_LinkShape.translation(), Vector3(0, 0, 1));
  const geometry::ConvexHull& hull = *std::get<HullShape>(collision.shape).hull;
  // The dent is filled, and the mesh is scaled and mirrored.
  ASSERT_THAT(hull.vertices, SizeIs(8));
  for (const Vector3& corner : {Vector3(0, 0, 0), Vector3(0.1, 0.2, -0.1), Vector3(0, 0.2, -0.1)}) {
    EXPECT_TRUE(std::ranges::any_of(hull.vertices, [&](const Vector3& vertex) {
      return (vertex - corner).norm() < 1e-12;
    })) << corner.transpose();
  }
}

// The dent is a pyramid whose height is 0.4 of the cube's.
TEST(LinkMesh, SaysHowWellTheHullFits) {
  const RobotFolder robot;
  const std::string mesh = "package://arm_description/meshes/link.obj";
  const RobotModel model = ReadUrdf(robot.Robot(mesh, mesh));
  ASSERT_THAT(model.links.front().fits, SizeIs(1));
  const MeshFit& fit = model.links.front().fits.front();
  EXPECT_EQ(fit.file, mesh);
  EXPECT_EQ(fit.pieces, 1U);
  ASSERT_TRUE(fit.volume_ratio);
  EXPECT_NEAR(*fit.volume_ratio, 1 / (1 - 0.4 / 3), 1e-9);
}

TEST(LinkMesh, TheVolumeOfAnOpenMeshIsUnknown) {
  const RobotFolder robot;
  std::string open = kDentedCube;
  open.erase(open.find("f 8 5 9"));
  robot.Write("open.obj", open);
  EXPECT_FALSE(
      ReadLinkMesh(robot.folder() / "open.obj", Vector3::Ones(), MeshUse::kCollision).volume_ratio);
}

TEST(LinkMesh, MeshesAreFoundInPackagesBesideTheFileAndInNamedFolders) {
  const RobotFolder robot;
  const fs::path mesh = robot.folder() / "arm_description/meshes/link.obj";
  const std::string name = "package://arm_description/meshes/link.obj";
  const fs::path near = robot.folder() / "arm_description/urdf/arm.urdf";
  const fs::path far = "/elsewhere/arm.urdf";
  EXPECT_EQ(FindMesh(name, near, {}), mesh);
  EXPECT_EQ(FindMesh(name, far, {}), std::nullopt);
  EXPECT_EQ(FindMesh(name, far, std::array{robot.folder()}), mesh);
  EXPECT_EQ(FindMesh("file://" + mesh.string(), far, {}), mesh);
  robot.Write("arm_description/urdf/link.obj", kDentedCube);
  EXPECT_EQ(FindMesh("link.obj", near, {}), robot.folder() / "arm_description/urdf/link.obj");
}

TEST(LinkMesh, AMissingCollisionMeshIsAnErrorWithItsPlaceAndRemedy) {
  const RobotFolder robot;
  const std::string mesh = "package://arm_description/meshes/link.obj";
  EXPECT_THAT(ErrorOf(robot.Robot(mesh, "package://other/link.stl")),
              AllOf(HasSubstr("arm.urdf:2:"), HasSubstr("package://other/link.stl"),
                    HasSubstr("packages")));
  EXPECT_THAT(ErrorOf(robot.Robot(mesh, "package://arm_description/meshes/link.gltf")),
              HasSubstr("STL, OBJ, DAE or STEP"));
}

TEST(LinkMesh, AMeshThatIsOnlyDrawnMayHaveAnyFormat) {
  const RobotFolder robot;
  const RobotModel model = ReadUrdf(robot.Robot("package://arm_description/link.step",
                                                "package://arm_description/meshes/link.obj"));
  EXPECT_THAT(model.links.front().visuals, SizeIs(0));
  ASSERT_THAT(model.links.front().meshes, SizeIs(1));
  EXPECT_FALSE(model.links.front().meshes.front().for_collision);
}

TEST(LinkMesh, AFlatOrHugeMeshIsRefused) {
  const RobotFolder robot;
  robot.Write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  robot.Write("huge.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 200\nf 1 2 3\nf 1 2 4\n");
  const auto read = [&](const char* name, double scale) {
    return ReadLinkMesh(robot.folder() / name, Vector3::Constant(scale), MeshUse::kCollision);
  };
  EXPECT_THROW(read("flat.obj", 1), InputError);
  EXPECT_THROW(read("huge.obj", 1), InputError);
  EXPECT_NO_THROW(read("huge.obj", 0.001));
}

}  // namespace
}  // namespace assay::kinematics::link_mesh_test
