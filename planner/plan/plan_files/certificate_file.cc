#include "planner/plan/plan_files/certificate_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "planner/base/check.h"
#include "planner/plan/certificates/condition_table.h"

namespace assay::plan {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Texts of the enum Relation, in its order.
const std::vector<std::string> kRelations = {"<", ">"};

// JSON has no infinity, so infinite numbers become texts.
Json NumberToJson(double number) {
  ASSAY_CHECK(!std::isnan(number), "a certificate holds a number that is none");
  if (std::isfinite(number)) return number;
  return number > 0 ? "inf" : "-inf";
}

double ReadNumber(const Value& value) {
  if (value.IsScalar() && value.Text() == "inf") return kInfinity;
  if (value.IsScalar() && value.Text() == "-inf") return -kInfinity;
  return value.Number();
}

Json IntervalToJson(const Interval& interval) {
  return Json::array({NumberToJson(interval.low), NumberToJson(interval.high)});
}

Interval ReadInterval(const Value& value) {
  const std::vector<Value> ends = value.Items();
  if (ends.size() != 2) value.Fail(fmt::format("{} ends", ends.size()), "[low, high]");
  const Interval interval = {ReadNumber(ends[0]), ReadNumber(ends[1])};
  if (interval.low > interval.high) value.Fail("the range goes down", "[low, high]");
  return interval;
}

// Writes a list by writing each of its items in the same way.
template <class T, class Write>
Json ListToJson(const std::vector<T>& items, const Write& write) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(write(item));
  return list;
}

template <class T, class Read>
std::vector<T> ReadList(const Value& list, const Read& read) {
  std::vector<T> items;
  for (const Value& item : list.Items()) items.push_back(read(item));
  return items;
}

Json VariableToJson(const ErrorVariable& variable) {
  return {{"name", variable.name}, {"range", IntervalToJson(variable.range)}};
}

ErrorVariable ReadVariable(const Value& value) {
  value.AllowOnly({"name", "range"});
  const Value name = value.At("name");
  const ErrorKind* kind = ErrorKindOf(name.Text());
  if (kind == nullptr) {
    name.Fail(fmt::format("'{}' names no error of a part or of the hand", name.Text()),
              "names like dx_block and theta_hand");
  }
  return {name.Text(), ReadInterval(value.At("range")), kind->dimension};
}

// Writes a point: the value of each variable by its name.
Json PointToJson(const std::vector<ErrorValue>& point) {
  Json json = Json::object();
  for (const auto& [name, value] : point) json[name] = NumberToJson(value);
  return json;
}

std::vector<ErrorValue> ReadPoint(const Value& map) {
  std::vector<ErrorValue> point;
  for (const auto& [name, value] : map.Entries()) point.push_back({name.Text(), ReadNumber(value)});
  return point;
}

Json PreconditionToJson(const CertifiedPrecondition& precondition) {
  return {{"condition", precondition.condition.name()},
          {"meaning", precondition.meaning},
          {"expression", precondition.expression},
          {"relation", kRelations[static_cast<std::size_t>(precondition.relation)]},
          {"limit", NumberToJson(precondition.limit)},
          {"bound", NumberToJson(precondition.bound)},
          {"margin", NumberToJson(precondition.margin)},
          {"gap", NumberToJson(precondition.gap)},
          {"rung", precondition.method},
          {"worst", PointToJson(precondition.worst)}};
}

// Reads the name of one of the kinds.
Condition ReadCondition(const Value& name, ConditionKinds kinds) {
  return *kinds[static_cast<std::size_t>(name.OneOf(NamesOfConditions(kinds)))];
}

CertifiedPrecondition ReadPrecondition(const Value& value, ConditionKinds kinds) {
  value.AllowOnly({"condition", "meaning", "expression", "relation", "limit", "bound", "margin",
                   "gap", "rung", "worst"});
  return {.condition = ReadCondition(value.At("condition"), kinds),
          .meaning = value.At("meaning").Text(),
          .expression = value.At("expression").Text(),
          .relation = static_cast<Relation>(value.At("relation").OneOf(kRelations)),
          .limit = ReadNumber(value.At("limit")),
          .bound = ReadNumber(value.At("bound")),
          .margin = ReadNumber(value.At("margin")),
          .gap = ReadNumber(value.At("gap")),
          .method = value.At("rung").Text(),
          .worst = ReadPoint(value.At("worst")),
          .circumstance = CircumstanceOf(value.At("meaning").Text())};
}

