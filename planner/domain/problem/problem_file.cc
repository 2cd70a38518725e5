#include "planner/domain/problem/problem_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "planner/base/check.h"
#include "planner/base/digest.h"
#include "planner/base/input_files/input_file.h"
#include "planner/base/input_files/quotation.h"
#include "planner/domain/matings/mating_errors_file.h"
#include "planner/domain/parts/occlusion.h"
#include "planner/domain/parts/part_file.h"
#include "planner/domain/problem/goal_file.h"
#include "planner/domain/problem/initial_poses_file.h"
#include "planner/domain/problem/name.h"
#include "planner/domain/problem/pose_error_file.h"
#include "planner/domain/problem/tolerances_file.h"
#include "planner/domain/workcell/workcell_file.h"

namespace assay::domain {
namespace {

constexpr double kDefaultClearance = 0.0005;  // metres
constexpr Range kClearances = {1e-6, 0.01};   // metres
constexpr Range kClampForces = {0, 1e5};      // newtons

std::string ReadOptionalText(const Value& root, std::string_view key) {
  const std::optional<Value> text = root.Find(key);
  return text ? text->Text() : "";
}

// Scales an interval without producing -0, so that an error times 0 equals no error.
Interval Scaled(const Interval& interval, double scale) {
  return {scale * interval.low + 0.0, scale * interval.high + 0.0};
}

PoseError Scaled(const PoseError& error, double scale) {
  return {.x = Scaled(error.x, scale),
          .y = Scaled(error.y, scale),
          .z = Scaled(error.z, scale),
          .theta = Scaled(error.theta, scale)};
}

// Counts through the worlds, with each open pose as one digit. Returns false after the last world.
bool TurnToNextWorld(const Problem& world, Overrides& overrides) {
  for (auto open = world.open_poses.rbegin(); open != world.open_poses.rend(); ++open) {
    const bool is_last = open->chosen + 1 == std::ssize(open->names);
    overrides.poses[world.part(open->part).name] = is_last ? 0 : open->chosen + 1;
    if (!is_last) return true;
  }
  return false;
}

// Builds a problem from its file.
class ProblemFile {
 public:
  ProblemFile(const Document& scenario, const ModelPath& models, const Overrides& overrides);

  Problem Release() { return std::move(problem_); }

 private:
  struct Model {
    std::shared_ptr<const PartModel> part;
    std::shared_ptr<const std::vector<Grasp>> grasps;
  };

  void ReadClearance(const Value& root);
  PoseError ReadError(const Value& owner) const;
  void ReadWorkcell(const Value& root);
  void ReadParts(const Value& parts);
  void ReadPart(const std::string& name, const Value& entry);
  Model ReadModel(const Value& name);
  void ReadSensing(const Value& root);
  void ReadResolvers(const Value& root);

