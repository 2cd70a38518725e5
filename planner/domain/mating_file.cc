#include "planner/domain/mating_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/domain/name.h"
#include "planner/geometry/collision.h"

namespace assay::domain {
namespace {

constexpr double kFeatureOffset = 0.001;        // metres that mating features may be off their axis
constexpr double kShortestMatingVector = 1e-6;  // metres
constexpr double kLongestMatingVector = 2;      // metres
constexpr double kSamePose = 1e-9;              // of two matings that are written twice
constexpr double kMatingStep = 0.005;           // metres between looks along a mating vector

FeatureNumber ReadFeature(const Value& value, const Part& part) {
  const FeatureNumber number(value.Integer(0, 9999));
  if (part.model->FindFeature(number) != nullptr) return number;
  std::vector<std::string> known;
  for (const Feature& feature : part.model->features()) {
    known.push_back(fmt::format("{} ({})", feature.number.index(), feature.description));
  }
  value.Fail(fmt::format("part '{}' has no feature {}", part.name, number.index()),
             fmt::format("{}", fmt::join(known, ", ")));
}

bool IsSameMating(const Mating& a, const Mating& b) {
  return a.held == b.held && a.fixed == b.fixed && a.features == b.features &&
         a.X_FixedHeld.isApprox(b.X_FixedHeld, kSamePose) &&
         (a.mating_vector - b.mating_vector).norm() < kSamePose;
}

class MatingFile {
 public:
  MatingFile(const Problem& problem, const Units& units) : problem_(problem), units_(units) {}

  Mating Read(const Value& value) const;

 private:
  void ReadFeatures(const Value& features, Mating& mating) const;
  Vector3 ReadMatingVector(const Value& value) const;
  void CheckFits(const Value& value, const Mating& mating) const;
  void CheckFeaturesMeet(const Value& value, const Mating& mating) const;
  double InFileUnits(double metres) const { return metres / units_.length; }

  const Problem& problem_;
  const Units& units_;
};

Mating MatingFile::Read(const Value& value) const {
  value.AllowOnly({"held", "fixed", "features", "pose", "mating_vector"});
  Mating mating;
  mating.held = ReadPartName(value.At("held"), problem_);
  mating.fixed = ReadPartName(value.At("fixed"), problem_);
  if (mating.held == mating.fixed) {
    value.At("fixed").Fail(
        fmt::format("part '{}' is to be mated with itself", problem_.part(mating.held).name),
        "two parts");
  }
  ReadFeatures(value.At("features"), mating);
  const Value pose = value.At("pose");
  pose.AllowOnly({"columns"});
  mating.X_FixedHeld = ReadColumns(pose.At("columns"), units_);
  mating.mating_vector = ReadMatingVector(value.At("mating_vector"));
  CheckFits(value, mating);
  CheckFeaturesMeet(value, mating);
  return mating;
}

void MatingFile::ReadFeatures(const Value& features, Mating& mating) const {
  const std::vector<Value> lists = features.Items();
  if (lists.size() != 2 || lists[0].Items().size() != lists[1].Items().size() ||
      lists[0].Items().empty()) {
    features.Fail("the features do not pair",
                  "[[of the held part], [of the fixed part]], as many of each");
  }
  const std::vector<Value> held = lists[0].Items();
  const std::vector<Value> fixed = lists[1].Items();
  for (std::size_t i = 0; i < held.size(); ++i) {
    mating.features.emplace_back(ReadFeature(held[i], problem_.part(mating.held)),
                                 ReadFeature(fixed[i], problem_.part(mating.fixed)));
  }
}

Vector3 MatingFile::ReadMatingVector(const Value& value) const {
  const Vector3 vector = ReadVector3(value, units_);
  if (vector.norm() < kShortestMatingVector) {
    value.Fail("the mating vector is zero", "the way from where the mating starts");
  }
  if (vector.norm() > kLongestMatingVector) {
    value.Fail(fmt::format("the mating vector is {:.4g} long", InFileUnits(vector.norm())),
               fmt::format("at most {:.4g}", InFileUnits(kLongestMatingVector)));
  }
  return vector;
}

// The parts, moved along the mating vector, must fit into each other.
void MatingFile::CheckFits(const Value& value, const Mating& mating) const {
  const auto& held = problem_.part(mating.held).model->shape();
  const auto& fixed = problem_.part(mating.fixed).model->shape();
  const double allowance = problem_.workcell->rules().contact_allowance;
  const int steps = static_cast<int>(std::ceil(mating.mating_vector.norm() / kMatingStep));
  for (int i = 0; i <= steps; ++i) {
    const double before_end = static_cast<double>(i) / steps;
    const Pose X_FixedHeld =
        geometry::Translation(-before_end * mating.mating_vector) * mating.X_FixedHeld;
    if (!Overlaps(held, X_FixedHeld, fixed, Pose::Identity(), allowance)) continue;
    const std::string allowed = fmt::format("an overlap of at most {:.4g}", InFileUnits(allowance));
    if (i == 0) value.At("pose").Fail("the parts overlap in the mated pose", allowed);
    value.At("mating_vector")
        .Fail(fmt::format("the parts overlap on the way, {:.4g} before its end",
                          InFileUnits(before_end * mating.mating_vector.norm())),
              allowed);
  }
}

// Shafts and holes that mate lie on one axis, to within what the clearance leaves open.
void MatingFile::CheckFeaturesMeet(const Value& value, const Mating& mating) const {
  for (const auto& [of_held, of_fixed] : mating.features) {
    const Feature& held = *problem_.part(mating.held).model->FindFeature(of_held);
    const Feature& fixed = *problem_.part(mating.fixed).model->FindFeature(of_fixed);
    if (held.is_plain_face() || fixed.is_plain_face()) continue;
    const Vector3 offset =
        fixed.X_PartFeature.inverse() * mating.X_FixedHeld * held.X_PartFeature.translation();
    const double beside = offset.head<2>().norm();
    const double most = problem_.clearance + kFeatureOffset;
    if (beside <= most) continue;
    value.At("features")
        .Fail(fmt::format("in the mated pose feature {} lies {:.4g} beside feature {}",
                          of_held.index(), InFileUnits(beside), of_fixed.index()),
              fmt::format("features whose axes are at most {:.4g} apart", InFileUnits(most)));
  }
}

}  // namespace

MatingId AddMating(const Value& value, const Units& units, Problem& problem) {
  Mating mating = MatingFile(problem, units).Read(value);
  const auto known = std::ranges::find_if(
      problem.matings, [&](const Mating& other) { return IsSameMating(mating, other); });
  const MatingId id(static_cast<std::size_t>(known - problem.matings.begin()));
  if (known == problem.matings.end()) problem.matings.push_back(std::move(mating));
  return id;
}

}  // namespace assay::domain
