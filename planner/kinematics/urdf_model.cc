#include "planner/kinematics/urdf_model.h"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Eigenvalues>
#include <mutex>
#include <numbers>
#include <tuple>

#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/input_file.h"
#include "planner/kinematics/meshes/link_mesh.h"
#include "planner/kinematics/xml_outline.h"
#include "planner/mesh_import/files/mesh_file.h"

namespace assay::kinematics {
namespace {

// Collects the errors that urdfdom would print to standard error. They become the text of an
// InputError.
class ErrorCollector : public console_bridge::OutputHandler {
 public:
  ErrorCollector() { console_bridge::useOutputHandler(this); }
  ~ErrorCollector() override { console_bridge::restorePreviousOutputHandler(); }
  ErrorCollector(const ErrorCollector&) = delete;
  ErrorCollector& operator=(const ErrorCollector&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char* /*filename*/,
           int /*line*/) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    if (!errors_.empty()) errors_ += "; ";
    errors_ += text;
  }

  const std::string& errors() const { return errors_; }

 private:
  std::string errors_;
};

// Values beyond these limits are mistakes, and would overflow later. Units are metres, radians,
// kilograms, their products, and changes per second.
constexpr double kLeastExtent = 1e-6;
constexpr double kMostLength = 100;
constexpr double kMostAngle = 4 * std::numbers::pi;
constexpr double kEndlessAngle = 2 * std::numbers::pi;  // limit of a continuous joint
constexpr double kMostMass = 1e5;
constexpr double kMostVelocity = 1e3;
constexpr double kMostEffort = 1e6;
constexpr std::size_t kMostLinks = 1000;

urdf::ModelInterfaceSharedPtr Parse(const std::string& text, const XmlOutline& outline) {
  // console_bridge has one output handler for the whole process, so only one file is read at a
  // time.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const ErrorCollector collector;
  urdf::ModelInterfaceSharedPtr parsed = urdf::parseURDF(text);
  if (!parsed || !parsed->getRoot() || !collector.errors().empty()) {
    throw InputError(outline.PlaceOfMention(collector.errors()),
                     fmt::format("is not a URDF file: {}", collector.errors()), "");
  }
  return parsed;
}

Vector3 ToVector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

// Where the files of meshes are searched for (FindMesh).
struct MeshPlaces {
  const std::filesystem::path& urdf;
  std::span<const std::filesystem::path> packages;
};

// Converts urdfdom's tree into a RobotModel, depth first. Every error gives the place of its link
// or joint.
class Converter {
 public:
  Converter(const XmlOutline& outline, const urdf::ModelInterface& parsed, UrdfContents contents,
            const MeshPlaces& mesh_places)
      : outline_(outline), only_axes_(contents == UrdfContents::kAxes), mesh_places_(mesh_places) {
    model_.place = outline.root();
    model_.name = parsed.getName();
    if (parsed.links_.size() > kMostLinks) {
      Fail(fmt::format("has {} links", parsed.links_.size()), fmt::format("{} links", kMostLinks));
    }
    AddLink(*parsed.getRoot(), JointId::None());
  }

  RobotModel Take() { return std::move(model_); }

 private:
  [[noreturn]] void Fail(const std::string& what, const std::string& allowed = "") const {
    throw InputError(at_, what, allowed);
  }

  Pose ToPose(const urdf::Pose& pose) const {
    const urdf::Rotation& r = pose.rotation;
    Pose X = Pose::Identity();
    X.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
    X.translation() = ToVector(pose.position);
    const double farthest = X.translation().cwiseAbs().maxCoeff();
    if (!(farthest <= kMostLength) || !X.translation().allFinite() || !X.linear().allFinite()) {
      Fail(fmt::format("an origin at ({}, {}, {}) m", pose.position.x, pose.position.y,
                       pose.position.z),
           fmt::format("lengths of at most {} m either way", kMostLength));
    }
    return X;
  }