  ModelPath models_;
  Overrides overrides_;
  Units units_;
  Problem problem_;
  std::vector<std::string> known_models_;
  std::map<std::string, Model> loaded_;
};

ProblemFile::ProblemFile(const Document& scenario, const ModelPath& models,
                         const Overrides& overrides)
    : models_(models), overrides_(overrides) {
  ASSAY_CHECK(std::isfinite(overrides.error_scale) && overrides.error_scale >= 0);
  scenario.RequireFormat("assay-scenario/1");
  const Value& root = scenario.root();
  root.AllowOnly({"format",     "title",     "description",   "units",         "workcell",
                  "rules",      "clearance", "tolerances",    "parts",         "gripper",
                  "sensing",    "resolvers", "mating_errors", "initially",     "goal",
                  "simulation", "knowledge", "prices",        "distributions", "correlations"});
  // Both are shown on one line.
  problem_.name = Show(std::filesystem::path(root.Place().file).stem().string());
  problem_.title = Show(ReadOptionalText(root, "title"));
  problem_.description = ReadOptionalText(root, "description");
  units_ = ReadUnits(root);
  ReadClearance(root);
  ReadWorkcell(root);
  if (const auto gripper = root.Find("gripper")) {
    gripper->AllowOnly({"error"});
    problem_.gripper_error = ReadError(*gripper);
  }
  ReadSensing(root);
  ReadResolvers(root);
  // A scenario's `knowledge` section may be its only goal (sim/execution).
  const std::optional<Value> goals =
      root.Find("knowledge") ? root.Find("goal") : std::optional(root.At("goal"));
  ReadParts(root.At("parts"));
  if (const auto tolerances = root.Find("tolerances")) {
    problem_.tolerances = ReadTolerances(*tolerances, units_, problem_);
  }
  if (const auto errors = root.Find("mating_errors")) {
    problem_.mating_errors = ReadMatingErrors(*errors, units_);
  }
  ReadInitialPoses(root, units_, overrides_.poses, problem_);
  NoteOcclusions(problem_);
  if (goals) ReadGoals(*goals, units_, problem_);
}

void ProblemFile::ReadClearance(const Value& root) {
  const std::optional<Value> clearance = root.Find("clearance");
  if (!overrides_.clearance) {
    problem_.clearance =
        clearance ? ReadWithin(*clearance, units_.length, kClearances) : kDefaultClearance;
    return;
  }
  problem_.clearance = *overrides_.clearance;
  if (IsWithin(problem_.clearance, kClearances)) return;
  clearance.value_or(root).Fail(fmt::format("{} instead of this clearance is out of range",
                                            InUnit(problem_.clearance, kMetres)),
                                InUnit(kClearances, kMetres));
}

// Coordinates that are left out are known exactly.
PoseError ProblemFile::ReadError(const Value& owner) const {
  const std::optional<Value> given = owner.Find("error");
  if (!given) return {};
  const PoseError error = ReadPoseError(*given, units_, {});
  return overrides_.error_scale == 1 ? error : Scaled(error, overrides_.error_scale);
}

void ProblemFile::ReadWorkcell(const Value& root) {
  const Value name = root.At("workcell");
  name.OneOf(models_.Workcells());
  problem_.workcell = WorkcellFile::Read(models_.WorkcellFile(name.Text()));
  if (const auto rules = root.Find("rules")) {
    const Workcell& workcell = *problem_.workcell;
    problem_.workcell =
        workcell.WithRules(ReadRules(*rules, units_, workcell.gripper(), workcell.rules()));
  }
}

void ProblemFile::ReadParts(const Value& parts) {
  known_models_ = models_.Parts();
  if (parts.Entries().empty()) parts.Fail("there are no parts", "at least one part");
  for (const auto& [key, entry] : parts.Entries()) ReadPart(ReadName(key, "a part"), entry);
}

void ProblemFile::ReadPart(const std::string& name, const Value& entry) {
  entry.AllowOnly({"model", "pose", "error", "clamp"});
  Part part;
  part.name = name;
  part.error = ReadError(entry);
  if (const auto clamp = entry.Find("clamp"))
    part.clamp = ReadWithin(*clamp, kNewtons, kClampForces);
  const Model model = ReadModel(entry.At("model"));
  part.model = model.part;
  part.grasps = model.grasps;
  problem_.parts.push_back(std::move(part));
}

ProblemFile::Model ProblemFile::ReadModel(const Value& name) {
  name.OneOf(known_models_);
  const auto [model, is_new] = loaded_.try_emplace(name.Text());
  if (is_new) {
    model->second.part = PartFile::Load(models_.PartFile(name.Text()), problem_.clearance);
    const Workcell& workcell = *problem_.workcell;
    model->second.grasps = std::make_shared<const std::vector<Grasp>>(
        ComputeGrasps(*model->second.part, workcell.gripper(), GraspsIn(workcell)));
  }
  return model->second;
}

void ProblemFile::ReadSensing(const Value& root) {
  const std::optional<Value> sensing = root.Find("sensing");
  if (!sensing) return;
  std::vector<std::string> known;
  for (const SensorModel& sensor : problem_.workcell->uncertainty_operations().sensors) {
    known.push_back(sensor.name);
  }
  for (const Value& item : sensing->Items()) {
    if (known.empty()) {
      item.Fail(fmt::format("the workcell '{}' has no sensor", problem_.workcell->name()), "[]");
    }
    const std::string& sensor = known[item.OneOf(known)];
    if (std::ranges::find(problem_.sensors, sensor) != problem_.sensors.end()) {
      item.Fail(fmt::format("'{}' is given twice", sensor), "each sensor once");
    }
    problem_.sensors.push_back(sensor);
  }
}

// Reads the resolvers that the planner may use. Without this key, it may use all of them. Their
// order in the file has no meaning: the planner tries them in the order of ResolverKind.
void ProblemFile::ReadResolvers(const Value& root) {
  problem_.resolvers = {ResolverKind::kSensing, ResolverKind::kSqueezing,
                        ResolverKind::kFineMotion};
  if (const std::optional<Value> resolvers = root.Find("resolvers")) {
    problem_.resolvers.clear();
    for (const Value& item : resolvers->Items()) {
      const auto kind = static_cast<ResolverKind>(item.OneOf(ResolverNames()));
      if (std::ranges::count(problem_.resolvers, kind) > 0) {
        item.Fail(fmt::format("'{}' is given twice", item.Text()), "each resolver once");
      }
      problem_.resolvers.push_back(kind);
    }
    if (problem_.resolvers.empty()) {
      resolvers->Fail("no resolver",
                      fmt::format("at least one of {}", fmt::join(ResolverNames(), ", ")));
    }
  }
  if (overrides_.resolvers) problem_.resolvers = *overrides_.resolvers;
  std::ranges::sort(problem_.resolvers);
}

// Different overrides have different texts.
std::string OverridesText(const Overrides& overrides) {
  std::string text = fmt::format("error scale {}", overrides.error_scale);
  if (overrides.clearance) text += fmt::format(", clearance {}", *overrides.clearance);
  if (overrides.resolvers) {
    text += ", resolvers";
    for (const ResolverKind kind : *overrides.resolvers) {
      text += " " + ResolverNames()[static_cast<std::size_t>(kind)];
    }
  }
  for (const auto& [part, pose] : overrides.poses) text += fmt::format(", pose {} {}", pose, part);
  return text;
}

}  // namespace

Problem ReadProblem(const Document& scenario, const ModelPath& models) {
  return ReadProblem(scenario, models, {});
}

Problem ReadProblem(const Document& scenario, const ModelPath& models, const Overrides& overrides) {
  const FilesRead files;
  Problem problem = ProblemFile(scenario, models, overrides).Release();
  problem.origin =
      Digest().Add(scenario.digest()).Add(files.Digest()).Add(OverridesText(overrides)).Hex();
  return problem;
}

std::vector<Problem> ReadWorlds(const Document& scenario, const ModelPath& models,
                                const Overrides& overrides) {
  std::vector<Problem> worlds;
  Overrides next = overrides;
  do {
    worlds.push_back(ReadProblem(scenario, models, next));
    if (std::ssize(worlds) > kMostWorlds) {
      scenario.root().At("parts").Fail(fmt::format("more than {} worlds", kMostWorlds),
                                       "fewer parts whose pose is open");
    }
  } while (TurnToNextWorld(worlds.back(), next));
  return worlds;
}

}  // namespace assay::domain
