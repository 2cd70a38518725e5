#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "planner/base/id.h"
#include "planner/base/input_files/input_error.h"
#include "planner/geometry/coordinates.h"

namespace assay::geometry {
struct ConvexHull;
}  // namespace assay::geometry

namespace assay::kinematics {

using geometry::Matrix3;
using geometry::Pose;
using geometry::Vector3;

struct LinkTag;
struct JointTag;
using LinkId = Id<LinkTag>;
using JointId = Id<JointTag>;

// The tolerance, in metres and radians, within which a file must have the required geometry.
inline constexpr double kFileTolerance = 1e-9;

// Boxes, cylinders and spheres are centred at the origin of their frame. The axis of a cylinder is
// z. Lengths are in metres.
struct BoxShape {
  Vector3 size = Vector3::Zero();  // full edge lengths
};
struct CylinderShape {
  double radius = 0;
  double length = 0;
};
struct SphereShape {
  double radius = 0;
};
// The convex hull of a mesh, or of a piece of it.
struct HullShape {
  std::shared_ptr<const geometry::ConvexHull> hull;
};
using Shape = std::variant<BoxShape, CylinderShape, SphereShape, HullShape>;

struct Rgba {
  double red = 0.5;
  double green = 0.5;
  double blue = 0.5;
  double alpha = 1;
};

struct Visual {
  std::string name;  // may be empty
  Pose X_LinkShape = Pose::Identity();
  Shape shape;
  Rgba color;  // grey if the file gives no colour
};

struct Collision {
  std::string name;  // may be empty
  Pose X_LinkShape = Pose::Identity();
  Shape shape;
};

// A mesh that a link names and that is not read.
struct MeshReference {
  std::string file;  // as in the URDF file, for example package://robot/meshes/base.stl
  bool for_collision = false;
};

// How well the convex pieces of a collision mesh fit it.
struct MeshFit {
  std::string file;  // as in the URDF file
  std::size_t pieces = 1;
  std::optional<double> volume_ratio = {};  // pieces to mesh; none if the mesh is not closed
};

struct Inertial {
  double mass = 0;                        // kg
  Pose X_LinkCenter = Pose::Identity();   // the centre of mass and the axes of `inertia`
  Matrix3 inertia = Matrix3::Identity();  // about the centre of mass, kg m^2
};

struct Link {
  std::string name;
  JointId parent_joint = JointId::None();  // None for the root
  std::optional<Inertial> inertial = {};   // nothing for a massless frame
  bool inertial_is_derived = false;        // from the collision shapes (derived_inertia.h)
  std::vector<Visual> visuals = {};
  std::vector<Collision> collisions = {};
  std::vector<MeshReference> meshes = {};  // those that are not read (ReadUrdf)
  std::vector<MeshFit> fits = {};          // of the collision meshes that are read
  FilePlace place = {};
};

enum class JointType { kFixed, kRevolute, kPrismatic };

// The units are radians for revolute joints and metres for prismatic ones. Velocity and effort are
// magnitudes.
struct JointLimits {
  double lower = 0;
  double upper = 0;
  double velocity = 0;  // rad/s or m/s
  double effort = 0;    // N m or N
};

struct Joint {
  std::string name;
  JointType type = JointType::kFixed;
  LinkId parent;
  LinkId child;
  Pose X_ParentJoint = Pose::Identity();  // the child's frame in the parent's at joint value 0
  Vector3 axis = Vector3::UnitZ();        // unit vector in the child's frame; unused if fixed
  JointLimits limits = {};                // zeros if fixed
  std::string mimics = {};                // the joint that moves it; empty if it moves by itself
  double multiplier = 1;                  // of the value of the joint that moves it
  FilePlace place = {};

  // Returns the pose of the child's frame in the parent's at a joint value. A fixed joint ignores
  // the value.
  Pose X_ParentChild(double value) const;
};

// The contents of a robot's URDF file as plain data. Parents come before their children: links[0]
// is the root, and joints[i] leads to links[i + 1].
struct RobotModel {
  FilePlace place;  // the place of the robot in its file
  std::string name;
  std::vector<Link> links;
  std::vector<Joint> joints;

  const Link& link(LinkId id) const { return links[static_cast<std::size_t>(id.index())]; }
  const Joint& joint(JointId id) const { return joints[static_cast<std::size_t>(id.index())]; }
  LinkId FindLink(std::string_view link_name) const;     // None if there is no such link
  JointId FindJoint(std::string_view joint_name) const;  // None if there is no such joint

  // Throws an InputError that concerns the robot as a whole.
  [[noreturn]] void Fail(const std::string& what, const std::string& allowed = "") const;
};

// What a reader needs of a URDF file.
enum class UrdfContents {
  kBodies,  // all of it, for collision and physics
  kAxes,    // the axes of the joints
};

// Reads a URDF file without xacro. Joints are fixed, revolute or prismatic. Throws InputError, with
// line and column, if the file cannot be read, is not URDF, or contains something unsupported or
// impossible: missing joint limits, a negative mass, an inertia that no body has, a shape without
// extent, or lengths over 100 m.
//
// A mesh in a file that mesh_import reads becomes its convex hull, or several convex pieces
// (ReadLinkMesh). Continuous joints are revolute, with limits of one turn either way. An effort of
// 0 of a revolute joint stands for an unknown one. `packages` are folders in which packages of
// meshes lie (FindMesh). A mesh for collision that is not found or has another format is an error.
// Such a mesh that is only drawn is noted.
//
// With kAxes, more files are accepted. All meshes are noted and none is read. An inertia that no
// body has is left out. Any joint may mimic another; else only prismatic joints may, and only with
// the same distance. Velocities may be 0, for unknown.
RobotModel ReadUrdf(const std::filesystem::path& file,
                    UrdfContents contents = UrdfContents::kBodies,
                    std::span<const std::filesystem::path> packages = {});

}  // namespace assay::kinematics
