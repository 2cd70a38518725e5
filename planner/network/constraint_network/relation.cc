#include "planner/network/constraint_network/relation.h"

#include <algorithm>
#include <bit>

#include "planner/base/check.h"

namespace assay::network {
namespace {

Relation::Direction NoSupports(int count, int other_count) {
  const int words = WordsFor(other_count);
  return {.count = count,
          .words = words,
          .supports = std::vector<Word>(static_cast<std::size_t>(count) * words, 0)};
}

int CountMembers(std::span<const Word> words) {
  int count = 0;
  for (Word word : words) count += std::popcount(word);
  return count;
}

int MostUnsupporting(const Relation::Direction& direction, int other_count) {
  int most = 0;
  for (Label label = 0; label < direction.count; ++label) {
    most = std::max(most, other_count - CountMembers(direction.Of(label)));
  }
  return most;
}

Word& WordOf(Relation::Direction& direction, Label label, Label support) {
  return direction
      .supports[static_cast<std::size_t>(label) * direction.words + support / kWordBits];
}

}  // namespace

Relation::Relation(int rows, int columns)
    : by_row_(NoSupports(rows, columns)), by_column_(NoSupports(columns, rows)) {
  ASSAY_CHECK(rows >= 0 && rows <= kMaxLabels && columns >= 0 && columns <= kMaxLabels);
}

std::shared_ptr<const Relation> Relation::Where(int rows, int columns, const Predicate& allowed) {
  Relation relation(rows, columns);
  for (Label row = 0; row < rows; ++row) {
    for (Label column = 0; column < columns; ++column) {
      if (allowed(row, column)) relation.Allow(row, column);
    }
  }
  return Finish(std::move(relation));
}

std::shared_ptr<const Relation> Relation::Allowing(int rows, int columns,
                                                   std::span<const LabelPair> pairs) {
  Relation relation(rows, columns);
  for (const auto& [row, column] : pairs) relation.Allow(row, column);
  return Finish(std::move(relation));
}

std::shared_ptr<const Relation> Relation::Forbidding(int rows, int columns,
                                                     std::span<const LabelPair> pairs) {
  Relation relation(rows, columns);
  for (Label row = 0; row < rows; ++row) {
    for (Label column = 0; column < columns; ++column) relation.Allow(row, column);
  }
  for (const auto& [row, column] : pairs) relation.Forbid(row, column);
  return Finish(std::move(relation));
}

bool Relation::Allows(Label row, Label column) const {
  CheckPair(row, column);
  return (by_row_.Of(row)[column / kWordBits] & BitOf(column)) != 0;
}

bool Relation::operator==(const Relation& other) const {
  return rows() == other.rows() && columns() == other.columns() &&
         by_row_.supports == other.by_row_.supports;
}

void Relation::Allow(Label row, Label column) {
  CheckPair(row, column);
  WordOf(by_row_, row, column) |= BitOf(column);
  WordOf(by_column_, column, row) |= BitOf(row);
}

void Relation::Forbid(Label row, Label column) {
  CheckPair(row, column);
  WordOf(by_row_, row, column) &= ~BitOf(column);
  WordOf(by_column_, column, row) &= ~BitOf(row);
}

void Relation::CheckPair(Label row, Label column) const {
  ASSAY_CHECK(row >= 0 && row < rows() && column >= 0 && column < columns(),
              "pair ({}, {}) of a {} x {} relation", row, column, rows(), columns());
}

std::shared_ptr<const Relation> Relation::Finish(Relation relation) {
  relation.by_row_.most_unsupporting = MostUnsupporting(relation.by_row_, relation.columns());
  relation.by_column_.most_unsupporting = MostUnsupporting(relation.by_column_, relation.rows());
  return std::make_shared<const Relation>(std::move(relation));
}

}  // namespace assay::network
