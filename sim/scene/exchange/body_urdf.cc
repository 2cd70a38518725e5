#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/scene/exchange/body_obj.h"
#include "sim/scene/exchange/exported_body.h"
#include "sim/scene/xml_element.h"

namespace assay::scene {
namespace {

using geometry::Pose;
using geometry::Vector3;

// URDF turns by roll, pitch and yaw about the fixed axes x, y and z.
void SetOrigin(const Pose& pose, XmlElement& element) {
  const geometry::Matrix3& R = pose.linear();
  const double roll = std::atan2(R(2, 1), R(2, 2));
  const double pitch = std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2)));
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  element.Add("origin").Set("xyz", pose.translation()).Set("rpy", Vector3(roll, pitch, yaw));
}

void AddInertial(const geometry::MassProperties& mass, XmlElement& link) {
  XmlElement& inertial = link.Add("inertial");
  SetOrigin(Pose(Eigen::Translation3d(mass.center)), inertial);
  inertial.Add("mass").Set("value", mass.mass);
  const geometry::Matrix3& I = mass.inertia;
  inertial.Add("inertia")
      .Set("ixx", I(0, 0))
      .Set("ixy", I(0, 1))
      .Set("ixz", I(0, 2))
      .Set("iyy", I(1, 1))
      .Set("iyz", I(1, 2))
      .Set("izz", I(2, 2));
}

// Adds the link of a part to the robot, and the meshes of its pieces to `files`.
void AddLink(const ExportedBody& body, const std::string& name, XmlElement& robot,
             std::vector<ExportedFile>& files) {
  XmlElement& link = robot.Add("link").Set("name", body.name);
  AddInertial(body.model->mass(), link);
  for (std::size_t i = 0; i < body.model->pieces().size(); ++i) {
    const geometry::ConvexHull& piece = body.model->pieces()[i];
    const std::string piece_name = fmt::format("{}-{}-{}", name, body.name, i + 1);
    const std::optional<geometry::Box> box = geometry::AsBox(piece);
    if (!box) files.push_back({piece_name + ".obj", PieceToObj(piece_name, piece)});
    for (const char* use : {"visual", "collision"}) {
      XmlElement& shape = link.Add(use);
      SetOrigin(box ? box->X_FrameBox : Pose::Identity(), shape);
      XmlElement& geometry = shape.Add("geometry");
      if (box) {
        geometry.Add("box").Set("size", Vector3(2 * box->half_extents));
      } else {
        geometry.Add("mesh").Set("filename", piece_name + ".obj");
      }
    }
  }
}

void AddJoint(const ExportedBody& root, const ExportedBody& body, XmlElement& robot) {
  XmlElement& joint =
      robot.Add("joint").Set("name", body.name).Set("type", body.is_fixed ? "fixed" : "floating");
  SetOrigin(root.X_WorldPart.inverse() * body.X_WorldPart, joint);
  joint.Add("parent").Set("link", root.name);
  joint.Add("child").Set("link", body.name);
}

}  // namespace

std::vector<ExportedFile> BodiesToUrdf(const std::string& name,
                                       const std::vector<ExportedBody>& bodies) {
  XmlElement robot("robot");
  robot.Set("name", name);
  std::vector<ExportedFile> files = {{name + ".urdf", {}}};
  for (const ExportedBody& body : bodies) AddLink(body, name, robot, files);
  for (std::size_t i = 1; i < bodies.size(); ++i) AddJoint(bodies[0], bodies[i], robot);
  files.front().text = robot.Text();
  return files;
}

}  // namespace assay::scene
