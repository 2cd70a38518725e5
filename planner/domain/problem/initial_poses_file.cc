#include "planner/domain/problem/initial_poses_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/domain/matings/mating_file.h"
#include "planner/domain/parts/part_model.h"
#include "planner/domain/problem/initial_balance.h"
#include "planner/domain/problem/name.h"
#include "planner/domain/problem/possible_starts.h"
#include "planner/domain/reachability/reachability.h"
#include "planner/domain/resting/resting.h"
#include "planner/domain/resting/stable_pose_names.h"
#include "planner/geometry/pose.h"

namespace assay::domain {
namespace {

class InitialPosesFile {
 public:
  InitialPosesFile(const Value& root, const Units& units, const std::map<std::string, int>& chosen,
                   Problem& problem)
      : units_(units),
        chosen_(chosen),
        problem_(problem),
        mating_of_(problem.parts.size(), MatingId::None()) {
    for (const auto& [name, entry] : root.At("parts").Entries()) entries_.push_back(entry);
  }

  void ReadInitially(const Value& root);
  void PlaceParts();

 private:
  void ReadInitialMating(const Value& value);
  void RefuseHeightError(const Value& error, MatingId id) const;
  void PlaceAssembledParts();
  Value ChosenPose(const Value& pose, PartId part);
  void ReadPose(const Value& pose, Part& part) const;
  Pose ReadStanding(const Value& pose, StablePoseId resting, const Part& part) const;
  void CheckOnTable(const Value& pose, PartId id) const;
  void CheckOnTableWithErrors(const Value& pose, const Part& part) const;
  void CheckAboveTable(const Value& place, const Part& part) const;
  void CheckApart() const;

  std::string InFileUnit(double metres) const { return InUnit(metres, units_.length); }

  const Units& units_;
  const std::map<std::string, int>& chosen_;
  Problem& problem_;
  std::vector<Value> entries_;       // entry of each part in the file
  std::vector<MatingId> mating_of_;  // the mating that holds each part at the start
};

void InitialPosesFile::ReadInitially(const Value& root) {
  const std::optional<Value> initially = root.Find("initially");
  if (!initially) return;
  for (const Value& item : initially->Items()) {
    item.AllowOnly({"assembled"});
    ReadInitialMating(item.At("assembled"));
  }
}

void InitialPosesFile::ReadInitialMating(const Value& value) {
  const MatingId id = AddMating(value, units_, problem_);
  const PartId held = problem_.mating(id).held;
  const std::string& name = problem_.part(held).name;
  if (!mating_of_[held.index()].IsNone()) {
    value.Fail(fmt::format("part '{}' is assembled twice at the start", name), "once");
  }
  if (const auto pose = entries_[held.index()].Find("pose")) {
    pose->Fail(fmt::format("part '{}' has a pose of its own, but is assembled at the start", name),
               "one of the two");
  }
  if (const auto error = entries_[held.index()].Find("error")) RefuseHeightError(*error, id);
  mating_of_[held.index()] = id;
  problem_.assembled.push_back(id);
}

void InitialPosesFile::RefuseHeightError(const Value& error, MatingId id) const {
  const std::optional<Value> height = error.Find("z");
  if (!height) return;
  const Mating& mating = problem_.mating(id);
  height->Fail(
      fmt::format("part '{}' is assembled at the start, so that its height has the error of "
                  "part '{}'",
                  problem_.part(mating.held).name, problem_.part(mating.fixed).name),
      "x, y, theta");
}

void InitialPosesFile::PlaceParts() {
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
  CheckInitialBalance(problem_, units_, entries_);
}

// A part may be assembled with one that is itself assembled, so rounds are made until none is left.
void InitialPosesFile::PlaceAssembledParts() {
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
        Part& held = problem_.parts[mating.held.index()];
        const Part& fixed = problem_.part(mating.fixed);
        held.X_WorldPart = fixed.X_WorldPart * mating.X_FixedHeld;
        held.error.z = fixed.error.z;
      }
    }
    if (later.size() == waiting.size()) {
      const PartId held = problem_.mating(later[0]).held;
      entries_[held.index()].Fail(
          fmt::format("part '{}' is assembled, in a circle, with itself", problem_.part(held).name),
          "a part at the end of the chain that has a pose of its own");
    }
    waiting = std::move(later);
  }
}

