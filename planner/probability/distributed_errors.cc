#include "planner/probability/distributed_errors.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "planner/budget/quantity_group.h"

namespace assay::probability {
namespace {

using budget::ErrorQuantity;

double FactorOf(domain::Dimension dimension, const domain::Units& units) {
  return dimension == domain::Dimension::kAngle ? units.angle.factor : units.length.factor;
}

double ReadPositive(const Value& value, double factor) {
  if (!(value.Number() > 0)) value.Fail("this is not positive", "more than 0");
  return factor * value.Number();
}

ErrorDistribution ReadDistribution(const Value& value, const ErrorQuantity& quantity,
                                   const domain::Units& units) {
  const double factor = FactorOf(quantity.dimension, units);
  if (value.IsMap()) {
    value.AllowOnly({"normal", "within"});
    const double deviation = ReadPositive(value.At("normal"), factor);
    const auto within = value.Find("within");
    if (!within) return Normal(deviation);
    const double most = ReadPositive(*within, factor);
    return NormalWithin(deviation, {-most, most});
  }
  value.OneOf({"uniform"});
  return Uniform(quantity.bounds);
}

// Returns the quantities whose errors are variables: those of poses.
std::vector<ErrorQuantity> PoseErrorsOf(const domain::Problem& problem) {
  std::vector<ErrorQuantity> errors = budget::ErrorQuantitiesOf(problem);
  std::erase_if(
      errors, [](const ErrorQuantity& error) { return error.name.find('.') == std::string::npos; });
  return errors;
}

bool IsOfPart(const std::string& error, const domain::Problem& problem) {
  const std::string owner = error.substr(0, error.rfind('.'));
  return std::ranges::count(problem.parts, owner, &domain::Part::name) > 0;
}

void RequireNormal(const Value& name, const std::map<std::string, ErrorDistribution>& errors) {
  const auto found = errors.find(name.Text());
  if (found != errors.end() && found->second.shape == ErrorDistribution::Shape::kNormal &&
      !found->second.IsCutOff())
    return;
  name.Fail(fmt::format("'{}' has no normal distribution", name.Text()),
            "errors with {normal: DEVIATION}");
}

Correlation ReadCorrelation(const Value& item,
                            const std::map<std::string, ErrorDistribution>& distributions,
                            const domain::Problem& problem) {
  const std::vector<Value> entries = item.Items();
  if (entries.size() != 3) item.Fail("a correlation has three entries", "[ERROR, ERROR, NUMBER]");
  for (const std::size_t i : {0U, 1U}) RequireNormal(entries[i], distributions);
  const Correlation read = {entries[0].Text(), entries[1].Text(), entries[2].Number()};
  const auto is_of_hand = [](const std::string& error) { return error.starts_with("hand."); };
  const bool are_of_hand = is_of_hand(read.first) && is_of_hand(read.second);
  const bool are_of_parts = IsOfPart(read.first, problem) && IsOfPart(read.second, problem);
  if (read.first == read.second || (!are_of_hand && !are_of_parts))
    item.Fail("these errors have no correlation", "two errors of parts, or two errors of the hand");
  if (std::abs(read.coefficient) > 1) entries[2].Fail("this is no correlation", "-1 to 1");
  return read;
}

// The errors have these correlations at once if and only if the matrix has no negative eigenvalue.
bool CanHold(const std::vector<Correlation>& correlations) {
  std::vector<std::string> names;
  const auto index = [&](const std::string& name) {
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return found - names.begin();
    names.push_back(name);
    return static_cast<std::ptrdiff_t>(names.size()) - 1;
  };
  for (const Correlation& correlation : correlations) {
    index(correlation.first);
    index(correlation.second);
  }
  const auto size = static_cast<Eigen::Index>(names.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
  for (const auto& [first, second, coefficient] : correlations) {
    matrix(index(first), index(second)) = coefficient;
    matrix(index(second), index(first)) = coefficient;
  }
  return Eigen::LDLT<Eigen::MatrixXd>(matrix).isPositive();
}

}  // namespace

std::map<std::string, ErrorDistribution> ReadDistributions(const Value& distributions,
                                                           const domain::Units& units,
                                                           const domain::Problem& problem) {
  const std::vector<ErrorQuantity> errors = PoseErrorsOf(problem);
  std::map<std::string, ErrorDistribution> read;
  for (const auto& [name, distribution] : distributions.Entries()) {
    const auto group = budget::FindGroup(name.Text(), errors);
    if (!group) {
      name.Fail(fmt::format("'{}' is no error of a pose in this scenario", name.Text()),
                budget::NamesOf(errors));
    }
    for (const std::size_t of : group->quantities) {
      const ErrorQuantity& error = errors[of];
      if (!read.emplace(error.name, ReadDistribution(distribution, error, units)).second)
        name.Fail(fmt::format("'{}' has two distributions", error.name), "each error once");
    }
  }
  return read;
}

std::vector<Correlation> ReadCorrelations(
    const Value& correlations, const std::map<std::string, ErrorDistribution>& distributions,
    const domain::Problem& problem) {
  std::vector<Correlation> read;
  for (const Value& item : correlations.Items())
    read.push_back(ReadCorrelation(item, distributions, problem));
  if (!CanHold(read))
    correlations.Fail("no errors have all these correlations at once", "correlations that agree");
  return read;
}

}  // namespace assay::probability
