// The target reads a workcell file that may name the repository's robots and grippers.

#include "planner/domain/workcell/workcell.h"
#include "planner/domain/workcell/workcell_file.h"
#include "tests/fuzz/reader_input.h"

namespace {

using assay::fuzz::kModels;

// Makes a folder of models with the repository's robots and grippers.
void PrepareModels() {
  namespace fs = std::filesystem;
  for (const char* folder : {"robots", "grippers"}) {
    const fs::path link = assay::ScratchFile("models/" + std::string(folder));
    fs::create_directories(link.parent_path());
    if (!fs::exists(link)) fs::create_directory_symlink(kModels / folder, link);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  static const bool is_prepared = (PrepareModels(), true);
  static_cast<void>(is_prepared);
  return fuzz::RefusesOrDoes([&] {
    domain::WorkcellFile::Read(
        fuzz::FileOf(fuzz::TextOf(data, size), "models/workcells/fuzzed/workcell.yaml"));
  });
}
