#include "planner/motion/paths/tree_search.h"

#include "planner/base/module.h"

namespace assay::motion {

const TreeSearch& TreeSearchOfOmpl() {
  static const TreeSearch& search = Open<TreeSearch>({.file = "libassay_ompl.so",
                                                      .entry = "AssayTreeSearch",
                                                      .needed_for = "path searches",
                                                      .debian_packages = "libompl16"});
  return search;
}

}  // namespace assay::motion
