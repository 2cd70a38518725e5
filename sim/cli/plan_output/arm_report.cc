#include "sim/cli/plan_output/arm_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "planner/base/input_files/input_error.h"
#include "planner/kinematics/arm.h"
#include "planner/kinematics/inverse/arm_survey.h"
#include "sim/cli/options/quantity.h"
#include "sim/cli/plan_output/arm_notes.h"
#include "sim/cli/plan_output/table.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using kinematics::ArmSurvey;
using kinematics::ChainJoint;
using kinematics::Link;
using kinematics::RobotModel;
using kinematics::SerialChain;

// What the simulation needs of an arm and the file lacks: names of links and joints.
struct MissingForPhysics {
  std::vector<std::string> inertias;
  std::vector<std::string> collision_shapes;
  std::vector<std::string> speeds;
  std::vector<std::string> efforts;

  MissingForPhysics(const RobotModel& model, const SerialChain& chain) {
    for (const kinematics::LinkId id : chain.links()) {
      const Link& link = model.link(id);
      const bool moves = !link.parent_joint.IsNone() &&
                         model.joint(link.parent_joint).type == kinematics::JointType::kRevolute;
      if (moves && !link.inertial) inertias.push_back(link.name);
      const bool has_shape =
          !link.collisions.empty() ||
          std::ranges::any_of(link.meshes, &kinematics::MeshReference::for_collision);
      if (moves && !has_shape) collision_shapes.push_back(link.name);
    }
    for (const ChainJoint& joint : chain.joints()) {
      if (!(joint.limits.velocity > 0)) speeds.push_back(joint.name);
      if (!(joint.limits.effort > 0)) efforts.push_back(joint.name);
    }
  }

  std::string Text() const {
    std::string text;
    const auto add = [&](const char* what, const std::vector<std::string>& names) {
      if (!names.empty()) text += fmt::format("  {}: {}\n", what, fmt::join(names, ", "));
    };
    add("links without a possible mass and inertia (derived from collision shapes if there are "
        "any)",
        inertias);
    add("links without a collision shape", collision_shapes);
    add("joints without a speed", speeds);
    add("joints without a torque (not limited)", efforts);
    return text.empty() ? "Nothing is missing for physics.\n" : "Missing for physics:\n" + text;
  }
};

// What becomes of the arm in a workcell.
struct WorkcellAnswer {
  std::string reason;  // why a workcell cannot have it; empty if it can
  std::string notes;   // ArmNotes
};

WorkcellAnswer AskWorkcell(const ArmRequest& request, const kinematics::LockedJoints& locked) {
  try {
    const auto arm = kinematics::Arm::FromUrdf(request.file, {request.base, request.tip, locked},
                                               request.packages);
    return {.reason = "", .notes = ArmNotes(arm.model())};
  } catch (const InputError& error) {
    return {.reason = error.what(), .notes = ""};
  }
}

std::string LockedText(const kinematics::LockedJoints& locked) {
  std::string text;
  for (const auto& [joint, value] : locked) {
    text += fmt::format("    locked: {{{}: {:.6g}}}  # degrees\n", joint, value / kDegree);
  }
  return text;
}

std::string WorkcellText(const ArmRequest& request, const SerialChain& chain,
                         const kinematics::LockedJoints& locked, const std::string& reason) {
  if (!reason.empty()) return fmt::format("A workcell refuses this arm:\n  {}\n", reason);
  return fmt::format(
      "Write into a workcell (lengths in metres in the world, whose origin is on the table's top; "
      "joint values in the workcell's unit of angles):\n"
      "  robot:\n"
      "    urdf: {}\n"
      "    links: {{base: {}, flange: {}}}\n{}"
      "    base: {{columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-0.15, 0, 0.70]]}}\n"
      "    home: [0, 0, 0, 0, 0, 0]  # a posture with the tool straight down over the table\n"
      "    acceleration: [150, 150, 150, 300, 300, 300]  # of each joint, per second squared\n",
      request.file.filename().string(), chain.base(), chain.tip(), LockedText(locked));
}

std::string JointTable(const SerialChain& chain) {
  Table table({{"joint"},
               {"lower deg", Align::kRight},
               {"upper deg", Align::kRight},
               {"deg/s", Align::kRight},
               {"N m", Align::kRight}});
  for (const ChainJoint& joint : chain.joints()) {
    table.Add({joint.name, fmt::format("{:.1f}", joint.limits.lower / kDegree),
               fmt::format("{:.1f}", joint.limits.upper / kDegree),
               fmt::format("{:.1f}", joint.limits.velocity / kDegree),
               fmt::format("{:g}", joint.limits.effort)});
  }
  return table.Text();
}

