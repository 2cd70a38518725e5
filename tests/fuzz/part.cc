// The target reads a part file and computes the part's stable poses and grasps.

#include "planner/domain/grasps/grasp.h"
#include "planner/domain/parts/part_file.h"
#include "planner/domain/resting/stable_pose.h"
#include "planner/domain/workcell/workcell.h"
#include "planner/domain/workcell/workcell_file.h"
#include "tests/fuzz/reader_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  static const auto workcell =
      domain::WorkcellFile::Read(fuzz::kModels / "workcells" / "puma762-table" / "workcell.yaml");
  return fuzz::RefusesOrDoes([&] {
    const Document document = Document::Parse(fuzz::TextOf(data, size), "part.yaml");
    const auto model = domain::PartFile::Read(document, 0.0005);
    domain::ComputeGrasps(*model, workcell->gripper(),
                          {.approach_step = workcell->rules().approach_step});
  });
}
