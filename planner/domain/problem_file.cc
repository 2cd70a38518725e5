#include "planner/domain/problem_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

#include "planner/base/check.h"
#include "planner/domain/mating_errors_file.h"
#include "planner/domain/mating_file.h"
#include "planner/domain/occlusion.h"
#include "planner/domain/pose_error_file.h"
#include "planner/domain/reachability.h"
#include "planner/domain/resting.h"
#include "planner/domain/tolerances_file.h"
#include "planner/domain/workcell_file.h"

namespace assay::domain {
namespace {

constexpr double kFeatureOffset = 0.001;      // metres that mating features may be off their axis
constexpr double kDefaultClearance = 0.0005;  // metres
constexpr Range kClearances = {1e-6, 0.01};   // metres
constexpr double kSamePose = 1e-9;            // of two matings that are written twice

// The folders of `folder` that hold `file`, by name.
std::vector<std::string> FoldersWith(const std::filesystem::path& folder, const char* file) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (std::filesystem::exists(entry.path() / file, error)) {
      names.push_back(entry.path().filename().string());
    }
  }
  std::ranges::sort(names);
  return names;
}

std::string ReadName(const Value& key, const char* what) {
  const std::string name = key.Text();
  const bool good = !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
  if (!good) key.Fail(fmt::format("'{}' cannot name {}", name, what), "letters, digits, - and _");
  return name;
}

std::string ReadOptionalText(const Value& root, std::string_view key) {
  const std::optional<Value> text = root.Find(key);
  return text ? text->Text() : "";
}

// Without -0, so that an error that is scaled to nothing is the same as none.
Interval Scaled(const Interval& interval, double scale) {
  return {scale * interval.low + 0.0, scale * interval.high + 0.0};
}

PoseError Scaled(const PoseError& error, double scale) {
  return {.x = Scaled(error.x, scale),
          .y = Scaled(error.y, scale),
          .z = Scaled(error.z, scale),
          .theta = Scaled(error.theta, scale)};
}

bool IsSameMating(const Mating& a, const Mating& b) {
  return a.held == b.held && a.fixed == b.fixed && a.features == b.features &&
         a.X_FixedHeld.isApprox(b.X_FixedHeld, kSamePose) &&
         (a.mating_vector - b.mating_vector).norm() < kSamePose;
}

// The words by which a scenario may call the stable poses: labels, then names; beside each, which
// pose it is.
class StablePoseNames {
 public:
  explicit StablePoseNames(const PartModel& model) {
    const std::vector<StablePose>& poses = model.stable_poses();
    for (std::size_t i = 0; i < poses.size(); ++i) Add(poses[i].label, StablePoseId(i));
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!poses[i].name.empty()) Add(poses[i].name, StablePoseId(i));
    }
  }

  StablePoseId Read(const Value& value) const { return poses_[value.OneOf(names_)]; }

 private:
  void Add(const std::string& name, StablePoseId pose) {
    names_.push_back(name);
    poses_.push_back(pose);
  }

  std::vector<std::string> names_;
  std::vector<StablePoseId> poses_;
};

// Like a counter of which each open pose is a digit. False after the last world.
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
  ProblemFile(const Document& scenario, const std::filesystem::path& models,
              const Overrides& overrides);

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
  void ReadInitially(const Value& root);
  void ReadInitialMating(const Value& value);
  void PlaceParts();
  void PlaceAssembledParts();
  Value ChosenPose(const Value& pose, PartId part);
  void ReadPose(const Value& pose, Part& part) const;
  Pose ReadStanding(const Value& pose, StablePoseId resting, const Part& part) const;
  void CheckOnTable(const Value& pose, PartId id) const;
  void CheckAboveTable(const Value& place, const Part& part) const;
  void CheckApart() const;
  MatingId AddMating(const Value& value);
  void ReadGoals(const Value& goals);
  void ReadGoal(const Value& goal);
  LocatedGoal ReadLocated(const Value& located) const;
  PartId ReadPartName(const Value& value) const { return PartId(value.OneOf(names_)); }
  double InFileUnits(double metres) const { return metres / units_.length; }

  std::filesystem::path models_;
  Overrides overrides_;
  Units units_;
  Problem problem_;
  std::vector<std::string> names_;   // of the parts
  std::vector<Value> entries_;       // of the parts, in the file
  std::vector<MatingId> mating_of_;  // of the parts: the mating that holds it at the start
  std::vector<std::string> known_models_;
  std::map<std::string, Model> loaded_;
};

