#include "planner/posting/impossibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "planner/base/check.h"
#include "planner/domain/condition.h"
#include "planner/domain/reachability.h"
#include "planner/posting/least_actions.h"

namespace assay::posting {

using domain::GraspCondition;
using domain::GraspConditions;
using domain::GraspId;
using domain::Mating;
using domain::MatingId;
using domain::Part;
using domain::PartId;
using domain::Problem;
using domain::StablePoseId;
using network::Relation;

namespace {

// Constraints of a problem, each of which can be left out.
enum class Kind {
  kGraspCondition,
  kStart,
  kMatedStart,
  kLocated,
  kFeaturesOffTable,
  kFrictionCone,
  kFeaturesOffPads
};
struct Constraint {
  Kind kind;
  int index;  // of the condition in kConditions, of the part or of the mating
};

constexpr std::array kConditions = {GraspCondition::kFacesFree, GraspCondition::kTableClear,
                                    GraspCondition::kMateClear, GraspCondition::kReach,
                                    GraspCondition::kOpening,   GraspCondition::kToolLean};

// For each grasp and position label, the conditions that are broken.
struct ConditionTable {
  int grasps = 0;
  int positions = 0;
  std::vector<GraspConditions> broken = {};  // grasp * positions + position

  std::shared_ptr<const Relation> Without(GraspConditions left_out) const {
    return Relation::Where(grasps, positions, [&](int g, int p) {
      return (broken[g * positions + p] & ~left_out) == 0;
    });
  }
};

template <class BrokenPair>
ConditionTable TableOf(const Part& gripped, const Part& placed, const BrokenPair& broken) {
  ConditionTable table{.grasps = domain::GraspLabelCount(gripped),
                       .positions = domain::PositionLabelCount(placed)};
  for (int g = 0; g < table.grasps; ++g) {
    for (int p = 0; p < table.positions; ++p) table.broken.push_back(broken(GraspId(g), p));
  }
  return table;
}

// The same problem with the grasps that are too wide for the gripper among the others.
Problem WithWideGrasps(const Problem& problem) {
  constexpr double kWiderThanAnyPart = 1e3;
  Problem wide = problem;
  for (Part& part : wide.parts) {
    part.grasps = std::make_shared<const std::vector<domain::Grasp>>(ComputeGrasps(
        *part.model, problem.workcell->gripper(),
        {.approach_step = problem.workcell->rules().approach_step, .widest = kWiderThanAnyPart}));
  }
  return wide;
}

class RelaxedProblem {
 public:
  explicit RelaxedProblem(const Problem& problem) : problem_(WithWideGrasps(problem)) {
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) AddPart(PartId(p));
    for (std::size_t m = 0; m < problem_.matings.size(); ++m) AddMating(MatingId(m));
  }

  // From those that a person is least likely to change to those that are most easily changed: what
  // is tried first is left out first.
  std::vector<Constraint> Constraints() const {
    std::vector<Constraint> constraints;
    for (std::size_t c = 0; c < kConditions.size(); ++c) {
      constraints.push_back({Kind::kGraspCondition, static_cast<int>(c)});
    }
    for (int p = static_cast<int>(problem_.parts.size()) - 1; p >= 0; --p) {
      constraints.push_back({Kind::kStart, p});
    }
    for (std::size_t m = 0; m < problem_.matings.size(); ++m) {
      for (Kind kind : {Kind::kFeaturesOffPads, Kind::kFeaturesOffTable, Kind::kFrictionCone}) {
        constraints.push_back({kind, static_cast<int>(m)});
      }
    }
    for (std::size_t i = 0; i < problem_.assembled.size(); ++i) {
      constraints.push_back({Kind::kMatedStart, static_cast<int>(i)});
    }
    for (std::size_t g = 0; g < problem_.goals.size(); ++g) {
      if (std::holds_alternative<domain::LocatedGoal>(problem_.goals[g])) {
        constraints.push_back({Kind::kLocated, static_cast<int>(g)});
      }
    }
    return constraints;
  }

  bool PossibleWith(const std::vector<Constraint>& constraints) const {
    return LeastActions(problem_, GeometryWith(constraints)).has_value();
  }

  std::string Describe(const Constraint& constraint) const;

