#include "planner/plan/data/reason.h"

namespace assay::plan {

std::vector<std::string> TextsOf(const std::vector<Reason>& reasons) {
  std::vector<std::string> texts;
  for (const Reason& reason : reasons) texts.push_back(reason.text);
  return texts;
}

}  // namespace assay::plan
