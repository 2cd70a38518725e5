// The target opens the database of a sweep, summarises it and writes the report.

#include "sim/report/findings/findings.h"
#include "sim/report/findings/read_findings.h"
#include "sim/report/html/page.h"
#include "sim/sweep/database/store.h"
#include "sim/sweep/database/summary.h"
#include "tests/fuzz/reader_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  const std::filesystem::path file = fuzz::FileOf(fuzz::TextOf(data, size), "fuzzed.sqlite");
  return fuzz::RefusesOrDoes([&] {
    const sweep::Store store = sweep::Store::Open(file);
    sweep::Summarize(store);
    report::Page(report::ReadFindings(store, "fuzzed.sqlite"), {});
  });
}
