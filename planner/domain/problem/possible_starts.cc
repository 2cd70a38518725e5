#include "planner/domain/problem/possible_starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/domain/parts/part_file.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"

namespace assay::domain {
namespace {

constexpr double kDistanceError = 1e-6;  // metres, more than geometry::Distance is off
constexpr double kHardlyApart = 1e-5;    // metres; a smaller box of errors is not divided
constexpr int kMostBoxes = 1000;         // boxes of errors that are examined for one pair

bool IsAssembled(const Problem& problem, PartId part) {
  return std::ranges::any_of(problem.assembled, [&](MatingId id) {
    return problem.mating(id).held == part || problem.mating(id).fixed == part;
  });
}

// Only parts that are in one another have room that the clearance decides.
std::shared_ptr<const PartModel> NarrowestModel(const Problem& problem, PartId part) {
  const std::shared_ptr<const PartModel>& model = problem.part(part).model;
  const double tolerance = problem.tolerances.clearance;
  if (tolerance == 0 || !IsAssembled(problem, part)) return model;
  return PartFile::WithClearance(*model, model->clearance() - tolerance);
}

double Middle(const Interval& range) { return (range.low + range.high) / 2; }
double HalfWidth(const Interval& range) { return (range.high - range.low) / 2; }
Interval Difference(const Interval& a, const Interval& b) {
  return {a.low - b.high, a.high - b.low};
}

// Returns the heights between which a piece of a part is.
Interval HeightsOf(const Pose& X_WorldPart, const geometry::ConvexHull& piece) {
  Interval heights = {std::numeric_limits<double>::infinity(),
                      -std::numeric_limits<double>::infinity()};
  for (const Vector3& vertex : piece.vertices) {
    const double z = (X_WorldPart * vertex).z();
    heights = {std::min(heights.low, z), std::max(heights.high, z)};
  }
  return heights;
}

bool AreAboveEachOther(const Interval& a, const Interval& b, double allowance) {
  return a.low >= b.high - allowance || b.low >= a.high - allowance;
}

// A piece of one part, and the pieces of another part that are beside it at some height.
struct NeighbouringPieces {
  geometry::CollisionShape piece;
  geometry::CollisionShape others;
};

// Returns the pieces of `a` that may come upon pieces of `b`. Errors keep the heights of all
// points, except that `b` may be raised from `a` by an amount in `raised`. A piece that is above
// another one whatever the errors are can only touch it.
std::vector<NeighbouringPieces> PiecesBeside(const PlacedPart& a, const PlacedPart& b,
                                             const Interval& raised, const PossibleStarts& starts) {
  const double allowance = raised == Interval{} ? PossibleStarts::kGreatestOverlap : 0;
  std::vector<NeighbouringPieces> all;
  for (const geometry::ConvexHull& of_a : starts.pieces(a.part)) {
    const Interval heights_of_a = HeightsOf(a.X_WorldPart, of_a);
    std::vector<geometry::ConvexHull> others;
    for (const geometry::ConvexHull& of_b : starts.pieces(b.part)) {
      const Interval heights = HeightsOf(b.X_WorldPart, of_b);
      const Interval heights_of_b = {heights.low + raised.low, heights.high + raised.high};
      if (!AreAboveEachOther(heights_of_a, heights_of_b, allowance)) others.push_back(of_b);
    }
    if (!others.empty()) {
      all.push_back(
          {geometry::CollisionShape(std::span(&of_a, 1)), geometry::CollisionShape(others)});
    }
  }
  return all;
}

// The search for errors with which two parts overlap. Only three things matter: the displacement of
// one part from the other, and the turn of each part.
class OverlapSearch {
 public:
  OverlapSearch(const Problem& problem, const PossibleStarts& starts, PartPair pair)
      : a_{pair.first, problem.part(pair.first).X_WorldPart},
        b_{pair.second, problem.part(pair.second).X_WorldPart},
        starts_(starts) {
    const PoseError& a = problem.part(a_.part).error;
    const PoseError& b = problem.part(b_.part).error;
    const bool is_one_table = CarrierAtStart(problem, a_.part) == CarrierAtStart(problem, b_.part);
    whole_ = {Difference(b.x, a.x), Difference(b.y, a.y),
              is_one_table ? Interval{} : Difference(b.z, a.z), a.theta, b.theta};
    beside_ = PiecesBeside(a_, b_, whole_[2], starts);
  }

  // Returns false if the parts surely do not overlap.
  bool MayFind() const {
    std::vector<Errors> open = {whole_};
    for (int examined = 0; !open.empty(); ++examined) {
      if (examined == kMostBoxes) return true;
      const Errors errors = open.back();
      open.pop_back();
      const PlacedPart a = {a_.part, Turned(a_.X_WorldPart, Middle(errors[3]))};
      PlacedPart b = {b_.part, Turned(b_.X_WorldPart, Middle(errors[4]))};
      b.X_WorldPart.pretranslate(Vector3(Middle(errors[0]), Middle(errors[1]), Middle(errors[2])));
      if (starts_.Overlap(a, b)) return true;
      const std::array<double, 5> reach = ReachOf(errors);
      const double all = Vector3(reach[0], reach[1], reach[2]).norm() + reach[3] + reach[4];
      if (all == 0 || Between(a, b) - kDistanceError > all) continue;
      if (all < kHardlyApart) return true;
      Divide(errors, std::ranges::max_element(reach) - reach.begin(), open);
    }
    return false;
  }