// Returns the pose itself, or the chosen one of its alternatives.
Value InitialPosesFile::ChosenPose(const Value& pose, PartId part) {
  const std::optional<Value> one_of = pose.Find("one-of");
  if (!one_of) return pose;
  pose.AllowOnly({"one-of"});
  OpenPose open{.part = part, .names = {}};
  for (const auto& [name, unused] : one_of->Entries()) {
    open.names.push_back(ReadName(name, "a pose"));
  }
  if (open.names.size() < 2) one_of->Fail("one pose", "two or more, each with its name");
  const auto chosen = chosen_.find(problem_.part(part).name);
  if (chosen != chosen_.end()) open.chosen = chosen->second;
  problem_.open_poses.push_back(open);
  return one_of->Entries()[open.chosen].second;
}

void InitialPosesFile::ReadPose(const Value& pose, Part& part) const {
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
  if (!part.resting.IsNone()) part.X_WorldPart = ComeToRest(part, part.resting, part.X_WorldPart);
}

Pose InitialPosesFile::ReadStanding(const Value& pose, StablePoseId resting,
                                    const Part& part) const {
  const Vector2 at = ReadVector2(pose.At("at"), units_);
  const std::optional<Value> yaw = pose.Find("yaw");
  const Placement placement = {.x = at.x(), .y = at.y(), .yaw = yaw ? ReadAngle(*yaw, units_) : 0};
  return placement.X_WorldTable() * part.model->stable_poses()[resting.index()].X_TablePart;
}

void InitialPosesFile::CheckOnTable(const Value& pose, PartId id) const {
  const Part& part = problem_.part(id);
  if (OnTable(problem_, id, part.X_WorldPart)) return CheckOnTableWithErrors(pose, part);
  const auto extent = [&](const geometry::Polygon& polygon) {
    Eigen::AlignedBox2d box;
    for (const Vector2& p : polygon) box.extend(p);
    return fmt::format("x {} to {}, y {} to {}", InFileUnit(box.min().x()),
                       InFileUnit(box.max().x()), InFileUnit(box.min().y()),
                       InFileUnit(box.max().y()));
  };
  std::vector<std::string> tables;
  for (const Table& table : problem_.workcell->tables()) tables.push_back(extent(table.top));
  pose.Fail(fmt::format("part '{}' extends over {}, which is not entirely on {}", part.name,
                        extent(Footprint(part, part.X_WorldPart)),
                        tables.size() == 1 ? "the table" : "one table"),
            fmt::format("{}", fmt::join(tables, "; or ")));
}

// The table is convex, so it is enough to check the ends of the displacements.
void InitialPosesFile::CheckOnTableWithErrors(const Value& pose, const Part& part) const {
  const Table& table = TableUnder(*problem_.workcell, part, part.X_WorldPart);
  for (const Interval& error : {part.error.x, part.error.y, part.error.theta}) {
    if (!std::isfinite(error.high - error.low)) return;  // nothing is known about the pose
  }
  for (const double x : {part.error.x.low, part.error.x.high}) {
    for (const double y : {part.error.y.low, part.error.y.high}) {
      for (const double theta : {part.error.theta.low, 0.0, part.error.theta.high}) {
        Pose X_WorldPart = part.X_WorldPart;
        X_WorldPart.linear() = geometry::RotationZ(theta).linear() * X_WorldPart.linear();
        X_WorldPart.translation() += Vector3(x, y, 0);
        if (IsOver(table, part, X_WorldPart)) continue;
        pose.Fail(fmt::format("part '{}' may stand beyond the edge of the table: {} along x and {} "
                              "along y from here, which its error allows",
                              part.name, InFileUnit(x), InFileUnit(y)),
                  "a place where the part is on the table for all its errors");
      }
    }
  }
}

void InitialPosesFile::CheckAboveTable(const Value& place, const Part& part) const {
  const double lowest = LowestPoint(part, part.X_WorldPart);
  const double allowance = problem_.workcell->rules().contact_allowance;
  if (lowest >= -allowance - kRounding) return;
  place.Fail(fmt::format("part '{}' is {} deep in the table", part.name, InFileUnit(-lowest)),
             fmt::format("at most {}", InFileUnit(allowance)));
}

void InitialPosesFile::CheckApart() const {
  std::vector<Pose> X_WorldPart;
  for (const Part& part : problem_.parts) X_WorldPart.push_back(part.X_WorldPart);
  const std::optional<PartPair> overlap = PossibleStarts(problem_).FirstOverlap(X_WorldPart);
  if (!overlap) return;
  const auto& [other, part] = *overlap;
  entries_[part.index()].Fail(fmt::format("part '{}' overlaps part '{}' at the start",
                                          problem_.part(part).name, problem_.part(other).name),
                              "parts that do not overlap");
}

}  // namespace

void ReadInitialPoses(const Value& root, const Units& units,
                      const std::map<std::string, int>& chosen, Problem& problem) {
  InitialPosesFile file(root, units, chosen, problem);
  file.ReadInitially(root);
  file.PlaceParts();
}

}  // namespace assay::domain
