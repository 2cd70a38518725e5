#include "planner/finemotion/strategy_search/mating.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "planner/base/check.h"
#include "planner/domain/matings/shaft_fit.h"
#include "planner/domain/parts/part_file.h"
#include "planner/finemotion/contacts/round_contacts.h"
#include "planner/finemotion/forces/force_signature.h"
#include "planner/geometry/hull.h"

namespace assay::finemotion {

namespace {

constexpr double kLevel = 1e-6;  // metres, a difference of heights below which two are equal
// The fraction of a motion's length by which soft servos may be late. Without it, two of twenty
// trials of the square peg stop short of their first contact.
constexpr double kLag = 0.3;

// Translates a motion for hybrid control. Its contacts are those at its end.
class MotionMaker {
 public:
  MotionMaker(const CertainMotion& motion, plan::Strategy& strategy)
      : motion_(motion), strategy_(strategy) {}

  plan::StrategyMotion Run() {
    plan::StrategyMotion made;
    made.X_FixedTip = motion_.X_StationaryAfter;
    for (const ContactKey& key : motion_.command.kept) made.kept.push_back(IndexOf(key));
    if (motion_.command.until) {
      made.until = IndexOf(*motion_.command.until);
      made.beyond = motion_.check.longest - 1 + kLag;
    }
    for (const Unwanted& unwanted : motion_.check.unwanted) AddUnwanted(unwanted, made);
    return made;
  }

 private:
  const PrimitiveContact& At(const ContactKey& key) const {
    const PrimitiveContact* contact = Find(motion_.contacts, key);
    ASSAY_CHECK(contact != nullptr, "a contact that a motion was checked with");
    return *contact;
  }

  int IndexOf(const ContactKey& key) {
    const auto [index, is_new] = indices_.try_emplace(key, std::ssize(strategy_.contacts));
    if (is_new) {
      const PrimitiveContact& contact = At(key);
      strategy_.contacts.push_back({Name(contact), contact.normal, contact.at});
    }
    return index->second;
  }

  // Adds an unwanted contact. A face in several regions is added once, with its least scale.
  void AddUnwanted(const Unwanted& unwanted, plan::StrategyMotion& made) {
    const int contact = IndexOf(unwanted.contact);
    if (std::ranges::count(made.unwanted, contact, &plan::UnwantedContact::contact) > 0) return;
    plan::UnwantedContact added{.contact = contact,
                                .is_loss = unwanted.is_loss,
                                .scale = unwanted.scale,
                                .gap = At(unwanted.contact).offset};
    added.separation = SeparationOf(added, made);
    made.unwanted.push_back(added);
  }

  double SeparationOf(const plan::UnwantedContact& unwanted,
                      const plan::StrategyMotion& made) const {
    const std::vector<int> planned = plan::ContactsAfter(made);
    const std::vector<int> error = plan::ContactsInError(made, unwanted);
    const auto signature = [&](const std::vector<int>& state, const std::vector<int>& other,
                               bool in_both) {
      std::vector<int> contacts;
      std::ranges::copy_if(state, std::back_inserter(contacts), [&](int contact) {
        return (std::ranges::count(other, contact) > 0) == in_both;
      });
      return SignatureOf(plan::ContactsAt(strategy_, contacts), strategy_.friction);
    };
    return SeparationOfStates(signature(planned, error, true), signature(planned, error, false),
                              signature(error, planned, false), strategy_.length);
  }