// Writes what the certificate covers: the number of preconditions of each kind, or the reason why
// there are none.
Json CoverageToJson(const Certificate& certificate) {
  Json covers = Json::object();
  for (const CertifiedPrecondition& claim : certificate.preconditions) {
    Json& count = covers[claim.condition.name()];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  for (const auto& [condition, reason] : certificate.not_needed) covers[condition.name()] = reason;
  return covers;
}

// Checks that the number written for each kind is the number of its preconditions.
std::vector<NotNeeded> ReadCoverage(const Value& covers, ConditionKinds kinds,
                                    const std::vector<CertifiedPrecondition>& preconditions) {
  std::vector<NotNeeded> not_needed;
  for (const auto& [name, value] : covers.Entries()) {
    const Condition condition = ReadCondition(name, kinds);
    const auto count =
        std::ranges::count(preconditions, condition, &CertifiedPrecondition::condition);
    if (count == 0) {
      not_needed.push_back({condition, value.Text()});
    } else if (value.Text() != std::to_string(count)) {
      value.Fail(fmt::format("'{}' of '{}'", value.Text(), name.Text()),
                 fmt::format("{}, as many as there are", count));
    }
  }
  for (const CertifiedPrecondition& claim : preconditions) covers.At(claim.condition.name());
  return not_needed;
}

Json ErrorSetToJson(const ErrorSet& errors, const domain::Problem& problem) {
  Json json = {{"part", problem.part(errors.part).name}, {"in_hand", errors.in_hand}};
  for (const ErrorComponent& component : ErrorComponents()) {
    json[component.name] = IntervalToJson(errors.*component.range);
  }
  return json;
}

ErrorSet ReadErrorSet(const Value& value, const domain::Problem& problem) {
  value.AllowOnly({"part", "in_hand", "x", "y", "z", "theta", "tip", "twist"});
  std::vector<std::string> names;
  for (const domain::Part& part : problem.parts) names.push_back(part.name);
  ErrorSet errors;
  errors.part = domain::PartId(value.At("part").OneOf(names));
  errors.in_hand = value.At("in_hand").Flag();
  for (const ErrorComponent& component : ErrorComponents()) {
    errors.*component.range = ReadInterval(value.At(component.name));
  }
  return errors;
}

Json ResolutionToJson(const Resolution& resolution, const std::vector<std::string>& step_names) {
  const auto name = [&](StepId step) { return step_names[step.index()]; };
  return {{"resolver", resolution.resolver},
          {"steps", ListToJson(resolution.steps, name)},
          {"why", resolution.why}};
}

Resolution ReadResolution(const Value& value, const std::vector<std::string>& step_names) {
  value.AllowOnly({"resolver", "steps", "why"});
  const auto step = [&](const Value& name) { return StepId(name.OneOf(step_names)); };
  return {.resolver = value.At("resolver").Text(),
          .steps = ReadList<StepId>(value.At("steps"), step),
          .why = value.At("why").Text()};
}

}  // namespace

Json ToJson(const Certificate& certificate, const domain::Problem& problem,
            const std::vector<std::string>& step_names) {
  const auto set = [&](const ErrorSet& errors) { return ErrorSetToJson(errors, problem); };
  const auto resolution = [&](const Resolution& r) { return ResolutionToJson(r, step_names); };
  return {{"variables", ListToJson(certificate.variables, VariableToJson)},
          {"shared", certificate.shared},
          {"before", ListToJson(certificate.before, set)},
          {"covers", CoverageToJson(certificate)},
          {"preconditions", ListToJson(certificate.preconditions, PreconditionToJson)},
          {"after", ListToJson(certificate.after, set)},
          {"resolutions", ListToJson(certificate.resolutions, resolution)}};
}

Certificate ReadCertificate(const Value& value, const domain::Problem& problem,
                            const std::vector<std::string>& step_names, ConditionKinds kinds) {
  value.AllowOnly(
      {"variables", "shared", "before", "covers", "preconditions", "after", "resolutions"});
  const auto precondition = [&](const Value& p) { return ReadPrecondition(p, kinds); };
  const auto set = [&](const Value& errors) { return ReadErrorSet(errors, problem); };
  const auto resolution = [&](const Value& r) { return ReadResolution(r, step_names); };
  const auto text = [](const Value& t) { return t.Text(); };
  Certificate certificate = {
      .variables = ReadList<ErrorVariable>(value.At("variables"), ReadVariable),
      .shared = ReadList<std::string>(value.At("shared"), text),
      .before = ReadList<ErrorSet>(value.At("before"), set),
      .preconditions = ReadList<CertifiedPrecondition>(value.At("preconditions"), precondition),
      .after = ReadList<ErrorSet>(value.At("after"), set),
      .resolutions = ReadList<Resolution>(value.At("resolutions"), resolution)};
  certificate.not_needed = ReadCoverage(value.At("covers"), kinds, certificate.preconditions);
  return certificate;
}

}  // namespace assay::plan