 private:
  void AddPart(PartId id) {
    const Part& part = problem_.part(id);
    reach_.push_back(TableOf(part, part, [&](GraspId grasp, int position) {
      return position == domain::InitialLabel(part)
                 ? BrokenAt(problem_, id, grasp, part.X_WorldPart)
                 : BrokenIn(problem_, id, grasp, StablePoseId(position));
    }));
  }

  void AddMating(MatingId id) {
    const Part& held = problem_.part(problem_.mating(id).held);
    const Part& fixed = problem_.part(problem_.mating(id).fixed);
    mate_.push_back(TableOf(held, fixed, [&](GraspId grasp, int position) {
      return position == domain::InitialLabel(fixed)
                 ? BrokenMatingAt(problem_, id, grasp, fixed.X_WorldPart)
                 : BrokenMatingIn(problem_, id, grasp, StablePoseId(position));
    }));
  }

  static bool Has(const std::vector<Constraint>& constraints, Kind kind, int index) {
    return std::ranges::any_of(constraints, [&](const Constraint& constraint) {
      return constraint.kind == kind && constraint.index == index;
    });
  }

  LabelGeometry GeometryWith(const std::vector<Constraint>& constraints) const {
    GraspConditions left_out = 0;
    for (std::size_t c = 0; c < kConditions.size(); ++c) {
      if (Has(constraints, Kind::kGraspCondition, static_cast<int>(c))) continue;
      left_out = static_cast<GraspConditions>(left_out | static_cast<int>(kConditions[c]));
    }
    LabelGeometry geometry;
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      geometry.reachable.push_back(reach_[p].Without(left_out));
      geometry.start.push_back(StartWith(constraints, static_cast<int>(p)));
      geometry.movable.push_back(MovableWith(constraints, PartId(p)));
    }
    geometry.located.resize(problem_.parts.size());
    for (std::size_t g = 0; g < problem_.goals.size(); ++g) {
      const auto* located = std::get_if<domain::LocatedGoal>(&problem_.goals[g]);
      if (located && Has(constraints, Kind::kLocated, static_cast<int>(g))) {
        geometry.located[located->part.index()] = LocatedLabels(problem_, *located);
      }
    }
    for (std::size_t m = 0; m < problem_.matings.size(); ++m) {
      geometry.mate_reachable.push_back(mate_[m].Without(left_out));
      geometry.grasp_list.push_back(GraspListWith(constraints, MatingId(m)));
      geometry.position_list.push_back(PositionListWith(constraints, MatingId(m)));
    }
    return geometry;
  }

  std::vector<int> StartWith(const std::vector<Constraint>& constraints, int part) const {
    const int initial = domain::InitialLabel(problem_.parts[part]);
    if (Has(constraints, Kind::kStart, part)) return {initial};
    std::vector<int> anywhere(initial + 1);
    std::iota(anywhere.begin(), anywhere.end(), 0);
    return anywhere;
  }

  bool MovableWith(const std::vector<Constraint>& constraints, PartId part) const {
    for (std::size_t i = 0; i < problem_.assembled.size(); ++i) {
      const Mating& mating = problem_.mating(problem_.assembled[i]);
      if (mating.held != part && mating.fixed != part) continue;
      if (Has(constraints, Kind::kMatedStart, static_cast<int>(i))) return false;
    }
    return true;
  }

  std::vector<int> GraspListWith(const std::vector<Constraint>& constraints, MatingId id) const {
    const Mating& mating = problem_.mating(id);
    const bool pads = Has(constraints, Kind::kFeaturesOffPads, id.index());
    std::vector<int> labels;
    for (int g = 0; g < domain::GraspLabelCount(problem_.part(mating.held)); ++g) {
      if (!pads || LeavesMatingFeaturesFree(problem_, mating, GraspId(g))) labels.push_back(g);
    }
    return labels;
  }

  std::vector<int> PositionListWith(const std::vector<Constraint>& constraints, MatingId id) const {
    const Mating& mating = problem_.mating(id);
    const Part& fixed = problem_.part(mating.fixed);
    const bool table = Has(constraints, Kind::kFeaturesOffTable, id.index());
    const bool cone = Has(constraints, Kind::kFrictionCone, id.index());
    const auto allowed = [&](StablePoseId pose) {
      const auto& X_TablePart = fixed.model->stable_poses()[pose.index()].X_TablePart;
      return !(table && HidesMatingFeatures(problem_, mating, pose)) &&
             !(cone && !InFrictionCone(problem_, mating, X_TablePart));
    };
    std::vector<int> labels;
    for (int p = 0; p < domain::InitialLabel(fixed); ++p) {
      if (allowed(StablePoseId(p))) labels.push_back(p);
    }
    if (!fixed.position_class.IsNone() && allowed(fixed.position_class)) {
      labels.push_back(domain::InitialLabel(fixed));
    }
    return labels;
  }

