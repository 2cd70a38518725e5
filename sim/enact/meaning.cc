#include "sim/enact/meaning.h"

#include <array>
#include <vector>

namespace assay::enact {

std::unique_ptr<const Meaning> ReadMeaning(const Value& map, const MeaningContext& context) {
  static constexpr std::array kWords = {&kHeld, &kHandEmpty, &kOver, &kHeavier};
  std::vector<std::string> names = {"internal"};
  for (const MeaningWord* word : kWords) names.emplace_back(word->name);
  const int word = map.At("is").OneOf(names);
  if (word > 0) return kWords[static_cast<std::size_t>(word - 1)]->read(map, context);
  map.AllowOnly({"is"});
  return nullptr;
}

}  // namespace assay::enact
