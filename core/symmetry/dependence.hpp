#pragma once
// Linear dependences among the columns of a matrix of residues.

#include <vector>

#include "core/symmetry/residue.hpp"

namespace qdot {

/// The row space of a matrix, row by row: in the column where a row leads it has a 1, before it and in those
/// where rows before it lead 0.
class RowSpace {
 public:
  explicit RowSpace(std::size_t columns) : columns_(columns) {}
  /// Whether the row was independent of those before it.
  bool add(std::vector<Modular> row);
  [[nodiscard]] std::size_t rank() const { return rows_.size(); }
  [[nodiscard]] std::size_t columns() const { return columns_; }

  /// A basis of all x with M x = 0: for each column that no row leads the x with 1 there and 0 in the others
  /// of its kind, so that it has to do with columns before it alone.
  [[nodiscard]] std::vector<std::vector<Modular>> dependences() const;

 private:
  /// The others have 0 where a row leads, too.
  [[nodiscard]] std::vector<std::vector<Modular>> reduced() const;

  std::size_t columns_;
  std::vector<std::vector<Modular>> rows_;
  std::vector<std::size_t> leads_;
};

}  // namespace qdot
