#pragma once

#include <algorithm>
#include <cstdlib>
#include <span>
#include <string>

#include "planner/base/random.h"

// Random mistakes in files of domains and problems.
namespace assay::contingent {

// Returns the number of mutated files. The variable ASSAY_MUTATIONS sets another number, like
// 10000.
inline int MutationCount() {
  const char* count = std::getenv("ASSAY_MUTATIONS");
  return count == nullptr ? 1000 : std::atoi(count);
}

// Replaces a word of the text, at `at` or after it, by another word of the text.
inline std::string WithOtherWord(std::string text, int at, RandomStream& random) {
  constexpr const char* kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
  const int size = static_cast<int>(text.size());
  const std::size_t from = text.find_first_of(kLetters, at);
  const std::size_t to = text.find_first_of(kLetters, random.Index(size));
  if (from == std::string::npos || to == std::string::npos) return text;
  const std::size_t from_end = std::min(text.find_first_not_of(kLetters, from), text.size());
  const std::size_t to_end = std::min(text.find_first_not_of(kLetters, to), text.size());
  return text.replace(from, from_end - from, std::string(text, to, to_end - to));
}

// Returns the text with one mistake: a piece is left out, one of `pieces` is inserted, a piece is
// doubled, the rest is cut off, or a word is replaced.
inline std::string Mutated(const std::string& text, std::span<const char* const> pieces,
                           RandomStream& random) {
  std::string mutated = text;
  const int size = static_cast<int>(text.size());
  const int at = random.Index(size);
  const int length = std::min(random.Index(12), size - at);
  const std::string piece = pieces[random.Index(static_cast<int>(pieces.size()))];
  switch (random.Index(5)) {
    case 0:
      return mutated.erase(at, length);
    case 1:
      return mutated.insert(at, piece);
    case 2:
      return mutated.insert(random.Index(size), text.substr(at, length));
    case 3:
      return mutated.substr(0, at);
    default:
      return WithOtherWord(mutated, at, random);
  }
}

}  // namespace assay::contingent
