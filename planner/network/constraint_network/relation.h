#pragma once

#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "planner/network/constraint_network/label_set.h"

namespace assay::network {

using LabelPair = std::pair<Label, Label>;  // row and column

// The pairs of labels that an arc allows between its first node (rows) and its second node
// (columns). A relation is immutable, so that arcs, networks and their copies can share it.
class Relation {
 public:
  using Predicate = std::function<bool(Label row, Label column)>;

  static std::shared_ptr<const Relation> Where(int rows, int columns, const Predicate& allowed);
  static std::shared_ptr<const Relation> Allowing(int rows, int columns,
                                                  std::span<const LabelPair> pairs);
  static std::shared_ptr<const Relation> Forbidding(int rows, int columns,
                                                    std::span<const LabelPair> pairs);

  int rows() const { return by_row_.count; }
  int columns() const { return by_column_.count; }
  bool Allows(Label row, Label column) const;

  // One direction of the relation: for each label of one end, its supports at the other end.
  struct Direction {
    int count = 0;               // the number of labels of this end
    int words = 0;               // words in a label set of the other end
    int most_unsupporting = 0;   // most labels at the other end that one label forbids
    std::vector<Word> supports;  // count x words

    std::span<const Word> Of(Label label) const {
      return {supports.data() + static_cast<std::ptrdiff_t>(label) * words,
              static_cast<std::size_t>(words)};
    }
  };
  const Direction& by_row() const { return by_row_; }
  const Direction& by_column() const { return by_column_; }

  bool operator==(const Relation& other) const;

 private:
  Relation(int rows, int columns);
  void Allow(Label row, Label column);
  void Forbid(Label row, Label column);
  void CheckPair(Label row, Label column) const;
  static std::shared_ptr<const Relation> Finish(Relation relation);

  Direction by_row_, by_column_;
};

}  // namespace assay::network
