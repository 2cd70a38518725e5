#include "planner/domain/workcell/servo_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/domain/units/units.h"

namespace assay::domain {
namespace {

using kinematics::Arm;
using kinematics::ArmServos;
using kinematics::ServoGains;

struct Gain {
  const char* key;
  double ServoGains::*member;
  Unit unit;
  Range range;  // outside of it, a value is probably in a wrong unit
};
constexpr std::array<Gain, 3> kGains = {{
    {"armature", &ServoGains::armature, {"kg m^2"}, {1e-6, 1e6}},
    {"stiffness", &ServoGains::stiffness, {"N m/rad"}, {1, 1e9}},
    {"damping", &ServoGains::damping, {"N m s/rad"}, {1e-3, 1e8}},
}};

ServoGains ReadGains(const Value& value) {
  value.AllowOnly({"armature", "stiffness", "damping"});
  ServoGains gains;
  for (const Gain& gain : kGains) {
    gains.*gain.member = ReadWithin(value.At(gain.key), gain.unit, gain.range);
  }
  return gains;
}

// Returns a number to three significant digits. Large numbers have no exponent.
std::string Rounded(double value) {
  const double rounded = std::stod(fmt::format("{:.3g}", value));
  return rounded < 1000 ? fmt::format("{:g}", rounded) : fmt::format("{:.0f}", rounded);
}

}  // namespace

ArmServos ReadServos(const std::filesystem::path& file, const Arm& arm,
                     const kinematics::LockedJoints& locked,
                     const std::function<ArmServos()>& derive) {
  const Document document = Document::Load(file);
  document.RequireFormat("assay-servos/1");
  const Value& root = document.root();
  root.AllowOnly({"format", "description", "joints"});
  if (const auto description = root.Find("description")) description->Text();
  const Value joints = root.At("joints");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 6; ++i) names.push_back(arm.model().joints[i].name);
  std::vector<std::string> allowed = names;
  for (const auto& [joint, value] : locked) allowed.push_back(joint);
  joints.AllowOnly(allowed);
  const bool lacks_some =
      std::ranges::any_of(names, [&](const std::string& name) { return !joints.Find(name); });
  ArmServos servos = lacks_some && !locked.empty() ? derive() : ArmServos();
  for (std::size_t i = 0; i < servos.size(); ++i) {
    const bool keeps_derived = !locked.empty() && !joints.Find(names[i]);
    if (!keeps_derived) servos[i] = ReadGains(joints.At(names[i]));
  }
  return servos;
}

std::string ServosText(const std::string& description, const Arm& arm, const ArmServos& servos) {
  std::string text = fmt::format(
      "format: assay-servos/1\n"
      "description: {}\n"
      "joints:  # armature in kg m^2, stiffness in N m/rad, damping in N m s/rad\n",
      nlohmann::json(description).dump());
  for (std::size_t i = 0; i < servos.size(); ++i) {
    text +=
        fmt::format("  {}: {{armature: {}, stiffness: {}, damping: {}}}\n",
                    nlohmann::json(arm.model().joints[i].name).dump(), Rounded(servos[i].armature),
                    Rounded(servos[i].stiffness), Rounded(servos[i].damping));
  }
  return text;
}

}  // namespace assay::domain