  Problem problem_;
  std::vector<ConditionTable> reach_;  // by part
  std::vector<ConditionTable> mate_;   // by mating
};

enum class Side { kHeld, kFixed };

std::string FeatureList(const Mating& mating, Side side) {
  std::string text;
  for (const auto& [held, fixed] : mating.features) {
    text +=
        fmt::format("{}{}", text.empty() ? "" : ", ", (side == Side::kHeld ? held : fixed).index());
  }
  return text;
}

std::string PoseName(const Part& part, StablePoseId id) {
  const domain::StablePose& pose = part.model->stable_poses()[id.index()];
  return pose.name.empty() ? pose.label : pose.name;
}

std::string DescribeStart(const Part& part) {
  return part.resting.IsNone()
             ? fmt::format("{} does not start on the table by itself", part.name)
             : fmt::format("{} starts {}", part.name, PoseName(part, part.resting));
}

std::string DescribeLocated(const Problem& problem, const domain::LocatedGoal& goal) {
  std::string poses;
  for (StablePoseId pose : goal.stable_poses) {
    poses +=
        fmt::format("{}{}", poses.empty() ? "" : " or ", PoseName(problem.part(goal.part), pose));
  }
  return fmt::format("{} is to end {}", problem.part(goal.part).name, poses);
}

std::string DescribeMating(const Problem& problem, const Mating& mating, Kind kind) {
  const std::string& held = problem.part(mating.held).name;
  const std::string& fixed = problem.part(mating.fixed).name;
  if (kind == Kind::kMatedStart) {
    return fmt::format("{} and {} are mated at the start, and mated parts are not moved", held,
                       fixed);
  }
  if (kind == Kind::kFeaturesOffPads) {
    return fmt::format("the pads leave features {} of {} free while it is mated",
                       FeatureList(mating, Side::kHeld), held);
  }
  if (kind == Kind::kFeaturesOffTable) {
    return fmt::format("the table leaves features {} of {} free while {} is mated with it",
                       FeatureList(mating, Side::kFixed), fixed, held);
  }
  return fmt::format(
      "the mating vector of {} into {} points down into the friction cone (friction {})", held,
      fixed, domain::LeastMatingFriction(problem));
}

std::string RelaxedProblem::Describe(const Constraint& constraint) const {
  switch (constraint.kind) {
    case Kind::kGraspCondition:
      return domain::Describe(problem_, kConditions[constraint.index]);
    case Kind::kStart:
      return DescribeStart(problem_.parts[constraint.index]);
    case Kind::kLocated:
      return DescribeLocated(problem_,
                             std::get<domain::LocatedGoal>(problem_.goals[constraint.index]));
    case Kind::kMatedStart:
      return DescribeMating(problem_, problem_.mating(problem_.assembled[constraint.index]),
                            constraint.kind);
    case Kind::kFeaturesOffTable:
    case Kind::kFrictionCone:
    case Kind::kFeaturesOffPads:
      return DescribeMating(problem_, problem_.matings[constraint.index], constraint.kind);
  }
  return {};
}

}  // namespace

// A deletion filter: what can be left out without making the problem possible is left out; what
// remains is minimal (Chinneck and Dravnieks 1991).
std::vector<std::string> WhyImpossible(const Problem& problem) {
  const RelaxedProblem relaxed(problem);
  std::vector<Constraint> conflict = relaxed.Constraints();
  ASSAY_CHECK(!relaxed.PossibleWith(conflict));
  for (const Constraint& candidate : relaxed.Constraints()) {
    std::vector<Constraint> fewer = conflict;
    std::erase_if(fewer, [&](const Constraint& constraint) {
      return constraint.kind == candidate.kind && constraint.index == candidate.index;
    });
    if (!relaxed.PossibleWith(fewer)) conflict = std::move(fewer);
  }
  std::vector<std::string> words;
  for (const Constraint& constraint : conflict) words.push_back(relaxed.Describe(constraint));
  return words;
}

}  // namespace assay::posting
