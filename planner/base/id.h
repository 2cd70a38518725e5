#pragma once

#include <compare>
#include <cstddef>
#include <functional>

namespace assay {

// The index of one kind of object (a node, a part, a step) in its own type, so that a part's index
// cannot be passed to a function that expects a step's. None() stands for no object.
template <class Tag>
class Id {
 public:
  constexpr Id() = default;
  constexpr explicit Id(int index) : index_(index) {}
  constexpr explicit Id(std::size_t index) : index_(static_cast<int>(index)) {}

  static constexpr Id None() { return Id(); }
  constexpr bool IsNone() const { return index_ < 0; }
  constexpr int index() const { return index_; }

  constexpr auto operator<=>(const Id&) const = default;

 private:
  int index_ = -1;
};

}  // namespace assay

template <class Tag>
struct std::hash<assay::Id<Tag>> {
  std::size_t operator()(assay::Id<Tag> id) const noexcept {
    return static_cast<std::size_t>(id.index());
  }
};