ProblemFile::ProblemFile(const Document& scenario, const std::filesystem::path& models,
                         const Overrides& overrides)
    : models_(models), overrides_(overrides) {
  ASSAY_CHECK(std::isfinite(overrides.error_scale) && overrides.error_scale >= 0);
  scenario.RequireFormat("assay-scenario/1");
  const Value& root = scenario.root();
  root.AllowOnly({"format", "title", "description", "units", "workcell", "rules", "clearance",
                  "tolerances", "parts", "gripper", "sensing", "resolvers", "mating_errors",
                  "initially", "goal", "simulation", "knowledge"});
  problem_.name = std::filesystem::path(root.Place().file).stem().string();
  problem_.title = ReadOptionalText(root, "title");
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
  // What is to be known at the end may be goal enough (sim/enact).
  const std::optional<Value> goals =
      root.Find("knowledge") ? root.Find("goal") : std::optional(root.At("goal"));
  ReadParts(root.At("parts"));
  if (const auto tolerances = root.Find("tolerances")) {
    problem_.tolerances = ReadTolerances(*tolerances, units_, problem_);
  }
  if (const auto errors = root.Find("mating_errors")) {
    problem_.mating_errors = ReadMatingErrors(*errors, units_);
  }
  ReadInitially(root);
  PlaceParts();
  NoteOcclusions(problem_);
  if (goals) ReadGoals(*goals);
}

void ProblemFile::ReadClearance(const Value& root) {
  const std::optional<Value> clearance = root.Find("clearance");
  if (!overrides_.clearance) {
    problem_.clearance =
        clearance ? ReadWithin(*clearance, units_.length, kClearances) : kDefaultClearance;
    return;
  }
  problem_.clearance = *overrides_.clearance;
  if (problem_.clearance >= kClearances.low && problem_.clearance <= kClearances.high) return;
  clearance.value_or(root).Fail(
      fmt::format("{:.6g} m instead of this clearance is out of range", problem_.clearance),
      fmt::format("{:.6g} to {:.6g} m", kClearances.low, kClearances.high));
}

// What is left out is known exactly.
PoseError ProblemFile::ReadError(const Value& owner) const {
  const std::optional<Value> given = owner.Find("error");
  if (!given) return {};
  const PoseError error = ReadPoseError(*given, units_, {});
  return overrides_.error_scale == 1 ? error : Scaled(error, overrides_.error_scale);
}

void ProblemFile::ReadWorkcell(const Value& root) {
  const std::filesystem::path folder = models_ / "workcells";
  const Value name = root.At("workcell");
  name.OneOf(FoldersWith(folder, "workcell.yaml"));
  problem_.workcell = Workcell::Load(folder / name.Text() / "workcell.yaml");
  if (const auto rules = root.Find("rules")) {
    problem_.workcell =
        problem_.workcell->WithRules(ReadRules(*rules, units_, problem_.workcell->rules()));
  }
}

void ProblemFile::ReadParts(const Value& parts) {
  known_models_ = FoldersWith(models_ / "parts", "part.yaml");
  if (parts.Entries().empty()) parts.Fail("there are no parts", "at least one part");
  for (const auto& [key, entry] : parts.Entries()) ReadPart(ReadName(key, "a part"), entry);
  mating_of_.assign(problem_.parts.size(), MatingId::None());
}

void ProblemFile::ReadPart(const std::string& name, const Value& entry) {
  entry.AllowOnly({"model", "pose", "error"});
  Part part;
  part.name = name;
  part.error = ReadError(entry);
  const Model model = ReadModel(entry.At("model"));
  part.model = model.part;
  part.grasps = model.grasps;
  problem_.parts.push_back(std::move(part));
  names_.push_back(name);
  entries_.push_back(entry);
}