const char* HowSolved(const kinematics::ArmClass& arm) {
  if (arm.kind == kinematics::ArmKind::kGeneral) return "a search over the values of one joint";
  return arm.IsExact() ? "a closed form" : "Newton's method from the closed form of the class";
}

std::string SolutionsText(const ArmSurvey& survey) {
  std::string text =
      fmt::format("class: {}; solved by {}\n", survey.description, HowSolved(survey.arm));
  if (!survey.locked_joint.empty()) {
    text +=
        fmt::format("The joint {} is redundant: for each of its values, all solutions are found.\n",
                    survey.locked_joint);
  }
  text += fmt::format(
      "A pose has {} to {} solutions, {:.1f} on average, of which {:.1f} are within the limits.\n",
      survey.fewest, survey.most, survey.mean, survey.mean_within_limits);
  text += fmt::format(
      "In {} random postures within the limits, the solutions reach the pose of the tip to within "
      "{:.1e} (metres, or entries of the rotation matrix). The posture itself is among the "
      "solutions to within {:.1e} rad.\n",
      survey.poses, survey.pose_error, survey.return_error);
  if (survey.not_returned > 0) {
    text += fmt::format("{} postures are not among the solutions of their poses.\n",
                        survey.not_returned);
  }
  text += fmt::format(
      "The tip is {:.3f} to {:.3f} m away from the base's origin, at heights from {:.3f} to {:.3f} "
      "m "
      "(20000 random postures).\nSingular postures:\n",
      survey.nearest, survey.farthest, survey.lowest, survey.highest);
  for (const std::string& sentence : survey.singular) text += fmt::format("  {}\n", sentence);
  return text;
}

Json JointsJson(const SerialChain& chain) {
  Json joints = Json::array();
  const auto numbers = [](const geometry::Vector3& v) {
    return Json::array({v.x(), v.y(), v.z()});
  };
  for (const ChainJoint& joint : chain.joints()) {
    joints.push_back({{"name", joint.name},
                      {"direction", numbers(joint.axis.direction)},
                      {"point", numbers(joint.axis.point)},
                      {"lower", joint.limits.lower},
                      {"upper", joint.limits.upper},
                      {"velocity", joint.limits.velocity},
                      {"effort", joint.limits.effort}});
  }
  return joints;
}

Json SurveyJson(const ArmSurvey& survey) {
  Json json = {{"class", survey.description},
               {"closed_form", survey.arm.kind != kinematics::ArmKind::kGeneral},
               {"deviation", survey.arm.deviation}};
  if (!survey.locked_joint.empty()) json["redundant_joint"] = survey.locked_joint;
  json.update(Json{{"poses", survey.poses},
                   {"solutions",
                    {{"fewest", survey.fewest},
                     {"most", survey.most},
                     {"mean", survey.mean},
                     {"mean_within_limits", survey.mean_within_limits}}},
                   {"pose_error", survey.pose_error},
                   {"return_error", survey.return_error},
                   {"not_returned", survey.not_returned},
                   {"reach", {{"nearest", survey.nearest}, {"farthest", survey.farthest}}},
                   {"height", {{"lowest", survey.lowest}, {"highest", survey.highest}}},
                   {"singular", survey.singular}});
  return json;
}

}  // namespace

Report ReportOnArm(const ArmRequest& request) {
  const RobotModel model = kinematics::ReadUrdf(request.file, kinematics::UrdfContents::kAxes);
  const SerialChain chain = SerialChain::FromModel(model, request.base, request.tip);
  const ArmSurvey survey = Survey(chain, request.poses, request.seed);
  const MissingForPhysics missing(model, chain);
  const std::vector<kinematics::LockedJoints> lockings =
      kinematics::Lockings(model, request.base, request.tip);
  const kinematics::LockedJoints locked =
      lockings.empty() ? kinematics::LockedJoints() : lockings.front();
  const auto [reason, notes] = AskWorkcell(request, locked);
  Json json = {{"robot", model.name},
               {"base", chain.base()},
               {"tip", chain.tip()},
               {"joints", JointsJson(chain)}};
  json.update(SurveyJson(survey));
  json["missing"] = {{"inertias", missing.inertias},
                     {"collision_shapes", missing.collision_shapes},
                     {"speeds", missing.speeds},
                     {"efforts", missing.efforts}};
  json["workcell_refuses"] = reason;
  if (!locked.empty()) json["locked"] = locked;
  return {.text = fmt::format("robot {} from link {} to link {}\n\n{}\n{}{}{}{}", model.name,
                              chain.base(), chain.tip(), JointTable(chain), SolutionsText(survey),
                              missing.Text(), notes, WorkcellText(request, chain, locked, reason)),
          .json = std::make_shared<const Json>(std::move(json)),
          .holds = survey.pose_error < 1e-9 && survey.not_returned == 0};
}

}  // namespace assay::cli