  void AddLink(const urdf::Link& parsed, JointId parent_joint) {
    const LinkId id(model_.links.size());
    at_ = outline_.PlaceOf("link", parsed.name);
    model_.links.push_back(ConvertLink(parsed, parent_joint));
    for (const urdf::JointSharedPtr& joint : parsed.child_joints) AddJoint(parsed, *joint, id);
  }

  void AddJoint(const urdf::Link& parent, const urdf::Joint& parsed, LinkId parent_id) {
    const JointId id(model_.joints.size());
    at_ = outline_.PlaceOf("joint", parsed.name);
    model_.joints.push_back(ConvertJoint(parsed, parent_id));
    for (const urdf::LinkSharedPtr& child : parent.child_links) {
      if (child->name == parsed.child_link_name) AddLink(*child, id);
    }
  }

  Link ConvertLink(const urdf::Link& parsed, JointId parent_joint) const {
    Link link{.name = parsed.name, .parent_joint = parent_joint, .place = at_};
    if (parsed.inertial) link.inertial = InertialOf(*parsed.inertial, parsed.name);
    for (const urdf::VisualSharedPtr& visual : parsed.visual_array) {
      if (NotesMesh(visual->geometry, false, link)) continue;
      for (Shape& shape : ConvertShape(visual->geometry, MeshUse::kDrawing, link)) {
        link.visuals.push_back(
            {visual->name, ToPose(visual->origin), std::move(shape), ColorOf(*visual)});
      }
    }
    for (const urdf::CollisionSharedPtr& collision : parsed.collision_array) {
      if (NotesMesh(collision->geometry, true, link)) continue;
      for (Shape& shape : ConvertShape(collision->geometry, MeshUse::kCollision, link)) {
        link.collisions.push_back({collision->name, ToPose(collision->origin), std::move(shape)});
      }
    }
    return link;
  }

  // Returns true if the shape is a mesh that is not read.
  bool NotesMesh(const urdf::GeometrySharedPtr& parsed, bool for_collision, Link& link) const {
    const auto* mesh = dynamic_cast<const urdf::Mesh*>(parsed.get());
    if (!mesh) return false;
    const bool is_read = !only_axes_ && (for_collision || FileOf(*mesh));
    if (!is_read) link.meshes.push_back({mesh->filename, for_collision});
    return !is_read;
  }

  // Returns the file of a mesh that can be read.
  std::optional<std::filesystem::path> FileOf(const urdf::Mesh& mesh) const {
    if (!mesh_import::IsMeshFile(mesh.filename)) return std::nullopt;
    return FindMesh(mesh.filename, mesh_places_.urdf, mesh_places_.packages);
  }

  std::vector<Shape> ConvertMesh(const urdf::Mesh& mesh, MeshUse use, Link& link) const {
    if (const auto file = FileOf(mesh)) {
      const LinkMesh read = ReadLinkMesh(*file, ToVector(mesh.scale), use);
      if (use == MeshUse::kCollision) {
        link.fits.push_back({mesh.filename, read.pieces.size(), read.volume_ratio});
      }
      std::vector<Shape> shapes;
      for (const auto& piece : read.pieces) shapes.push_back(HullShape{piece});
      return shapes;
    }
    const bool is_unknown = !mesh_import::IsMeshFile(mesh.filename);
    Fail(fmt::format("link '{}' has the collision mesh '{}', {}", link.name, mesh.filename,
                     is_unknown ? "whose format is not read" : "and there is no such file"),
         is_unknown ? "STL, OBJ, DAE or STEP files"
                    : "a path from the file's folder, or a package in one of the folders around it "
                      "or in one that the workcell names (packages)");
  }

