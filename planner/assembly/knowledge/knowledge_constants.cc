#include "planner/assembly/knowledge/knowledge_constants.h"

#include "planner/contingent/language/spelling.h"
#include "planner/contingent/pks_and_pddl/pks_lexer.h"

namespace assay::assembly {

KnowledgeConstants::KnowledgeConstants() {
  taken_.insert(contingent::kPksSections.begin(), contingent::kPksSections.end());
  taken_.insert("pose");
  taken_.insert(kErrorFunctions.begin(), kErrorFunctions.end());
}

const std::string& KnowledgeConstants::Of(const std::string& type, const std::string& name) {
  const auto [known, is_new] = spelled_.try_emplace({type, name});
  if (is_new) {
    known->second = contingent::Unique(contingent::Spelled(name), taken_);
    by_type_[type].insert(known->second);
    names_.emplace(known->second, name);
  }
  return known->second;
}

std::vector<contingent::TypedName> KnowledgeConstants::Declarations() const {
  std::vector<contingent::TypedName> declarations;
  for (const auto& [type, names] : by_type_) {
    for (const std::string& name : names) declarations.push_back({.name = name, .type = type});
  }
  return declarations;
}

}  // namespace assay::assembly
