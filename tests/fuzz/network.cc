// The target reads a constraint network and labels it with a small budget.

#include "planner/network/constraint_network/network_file.h"
#include "tests/fuzz/reader_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  return fuzz::RefusesOrDoes([&] {
    const network::NamedNetwork named =
        network::ReadNetwork(Document::Parse(fuzz::TextOf(data, size), "network.yaml"));
    Budget budget(1000);
    network::LabelNetwork(named, network::LabelRequest::kFirst, budget);
  });
}