  std::optional<Inertial> InertialOf(const urdf::Inertial& parsed, const std::string& link) const {
    if (!only_axes_) return ConvertInertial(parsed, link);
    try {
      return ConvertInertial(parsed, link);
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  static Rgba ColorOf(const urdf::Visual& visual) {
    if (!visual.material) return {};
    const urdf::Color& c = visual.material->color;
    return {c.r, c.g, c.b, c.a};
  }

  Inertial ConvertInertial(const urdf::Inertial& parsed, const std::string& link) const {
    Inertial inertial{.mass = parsed.mass, .X_LinkCenter = ToPose(parsed.origin)};
    inertial.inertia << parsed.ixx, parsed.ixy, parsed.ixz,  //
        parsed.ixy, parsed.iyy, parsed.iyz,                  //
        parsed.ixz, parsed.iyz, parsed.izz;
    if (!(parsed.mass > 0 && parsed.mass <= kMostMass)) {
      Fail(fmt::format("link '{}' has a mass of {} kg", link, parsed.mass),
           fmt::format("a positive mass, at most {} kg", kMostMass));
    }
    // The principal moments of a body are positive, and none exceeds the sum of the other two.
    const double most = kMostMass * kMostLength * kMostLength;
    if (!(inertial.inertia.cwiseAbs().maxCoeff() <= most) || !inertial.inertia.allFinite()) {
      Fail(fmt::format("link '{}' has an inertia that is too large", link),
           fmt::format("at most {} kg m^2", most));
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(inertial.inertia, Eigen::EigenvaluesOnly);
    const Vector3& moments = solver.eigenvalues();  // in ascending order
    if (!(moments[0] > 0) || moments[2] > (moments[0] + moments[1]) * (1 + 1e-9)) {
      Fail(fmt::format("link '{}' has principal moments of inertia {}, {}, {} kg m^2", link,
                       moments[0], moments[1], moments[2]),
           "positive moments, the largest at most the sum of the others");
    }
    return inertial;
  }

  // Returns several shapes for a mesh with dents, else one.
  std::vector<Shape> ConvertShape(const urdf::GeometrySharedPtr& parsed, MeshUse use,
                                  Link& link) const {
    if (const auto* box = dynamic_cast<const urdf::Box*>(parsed.get())) {
      return {BoxShape{Extent(ToVector(box->dim), link.name)}};
    }
    if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(parsed.get())) {
      Extent({cylinder->radius, cylinder->radius, cylinder->length}, link.name);
      return {CylinderShape{cylinder->radius, cylinder->length}};
    }
    if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(parsed.get())) {
      return {SphereShape{Extent(Vector3::Constant(sphere->radius), link.name).x()}};
    }
    if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(parsed.get())) {
      return ConvertMesh(*mesh, use, link);
    }
    Fail(fmt::format("link '{}' has a shape that is not supported", link.name),
         "box, cylinder, sphere, mesh");
  }

  Vector3 Extent(const Vector3& extent, const std::string& link) const {
    for (const double length : extent) {
      if (length >= kLeastExtent && length <= kMostLength) continue;
      Fail(fmt::format("link '{}' has a shape of extent {} m", link, length),
           fmt::format("positive extents, {} m to {} m", kLeastExtent, kMostLength));
    }
    return extent;
  }

  Joint ConvertJoint(const urdf::Joint& parsed, LinkId parent) const {
    Joint joint{.name = parsed.name,
                .type = TypeOf(parsed),
                .parent = parent,
                .child = LinkId(model_.links.size()),
                .X_ParentJoint = ToPose(parsed.parent_to_joint_origin_transform),
                .place = at_};
    if (joint.type == JointType::kFixed) return joint;
    joint.axis = ToVector(parsed.axis);
    if (!(joint.axis.norm() > 1e-6)) {
      Fail(fmt::format("joint '{}' has an axis without direction", joint.name));
    }
    joint.axis.normalize();
    if (parsed.mimic) {
      joint.mimics = parsed.mimic->joint_name;
      joint.multiplier = parsed.mimic->multiplier;
    }
    joint.limits = LimitsOf(parsed);
    return joint;
  }

  // The fingers of a gripper move as far as each other.
  void RequireSameMotion(const urdf::Joint& parsed) const {
    const bool is_finger = parsed.type == urdf::Joint::PRISMATIC;
    if (is_finger && std::abs(parsed.mimic->multiplier) == 1 && parsed.mimic->offset == 0) return;
    Fail(fmt::format("joint '{}' mimics '{}'", parsed.name, parsed.mimic->joint_name),
         "only prismatic joints of fingers that move as far as the other (multiplier 1 or -1, no "
         "offset)");
  }

