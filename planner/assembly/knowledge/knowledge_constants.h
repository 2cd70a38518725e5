#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planner/contingent/language/domain.h"

namespace assay::assembly {

// The functions of a part that stand for its error variables.
inline constexpr std::array kErrorFunctions = {"dx", "dy", "theta"};

// The constants of the contingent planning problem. Names of errors, parts and poses are arbitrary,
// so they are spelled as .pks names.
class KnowledgeConstants {
 public:
  KnowledgeConstants();

  // Reserves the name of a step, which no other constant may have.
  void Reserve(const std::string& step) { taken_.insert(step); }
  void AddStep(const std::string& step) { by_type_["step"].insert(step); }
  // Returns the constant that spells the name of a part, pose or error.
  const std::string& Of(const std::string& type, const std::string& name);

  std::vector<contingent::TypedName> Declarations() const;
  // Returns the names that the constants spell, indexed by constant.
  std::map<std::string, std::string> TakeNames() { return std::move(names_); }

 private:
  std::map<std::string, std::set<std::string>> by_type_;
  std::map<std::pair<std::string, std::string>, std::string> spelled_;  // indexed by type and name
  std::map<std::string, std::string> names_;
  std::set<std::string> taken_;
};

}  // namespace assay::assembly
