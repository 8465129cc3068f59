#include "core/symmetry/dependence.hpp"

#include <algorithm>

namespace qdot {
namespace {

/// row - factor * other.
void subtract(std::vector<Modular>& row, const std::vector<Modular>& other, Modular factor) {
  if (factor.is_zero()) return;
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = row[k] - factor * other[k];
}

}  // namespace

bool RowSpace::add(std::vector<Modular> row) {
  for (std::size_t r = 0; r < rows_.size(); ++r) subtract(row, rows_[r], row[leads_[r]]);
  const auto lead = std::ranges::find_if(row, [](Modular entry) { return !entry.is_zero(); });
  if (lead == row.end()) return false;
  const auto column = static_cast<std::size_t>(lead - row.begin());
  const Modular scale = inverse(*lead);
  for (Modular& entry : row) entry = entry * scale;
  for (std::vector<Modular>& other : rows_) subtract(other, row, other[column]);
  rows_.push_back(std::move(row));
  leads_.push_back(column);
  return true;
}

std::vector<std::vector<Modular>> RowSpace::dependences() const {
  std::vector<std::vector<Modular>> basis;
  for (std::size_t free = 0; free < columns_; ++free) {
    if (std::ranges::find(leads_, free) != leads_.end()) continue;
    std::vector<Modular> x(columns_);
    x[free] = Modular(1);
    for (std::size_t r = 0; r < rows_.size(); ++r) x[leads_[r]] = -rows_[r][free];
    basis.push_back(std::move(x));
  }
  return basis;
}

}  // namespace qdot