  JointType TypeOf(const urdf::Joint& parsed) const {
    if (parsed.mimic && !only_axes_) RequireSameMotion(parsed);
    if (parsed.type == urdf::Joint::FIXED) return JointType::kFixed;
    if (parsed.type == urdf::Joint::REVOLUTE) return JointType::kRevolute;
    if (parsed.type == urdf::Joint::CONTINUOUS) return JointType::kRevolute;
    if (parsed.type == urdf::Joint::PRISMATIC) return JointType::kPrismatic;
    Fail(fmt::format("joint '{}' has a type that is not supported", parsed.name),
         "fixed, revolute, continuous, prismatic");
  }

  JointLimits LimitsOf(const urdf::Joint& parsed) const {
    const bool endless = parsed.type == urdf::Joint::CONTINUOUS;
    if (!parsed.limits && !endless) Fail(fmt::format("joint '{}' has no limits", parsed.name));
    auto [lower, upper, effort, velocity] = parsed.limits ? *parsed.limits : urdf::JointLimits{};
    if (endless) std::tie(lower, upper) = std::pair(-kEndlessAngle, kEndlessAngle);
    const bool is_revolute = parsed.type != urdf::Joint::PRISMATIC;
    const char* const unit = is_revolute ? "rad" : "m";
    const double most = is_revolute ? kMostAngle : kMostLength;
    const bool is_range = lower < upper && lower >= -most && upper <= most;
    const bool is_power = IsPower(velocity, kMostVelocity, only_axes_) &&
                          IsPower(effort, kMostEffort, only_axes_ || is_revolute);
    if (!is_range || !is_power) {
      Fail(
          fmt::format("joint '{0}' has lower {2} {1}, upper {3} {1}, velocity {4} {1}/s, "
                      "effort {5} {6}",
                      parsed.name, unit, lower, upper, velocity, effort, is_revolute ? "N m" : "N"),
          fmt::format("lower below upper, both from {1:.4g} {0} to {2:.4g} {0}; velocity positive, "
                      "at most {3} {0}/s; effort positive{6}, at most {4} {5}",
                      unit, -most, most, kMostVelocity, kMostEffort, is_revolute ? "N m" : "N",
                      is_revolute ? ", or 0 if it is unknown" : ""));
    }
    return {lower, upper, velocity, effort};
  }

  static bool IsPower(double value, double most, bool may_be_unknown) {
    return (value > 0 || (may_be_unknown && value == 0)) && value <= most;
  }

  const XmlOutline& outline_;
  bool only_axes_;
  const MeshPlaces& mesh_places_;
  FilePlace at_ = outline_.root();  // the element that is being converted
  RobotModel model_;
};

template <class Named>
int IndexOf(const std::vector<Named>& list, std::string_view name) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

Pose Joint::X_ParentChild(double value) const {
  switch (type) {
    case JointType::kFixed:
      return X_ParentJoint;
    case JointType::kRevolute:
      return X_ParentJoint * Eigen::AngleAxisd(value, axis);
    case JointType::kPrismatic:
      return X_ParentJoint * Eigen::Translation3d(value * axis);
  }
  return X_ParentJoint;
}

LinkId RobotModel::FindLink(std::string_view link_name) const {
  return LinkId(IndexOf(links, link_name));
}

JointId RobotModel::FindJoint(std::string_view joint_name) const {
  return JointId(IndexOf(joints, joint_name));
}

void RobotModel::Fail(const std::string& what, const std::string& allowed) const {
  throw InputError(place, what, allowed);
}

RobotModel ReadUrdf(const std::filesystem::path& file, UrdfContents contents,
                    std::span<const std::filesystem::path> packages) {
  const std::string text = ReadInput(file, "a URDF file");
  RequireText(text, file.string());
  const XmlOutline outline(text, file.string());
  return Converter(outline, *Parse(text, outline), contents, {file, packages}).Take();
}

}  // namespace assay::kinematics