ProblemFile::Model ProblemFile::ReadModel(const Value& name) {
  name.OneOf(known_models_);
  const auto [model, is_new] = loaded_.try_emplace(name.Text());
  if (is_new) {
    model->second.part =
        PartModel::Load(models_ / "parts" / name.Text() / "part.yaml", problem_.clearance);
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

// If none is named, what one does not prove is handed to the next.
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

void ProblemFile::ReadInitially(const Value& root) {
  const std::optional<Value> initially = root.Find("initially");
  if (!initially) return;
  for (const Value& item : initially->Items()) {
    item.AllowOnly({"assembled"});
    ReadInitialMating(item.At("assembled"));
  }
}

void ProblemFile::ReadInitialMating(const Value& value) {
  const MatingId id = AddMating(value);
  const PartId held = problem_.mating(id).held;
  const std::string& name = problem_.part(held).name;
  if (!mating_of_[held.index()].IsNone()) {
    value.Fail(fmt::format("part '{}' is assembled twice at the start", name), "once");
  }
  if (const auto pose = entries_[held.index()].Find("pose")) {
    pose->Fail(fmt::format("part '{}' has a pose of its own, but is assembled at the start", name),
               "one of the two");
  }
  mating_of_[held.index()] = id;
  problem_.assembled.push_back(id);
}

void ProblemFile::PlaceParts() {
  for (std::size_t i = 0; i < problem_.parts.size(); ++i) {
    if (!mating_of_[i].IsNone()) continue;
    const Value pose = ChosenPose(entries_[i].At("pose"), PartId(i));
    ReadPose(pose, problem_.parts[i]);
    CheckOnTable(pose, PartId(i));
  }
  PlaceAssembledParts();
  for (std::size_t i = 0; i < problem_.parts.size(); ++i) {
    CheckAboveTable(entries_[i], problem_.parts[i]);
  }
  CheckApart();
}

// A part may be assembled with one that is itself assembled, so rounds follow until none is left.
void ProblemFile::PlaceAssembledParts() {
  std::vector<MatingId> waiting = problem_.assembled;
  while (!waiting.empty()) {
    std::vector<MatingId> later;
    for (const MatingId id : waiting) {
      const Mating& mating = problem_.mating(id);
      const bool fixed_waits = std::ranges::any_of(
          waiting, [&](MatingId other) { return problem_.mating(other).held == mating.fixed; });
      if (fixed_waits) {
        later.push_back(id);
      } else {
        problem_.parts[mating.held.index()].X_WorldPart =
            problem_.part(mating.fixed).X_WorldPart * mating.X_FixedHeld;
      }
    }
    if (later.size() == waiting.size()) {
      const PartId held = problem_.mating(later[0]).held;
      entries_[held.index()].Fail(
          fmt::format("part '{}' is assembled, in a circle, with itself", names_[held.index()]),
          "a part at the end of the chain that has a pose of its own");
    }
    waiting = std::move(later);
  }
}

// The pose itself, or of those that it may be the one that is chosen.
Value ProblemFile::ChosenPose(const Value& pose, PartId part) {
  const std::optional<Value> one_of = pose.Find("one-of");
  if (!one_of) return pose;
  pose.AllowOnly({"one-of"});
  OpenPose open{.part = part, .names = {}};
  for (const auto& [name, unused] : one_of->Entries()) {
    open.names.push_back(ReadName(name, "a pose"));
    if (std::ranges::count(names_, open.names.back()) > 0) {
      name.Fail(fmt::format("'{}' is the name of a part", open.names.back()), "other names");
    }
  }
  if (open.names.size() < 2) one_of->Fail("one pose", "two or more, each with its name");
  const auto chosen = overrides_.poses.find(names_[part.index()]);
  if (chosen != overrides_.poses.end()) open.chosen = chosen->second;
  problem_.open_poses.push_back(open);
  return one_of->Entries()[open.chosen].second;
}

void ProblemFile::ReadPose(const Value& pose, Part& part) const {
  if (const auto stable = pose.Find("stable")) {
    pose.AllowOnly({"stable", "at", "yaw"});
    part.resting = StablePoseNames(*part.model).Read(*stable);
    part.X_WorldPart = ReadStanding(pose, part.resting, part);
    return;
  }
  pose.AllowOnly({"stable", "at", "yaw", "columns"});
  if (!pose.Find("columns")) pose.Fail("neither stable nor columns", "one of stable, columns");
  pose.AllowOnly({"columns"});
  part.X_WorldPart = ReadColumns(pose.At("columns"), units_);
  part.resting = StablePoseAt(part, part.X_WorldPart);
}

Pose ProblemFile::ReadStanding(const Value& pose, StablePoseId resting, const Part& part) const {
  const Vector2 at = ReadVector2(pose.At("at"), units_);
  const std::optional<Value> yaw = pose.Find("yaw");
  const Placement placement = {.x = at.x(), .y = at.y(), .yaw = yaw ? ReadAngle(*yaw, units_) : 0};
  return placement.X_WorldTable() * part.model->stable_poses()[resting.index()].X_TablePart;
}

void ProblemFile::CheckOnTable(const Value& pose, PartId id) const {
  const Part& part = problem_.part(id);
  if (OnTable(problem_, id, part.X_WorldPart)) return;
  const auto extent = [&](const geometry::Polygon& polygon) {
    Eigen::AlignedBox2d box;
    for (const Vector2& p : polygon) box.extend(p);
    return fmt::format("x {:.4g} to {:.4g}, y {:.4g} to {:.4g}", InFileUnits(box.min().x()),
                       InFileUnits(box.max().x()), InFileUnits(box.min().y()),
                       InFileUnits(box.max().y()));
  };
  std::vector<std::string> tables;
  for (const Table& table : problem_.workcell->tables()) tables.push_back(extent(table.top));
  pose.Fail(fmt::format("part '{}' covers {}, which is not all on {}", part.name,
                        extent(Footprint(part, part.X_WorldPart)),
                        tables.size() == 1 ? "the table" : "one table"),
            fmt::format("{}", fmt::join(tables, "; or ")));
}

void ProblemFile::CheckAboveTable(const Value& place, const Part& part) const {
  double lowest = 0;
  for (const Vector3& vertex : part.model->hull().vertices) {
    lowest = std::min(lowest, (part.X_WorldPart * vertex).z());
  }
  const double allowance = problem_.workcell->rules().contact_allowance;
  if (lowest >= -allowance - kSamePose) return;
  place.Fail(fmt::format("part '{}' is {:.4g} deep in the table", part.name, InFileUnits(-lowest)),
             fmt::format("at most {:.4g}", InFileUnits(allowance)));
}

void ProblemFile::CheckApart() const {
  std::vector<PlacedPart> placed;
  for (std::size_t i = 0; i < problem_.parts.size(); ++i) {
    const PlacedPart part = {PartId(i), problem_.parts[i].X_WorldPart};
    const PartId hit = Obstacle(problem_, part, placed);
    if (!hit.IsNone()) {
      entries_[i].Fail(fmt::format("part '{}' overlaps part '{}' at the start", names_[i],
                                   problem_.part(hit).name),
                       "parts that do not overlap");
    }
    placed.push_back(part);
  }
}

// A mating that is written twice, at the start and as a goal, is one.
MatingId ProblemFile::AddMating(const Value& value) {
  Mating mating = ReadMating(value, problem_, units_);
  const auto known = std::ranges::find_if(
      problem_.matings, [&](const Mating& other) { return IsSameMating(mating, other); });
  const MatingId id(static_cast<std::size_t>(known - problem_.matings.begin()));
  if (known == problem_.matings.end()) problem_.matings.push_back(std::move(mating));
  return id;
}

void ProblemFile::ReadGoals(const Value& goals) {
  const std::vector<Value> items = goals.Items();
  if (items.empty()) goals.Fail("there is no goal", "at least one of assembled, located");
  for (const Value& item : items) ReadGoal(item);
}

void ProblemFile::ReadGoal(const Value& goal) {
  goal.AllowOnly({"assembled", "located"});
  if (goal.Entries().size() != 1) {
    goal.Fail(fmt::format("a goal with {} keys", goal.Entries().size()),
              "one of assembled, located");
  }
  if (const auto assembled = goal.Find("assembled")) {
    const MatingId id = AddMating(*assembled);
    if (std::ranges::find(problem_.goals, Goal(id)) != problem_.goals.end()) {
      assembled->Fail("this goal is given twice", "each goal once");
    }
    problem_.goals.emplace_back(id);
  } else {
    problem_.goals.emplace_back(ReadLocated(goal.At("located")));
  }
}

LocatedGoal ProblemFile::ReadLocated(const Value& located) const {
  located.AllowOnly({"part", "stable"});
  LocatedGoal goal;
  goal.part = ReadPartName(located.At("part"));
  for (const Goal& other : problem_.goals) {
    const auto* other_located = std::get_if<LocatedGoal>(&other);
    if (other_located == nullptr || other_located->part != goal.part) continue;
    located.At("part").Fail(
        fmt::format("part '{}' is located by two goals", names_[goal.part.index()]),
        "one goal with all its stable poses");
  }
  const Value stable = located.At("stable");
  const StablePoseNames names(*problem_.part(goal.part).model);
  for (const Value& item : stable.Items()) goal.stable_poses.push_back(names.Read(item));
  if (goal.stable_poses.empty()) stable.Fail("no stable pose", "at least one");
  return goal;
}

}  // namespace

Problem ReadProblem(const Document& scenario, const std::filesystem::path& models) {
  return ReadProblem(scenario, models, {});
}

Problem ReadProblem(const Document& scenario, const std::filesystem::path& models,
                    const Overrides& overrides) {
  return ProblemFile(scenario, models, overrides).Release();
}

std::vector<Problem> ReadWorlds(const Document& scenario, const std::filesystem::path& models,
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
