#include "sim/noise/noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "planner/base/check.h"
#include "planner/base/input_files/input_error.h"
#include "planner/geometry/pose.h"

namespace assay::noise {
namespace {

// Numbers that a person rounded when copying them may lie outside by this share of the range's
// width.
constexpr double kRounding = 1e-6;

[[noreturn]] void Refuse(const std::string& what, const std::string& allowed) {
  throw InputError({.file = "noise"}, what, allowed);
}

double ParseNumber(std::string_view text, std::string_view name) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    Refuse(fmt::format("'{}' is no number, in {}", text, name), "NAME=NUMBER, metres or radians");
  }
  return value;
}

std::string NamesOf(const std::vector<Channel>& box) {
  std::string names;
  for (const Channel& channel : box) names += (names.empty() ? "" : ", ") + channel.name;
  return names;
}

}  // namespace

Noise::Noise(std::vector<Channel> box, std::vector<double> values)
    : box_(std::make_shared<const std::vector<Channel>>(std::move(box))),
      values_(std::move(values)) {
  ASSAY_CHECK(box_->size() == values_.size());
}

double Noise::Value(Effect effect, PartId part, StepId step) const {
  for (std::size_t i = 0; i < box_->size(); ++i) {
    const Channel& channel = (*box_)[i];
    if (channel.effect == effect && channel.part == part && channel.step == step) {
      return values_[i];
    }
  }
  return 0;
}

Pose Noise::TruePose(PartId part, const Pose& X_WorldPart) const {
  const auto of_start = [&](Effect effect) { return Value(effect, part, StepId::None()); };
  const geometry::Vector3 displacement(of_start(Effect::kPartX), of_start(Effect::kPartY),
                                       of_start(Effect::kTableHeight));
  Pose X_WorldTrue = geometry::RotationZ(of_start(Effect::kPartYaw)) * X_WorldPart;
  X_WorldTrue.translation() = X_WorldPart.translation() + displacement;
  return X_WorldTrue;
}

double Noise::TableHeight(PartId part) const {
  return Value(Effect::kTableHeight, part, StepId::None());
}

std::optional<double> Noise::TableHeight(StepId step) const {
  for (std::size_t i = 0; i < box_->size(); ++i) {
    if ((*box_)[i].effect == Effect::kTableHeight && (*box_)[i].step == step) return values_[i];
  }
  return std::nullopt;
}

Pose Noise::HandError(StepId step) const {
  const auto of_hand = [&](Effect effect) { return Value(effect, PartId::None(), step); };
  return geometry::Translation(of_hand(Effect::kHandX), of_hand(Effect::kHandY),
                               of_hand(Effect::kHandZ)) *
         geometry::RotationZ(of_hand(Effect::kHandYaw));
}

Noise::SensingError Noise::Sensed(StepId step) const {
  SensingError error;
  for (std::size_t i = 0; i < box_->size(); ++i) {
    if ((*box_)[i].step != step) continue;
    if ((*box_)[i].effect == Effect::kSensedX) error.displacement.x() = values_[i];
    if ((*box_)[i].effect == Effect::kSensedY) error.displacement.y() = values_[i];
    if ((*box_)[i].effect == Effect::kSensedZ) error.displacement.z() = values_[i];
    if ((*box_)[i].effect == Effect::kSensedYaw) error.yaw = values_[i];
  }
  return error;
}

double Noise::Of(Effect effect) const { return Value(effect, PartId::None(), StepId::None()); }

std::string Text(const Noise& noise) {
  std::string text;
  for (std::size_t i = 0; i < noise.box().size(); ++i) {
    if (noise.values()[i] == 0) continue;
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", noise.box()[i].name, noise.values()[i]);
  }
  return text;
}

Noise ParseNoise(const std::string& text, std::vector<Channel> box) {
  std::vector<double> values(box.size(), 0);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const auto found = std::ranges::find(box, name, &Channel::name);
    if (equals == std::string::npos || found == box.end()) {
      Refuse(fmt::format("there is no error '{}'", name), NamesOf(box));
    }
    const double value = ParseNumber(std::string_view(word).substr(equals + 1), name);
    const Interval& range = found->range;
    const double slack = kRounding * (range.high - range.low);
    if (!(value >= range.low - slack && value <= range.high + slack)) {
      Refuse(fmt::format("{} is outside of its bounds", word),
             fmt::format("from {} to {}", range.low, range.high));
    }
    values[found - box.begin()] = std::clamp(value, range.low, range.high);
  }
  return {std::move(box), std::move(values)};
}

}  // namespace assay::noise
