#include "planner/plan/plan_files/action_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "planner/plan/plan_files/pose_file.h"

namespace assay::plan {
namespace {

using Json = nlohmann::ordered_json;
using domain::Argument;

constexpr double kSameMating = 1e-9;  // metres, and entries of a rotation

// Writes [[of held], [of fixed]], as in a scenario.
Json FeaturesToJson(const domain::Mating& mating) {
  Json features = Json::array({Json::array(), Json::array()});
  for (const auto& [of_held, of_fixed] : mating.features) {
    features[0].push_back(of_held.index());
    features[1].push_back(of_fixed.index());
  }
  return features;
}

Json MatingToJson(const domain::Mating& mating, const domain::Problem& problem) {
  return {{"held", problem.part(mating.held).name},
          {"fixed", problem.part(mating.fixed).name},
          {"features", FeaturesToJson(mating)},
          {"X_FixedHeld", PoseToJson(mating.X_FixedHeld)},
          {"mating_vector", VectorToJson(mating.mating_vector)}};
}

// Returns the keys and values of one argument.
Json ArgumentToJson(Argument argument, const Action& action, const domain::Problem& problem) {
  switch (argument) {
    case Argument::kPart:
      return {{"part", problem.part(action.part).name}};
    case Argument::kMating:
      return MatingToJson(problem.mating(action.mating), problem);
    case Argument::kGrasp:
      return {{"grasp", action.hold.grasp}};
    case Argument::kPosition:
      return {{"position", action.place.position}};
    case Argument::kSensor:
      return {{"sensor", action.sensor}};
  }
  return {};
}

std::vector<std::string> KeysOf(Argument argument) {
  switch (argument) {
    case Argument::kPart:
      return {"part"};
    case Argument::kMating:
      return {"held", "fixed", "features", "X_FixedHeld", "mating_vector"};
    case Argument::kGrasp:
      return {"grasp"};
    case Argument::kPosition:
      return {"position"};
    case Argument::kSensor:
      return {"sensor"};
  }
  return {};
}

Hold ReadHold(const Value& step) {
  const Value hold = step.At("hold");
  hold.AllowOnly({"X_PartTool", "width"});
  const Value width = hold.At("width");
  if (width.Number() < 0) width.Fail("a width below 0", "a length in metres");
  return {step.At("arguments").At("grasp").Text(), ReadPose(hold.At("X_PartTool")), width.Number()};
}

Place ReadPlace(const Value& step) {
  const Value place = step.At("place");
  place.AllowOnly({"X_WorldPart"});
  return {step.At("arguments").At("position").Text(), ReadPose(place.At("X_WorldPart"))};
}

PartId ReadPart(const Value& name, const domain::Problem& problem) {
  std::vector<std::string> names;
  for (const domain::Part& part : problem.parts) names.push_back(part.name);
  return PartId(name.OneOf(names));
}

domain::Mating ReadMatingWords(const Value& arguments, const domain::Problem& problem) {
  domain::Mating mating{.held = ReadPart(arguments.At("held"), problem),
                        .fixed = ReadPart(arguments.At("fixed"), problem),
                        .features = {},
                        .X_FixedHeld = ReadPose(arguments.At("X_FixedHeld")),
                        .mating_vector = ReadVector(arguments.At("mating_vector"))};
  const Value features = arguments.At("features");
  const std::string allowed = "two lists of feature numbers of equal length: of held, of fixed";
  const std::vector<Value> sides = features.Items();
  if (sides.size() != 2) features.Fail(fmt::format("{} lists", sides.size()), allowed);
  const std::vector<Value> of_held = sides[0].Items();
  const std::vector<Value> of_fixed = sides[1].Items();
  if (of_held.size() != of_fixed.size()) features.Fail("lists of different length", allowed);
  const int most = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < of_held.size(); ++i) {
    mating.features.emplace_back(of_held[i].Integer(0, most), of_fixed[i].Integer(0, most));
  }
  return mating;
}

bool AreSame(const domain::Mating& a, const domain::Mating& b) {
  const auto pose_error = (a.X_FixedHeld.matrix() - b.X_FixedHeld.matrix()).cwiseAbs();
  const auto vector_error = (a.mating_vector - b.mating_vector).cwiseAbs();
  return a.held == b.held && a.fixed == b.fixed && a.features == b.features &&
         pose_error.maxCoeff() <= kSameMating && vector_error.maxCoeff() <= kSameMating;
}

MatingId ReadMating(const Value& arguments, const domain::Problem& problem) {
  const domain::Mating words = ReadMatingWords(arguments, problem);
  const auto found = std::ranges::find_if(
      problem.matings, [&](const domain::Mating& mating) { return AreSame(mating, words); });
  if (found == problem.matings.end()) {
    arguments.Fail("the scenario has no such mating",
                   "held, fixed, features, X_FixedHeld and mating_vector of one of its matings");
  }
  return MatingId(static_cast<int>(found - problem.matings.begin()));
}

std::string ReadSensor(const Value& name, const domain::Problem& problem) {
  std::vector<std::string> known;
  for (const auto& sensor : problem.workcell->uncertainty_operations().sensors) {
    known.push_back(sensor.name);
  }
  name.OneOf(known);
  return name.Text();
}

void ReadArgument(Argument argument, const Value& step, const domain::Problem& problem,
                  Action& action) {
  const Value arguments = step.At("arguments");
  switch (argument) {
    case Argument::kPart:
      action.part = ReadPart(arguments.At("part"), problem);
      return;
    case Argument::kMating:
      action.mating = ReadMating(arguments, problem);
      return;
    case Argument::kGrasp:
      action.hold = ReadHold(step);
      return;
    case Argument::kPosition:
      action.place = ReadPlace(step);
      return;
    case Argument::kSensor:
      action.sensor = ReadSensor(arguments.At("sensor"), problem);
      return;
  }
}

const domain::ActionKind& ReadKind(const Value& name, const domain::Problem& problem) {
  std::vector<std::string> names;
  for (const domain::ActionKind* kind : problem.actions) names.emplace_back(kind->name);
  return *problem.actions[name.OneOf(names)];
}

}  // namespace

Json ArgumentsToJson(const Action& action, const domain::Problem& problem) {
  Json arguments = Json::object();
  for (const Argument argument : action.kind->arguments) {
    arguments.update(ArgumentToJson(argument, action, problem));
  }
  return arguments;
}

Json ToJson(const Hold& hold) {
  return {{"X_PartTool", PoseToJson(hold.X_PartTool)}, {"width", hold.width}};
}

Json ToJson(const Place& place) { return {{"X_WorldPart", PoseToJson(place.X_WorldPart)}}; }

Action ReadAction(const Value& step, const domain::Problem& problem) {
  const domain::ActionKind& kind = ReadKind(step.At("name"), problem);
  if (!kind.Has(Argument::kGrasp)) {
    step.AllowOnly(
        {"id", "name", "arguments", "inserted", "executed", "place", "travel", "certificate"});
  }
  std::vector<std::string> keys;
  for (const Argument argument : kind.arguments) {
    std::ranges::move(KeysOf(argument), std::back_inserter(keys));
  }
  step.At("arguments").AllowOnly(keys);
  Action action{.kind = &kind};
  for (const Argument argument : kind.arguments) ReadArgument(argument, step, problem, action);
  return action;
}

}  // namespace assay::plan
