// The target reads a sweep file.

#include "sim/sweep/grid/sweep_file.h"
#include "tests/fuzz/reader_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  const std::string text = fuzz::TextOf(data, size);
  return fuzz::RefusesOrDoes(
      [&] { sweep::ReadSweep(Document::Parse(text, "sweep.yaml"), "sweep.yaml", text); });
}