  const CertainMotion& motion_;
  plan::Strategy& strategy_;
  std::map<ContactKey, int> indices_;
};

// Returns the mated feature of the held part that is farthest ahead in the mating direction.
const domain::Feature* FirstIn(const domain::PartModel& held, const domain::Mating& mating) {
  const domain::Feature* first = nullptr;
  double farthest = 0;
  for (const auto& [own, other] : mating.features) {
    const domain::Feature* feature = held.FindFeature(own);
    ASSAY_CHECK(feature != nullptr, "a mating of a feature that the part does not have");
    const double ahead = (mating.X_FixedHeld * feature->X_PartFeature.translation())
                             .dot(mating.mating_vector.normalized());
    if (first != nullptr && ahead <= farthest + kLevel) continue;
    first = feature;
    farthest = ahead;
  }
  return first;
}

// Returns one tolerance for each wall that the tip comes between.
std::vector<ModelTolerance> TolerancesOfWalls(const Passage& passage) {
  const ContactFinder finder(passage.moving, passage.stationary);
  std::set<std::pair<ModelTolerance::Of, int>> walls;
  for (int point = 0; point < passage.critical_points(); ++point) {
    for (const PrimitiveContact& wall : WallsAt(passage, point, finder)) {
      if (wall.kind == ContactKind::kVertexFace)
        walls.insert({ModelTolerance::Of::kStationaryFaces, wall.stationary});
      else
        walls.insert({ModelTolerance::Of::kMovingFaces, wall.moving});
    }
  }
  std::vector<ModelTolerance> tolerances;
  for (const auto& [of, face] : walls) {
    const bool is_moving = of == ModelTolerance::Of::kMovingFaces;
    tolerances.push_back(
        {fmt::format("wall {} of the {} part", face, is_moving ? "moving" : "stationary"),
         of,
         {face}});
  }
  return tolerances;
}

}  // namespace

Polyhedron OutsideOf(const domain::PartModel& model) {
  std::vector<ConvexPiece> pieces;
  for (const geometry::ConvexHull& piece : model.pieces()) pieces.push_back({piece.vertices});
  return OutsideOf(pieces);
}

namespace {

// A part of a mating with its round features, in its own frame.
struct Shapes {
  Polyhedron held;
  Polyhedron fixed;
};

// Returns the distance of a round hole's walls from its axis, or none if the hole is not round: its
// walls must be as many as those of a circle (domain::RadiusOfRound), and all equally far.
std::optional<double> RadiusOfRoundHole(const domain::ShaftFit& fit) {
  constexpr std::size_t kFewestWalls = 16;
  const std::vector<domain::SideWall> walls = domain::SideWalls(fit, 0);
  const auto radius = [&](const domain::SideWall& wall) {
    return wall.normal.dot(fit.hole.X_PartFeature.translation()) - wall.offset;
  };
  if (walls.size() < kFewestWalls) return std::nullopt;
  for (const domain::SideWall& wall : walls) {
    if (std::abs(radius(wall) - radius(walls.front())) > kSamePoint) return std::nullopt;
  }
  return radius(walls.front());
}

// Adds cylinders for polygons that stand for circles: for shafts of the held part that go into
// holes of the fixed part. The cylinder of a shaft goes through the corners of its polygon, and
// that of a hole touches the sides of its polygon. The cylinders therefore touch wherever the
// polygons do. The rims of these cylinders are sharp, so bevelled polygons stay polygons.
void AddRoundFits(const std::vector<domain::ShaftFit>& fits, Shapes& shapes) {
  for (const domain::ShaftFit& fit : fits) {
    const geometry::Polygon section = domain::CrossSection(fit);
    const std::optional<double> of_shaft = domain::RadiusOfRound(section);
    const std::optional<double> of_hole = RadiusOfRoundHole(fit);
    const bool has_bevels = fit.shaft.chamfer > 0 || fit.hole.chamfer > 0;
    if (!fit.shaft_is_held || !of_shaft || !of_hole || has_bevels) continue;
    const double half_side = (section[1] - section[0]).norm() / 2;
    const Pose& shaft = fit.shaft.X_PartFeature;
    const Pose& hole = fit.hole.X_PartFeature;
    AddRoundShaft({shaft.translation(), shaft.linear().col(2), *of_shaft, 0},
                  std::sqrt(*of_shaft * *of_shaft - half_side * half_side), shapes.held);
    AddRoundHole({hole.translation(), hole.linear().col(2), *of_hole, 0}, *of_hole, shapes.fixed);
  }
}

Shapes ShapesOf(const domain::Problem& problem, const domain::Mating& mating) {
  Shapes shapes{OutsideOf(*problem.part(mating.held).model),
                OutsideOf(*problem.part(mating.fixed).model)};
  if (problem.tolerances.clearance == 0) AddRoundFits(domain::FitsOf(problem, mating), shapes);
  return shapes;
}

// Returns the problem with parts that have no clearance.
domain::Problem WithoutClearance(domain::Problem problem, const domain::Mating& mating) {
  problem.clearance = 0;
  for (const domain::PartId id : {mating.held, mating.fixed}) {
    domain::Part& part = problem.parts[id.index()];
    part.model = domain::PartFile::WithClearance(*part.model, 0);
  }
  return problem;
}

// Returns the critical points of the parts without clearance. The play that is then left comes from
// the parts' files.
std::vector<CriticalPoint> CriticalPointsOf(const domain::Problem& problem,
                                            const domain::Mating& mating) {
  const domain::Problem tight = WithoutClearance(problem, mating);
  const Shapes shapes = ShapesOf(tight, mating);
  double play = 0;
  for (const domain::FitGap& gap : domain::GapsOf(tight, mating))
    play = std::max({play, gap.low, gap.high});
  return CriticalPoints(shapes.held, shapes.fixed, mating.X_FixedHeld, mating.mating_vector, play);
}

}  // namespace

MatingGeometry GeometryOf(const domain::Problem& problem, const domain::Mating& mating) {
  const domain::PartModel& held = *problem.part(mating.held).model;
  MatingGeometry geometry;
  const domain::Feature* tip = FirstIn(held, mating);
  geometry.X_HeldTip.linear() = mating.X_FixedHeld.linear().transpose();
  geometry.X_HeldTip.translation() = tip->X_PartFeature.translation();
  geometry.X_FixedSeat = mating.X_FixedHeld * geometry.X_HeldTip;
  geometry.critical_points = CriticalPointsOf(problem, mating);
  Shapes shapes = ShapesOf(problem, mating);
  geometry.passage.moving = Transformed(std::move(shapes.held), geometry.X_HeldTip.inverse());
  geometry.passage.stationary = std::move(shapes.fixed);
  geometry.passage.mating = mating.mating_vector.normalized();
  const Pose& entry = geometry.critical_points.empty()
                          ? mating.X_FixedHeld
                          : geometry.critical_points.front().X_StationaryMoving;
  geometry.passage.X_StationaryEntry = entry * geometry.X_HeldTip;
  const double seat = mating.mating_vector.norm();
  for (const CriticalPoint& point : geometry.critical_points) {
    const double further = point.travel - geometry.critical_points.front().travel;
    if (further > 0 && point.travel < seat - kLevel) geometry.passage.further.push_back(further);
  }
  if (!geometry.critical_points.empty()) {
    const auto& further = geometry.passage.further;
    geometry.passage.seat =
        seat - geometry.critical_points.front().travel - (further.empty() ? 0 : further.back());
  }
  if (problem.tolerances.clearance > 0) {
    geometry.passage.tolerances = TolerancesOfWalls(geometry.passage);
    geometry.tolerances.setConstant(std::ssize(geometry.passage.tolerances),
                                    problem.tolerances.clearance);
  }
  return geometry;
}

FineMotionErrors ErrorsOf(const plan::StrategyCertificate& certificate,
                          const MatingGeometry& geometry) {
  FineMotionErrors errors;
  errors.pose << certificate.d, certificate.w;
  errors.velocity = certificate.velocity;
  errors.tolerances = geometry.tolerances;
  return errors;
}

plan::Strategy StrategyOf(const MatingGeometry& geometry, const FineMotionPlan& plan,
                          const StrategyOptions& options) {
  plan::Strategy strategy{.X_HeldTip = geometry.X_HeldTip,
                          .X_FixedStart = plan.X_StationaryStart,
                          .contacts = {},
                          .motions = {},
                          .friction = options.friction,
                          .length = options.radius};
  for (const CertainMotion& motion : plan.motions) {
    strategy.motions.push_back(MotionMaker(motion, strategy).Run());
  }
  strategy.motions.push_back(
      {.kept = {}, .X_FixedTip = geometry.X_FixedSeat, .until = {}, .beyond = 0, .slides = true});
  return strategy;
}

}  // namespace assay::finemotion
