// The target reads a plan tree of the scenario `two-cans` and runs it in every world.

#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/language/externs.h"
#include "planner/contingent/pks_and_pddl/task_file.h"
#include "planner/contingent/plan_tree/tree_file.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "tests/fuzz/reader_input.h"

namespace {

assay::contingent::GroundTask TwoCans() {
  const std::filesystem::path folder = std::filesystem::path(ASSAY_SOURCE_DIR) / "scenarios/know";
  auto [domain, problem] =
      assay::contingent::LoadTask(folder / "force-sensing.pks", folder / "two-cans.pks");
  assay::contingent::Externs externs;
  return assay::contingent::Ground(domain, problem, externs);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  static const contingent::GroundTask task = TwoCans();
  return fuzz::RefusesOrDoes([&] {
    const Document document = Document::Parse(fuzz::TextOf(data, size), "tree.json");
    contingent::CheckTree(task, contingent::ReadTree(document.root(), task), {.worlds = 20});
  });
}