 private:
  // The ranges of the displacement along x, y and z, and of the turns of `a` and `b`.
  using Errors = std::array<Interval, 5>;

  static Pose Turned(const Pose& X_WorldPart, double angle) {
    Pose turned = geometry::RotationZ(angle) * X_WorldPart;
    turned.translation() = X_WorldPart.translation();
    return turned;
  }

  // Returns the least distance of pieces that are beside each other, infinite if there are none.
  double Between(const PlacedPart& a, const PlacedPart& b) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [piece, others] : beside_) {
      least = std::min(least, geometry::Distance(piece, a.X_WorldPart, others, b.X_WorldPart));
    }
    return least;
  }

  // Returns how far each error moves any point of a part from where it is in the middle of its
  // range, metres.
  std::array<double, 5> ReachOf(const Errors& errors) const {
    const auto of_turn = [&](const Interval& range, PartId part) {
      const double half = std::min(HalfWidth(range), std::numbers::pi);
      return 2 * std::sin(half / 2) * starts_.shape(part).radius();
    };
    return {HalfWidth(errors[0]), HalfWidth(errors[1]), HalfWidth(errors[2]),
            of_turn(errors[3], a_.part), of_turn(errors[4], b_.part)};
  }

  static void Divide(const Errors& errors, std::ptrdiff_t along, std::vector<Errors>& open) {
    const auto at = static_cast<std::size_t>(along);
    for (const Interval& half : {Interval{errors[at].low, Middle(errors[at])},
                                 Interval{Middle(errors[at]), errors[at].high}}) {
      open.push_back(errors);
      open.back()[at] = half;
    }
  }

  const PlacedPart a_;
  const PlacedPart b_;
  const PossibleStarts& starts_;
  Errors whole_;
  std::vector<NeighbouringPieces> beside_;
};

std::vector<PartPair> AllPairs(std::size_t parts) {
  std::vector<PartPair> pairs;
  for (std::size_t b = 0; b < parts; ++b) {
    for (std::size_t a = 0; a < b; ++a) pairs.emplace_back(a, b);
  }
  return pairs;
}

}  // namespace

PartId CarrierAtStart(const Problem& problem, PartId part) {
  for (const MatingId id : problem.assembled) {
    const Mating& mating = problem.mating(id);
    if (mating.held == part) return CarrierAtStart(problem, mating.fixed);
  }
  return part;
}

PossibleStarts::PossibleStarts(const Problem& problem) {
  for (std::size_t i = 0; i < problem.parts.size(); ++i) {
    models_.push_back(NarrowestModel(problem, PartId(i)));
  }
  for (const PartPair& pair : AllPairs(models_.size())) {
    const Pose& X_WorldA = problem.part(pair.first).X_WorldPart;
    const Pose& X_WorldB = problem.part(pair.second).X_WorldPart;
    if (geometry::Overlaps(shape(pair.first), X_WorldA, shape(pair.second), X_WorldB, 0)) {
      touching_.push_back(pair);
    }
  }
}

bool PossibleStarts::Overlap(const PlacedPart& a, const PlacedPart& b) const {
  const auto is_pair = [&](const PartPair& pair) {
    return pair == PartPair(a.part, b.part) || pair == PartPair(b.part, a.part);
  };
  const double allowance = std::ranges::any_of(touching_, is_pair) ? kGreatestOverlap : 0;
  return geometry::Overlaps(shape(a.part), a.X_WorldPart, shape(b.part), b.X_WorldPart, allowance);
}

std::optional<PartPair> PossibleStarts::FirstOverlap(std::span<const Pose> X_WorldPart) const {
  for (const PartPair& pair : AllPairs(X_WorldPart.size())) {
    const auto& [a, b] = pair;
    if (Overlap({a, X_WorldPart[a.index()]}, {b, X_WorldPart[b.index()]})) return pair;
  }
  return std::nullopt;
}

const geometry::CollisionShape& PossibleStarts::shape(PartId part) const {
  return models_[part.index()]->shape();
}

std::span<const geometry::ConvexHull> PossibleStarts::pieces(PartId part) const {
  return models_[part.index()]->pieces();
}

double PossibleStarts::Between(const PlacedPart& a, const PlacedPart& b) const {
  return geometry::Distance(shape(a.part), a.X_WorldPart, shape(b.part), b.X_WorldPart);
}

std::vector<PartPair> PairsThatMayOverlap(const Problem& problem) {
  const PossibleStarts starts(problem);
  std::vector<PartPair> pairs = AllPairs(problem.parts.size());
  std::erase_if(
      pairs, [&](const PartPair& pair) { return !OverlapSearch(problem, starts, pair).MayFind(); });
  return pairs;
}

}  // namespace assay::domain
