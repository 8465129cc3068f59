#include "core/symmetry/dependence.hpp"

#include <algorithm>

namespace qdot {
namespace {

/// row - factor * other, which has 0 before its lead.
void subtract(std::vector<Modular>& row, const std::vector<Modular>& other, std::size_t lead) {
  const Modular factor = row[lead];
  if (factor.is_zero()) return;
  for (std::size_t k = lead; k < row.size(); ++k) row[k] = row[k] - factor * other[k];
}

}  // namespace

bool RowSpace::add(std::vector<Modular> row) {
  for (std::size_t r = 0; r < rows_.size(); ++r) subtract(row, rows_[r], leads_[r]);
  const auto lead = std::ranges::find_if(row, [](Modular entry) { return !entry.is_zero(); });
  if (lead == row.end()) return false;
  const Modular scale = inverse(*lead);
  leads_.push_back(static_cast<std::size_t>(lead - row.begin()));
  for (Modular& entry : row) entry = entry * scale;
  rows_.push_back(std::move(row));
  return true;
}

std::vector<std::vector<Modular>> RowSpace::reduced() const {
  std::vector<std::vector<Modular>> rows = rows_;
  for (std::size_t r = rows.size(); r-- > 0;) {
    for (std::size_t earlier = 0; earlier < r; ++earlier) subtract(rows[earlier], rows[r], leads_[r]);
  }
  return rows;
}

std::vector<std::vector<Modular>> RowSpace::dependences() const {
  if (rank() == columns_) return {};
  const std::vector<std::vector<Modular>> rows = reduced();
  std::vector<std::vector<Modular>> basis;
  for (std::size_t free = 0; free < columns_; ++free) {
    if (std::ranges::find(leads_, free) != leads_.end()) continue;
    std::vector<Modular> x(columns_);
    x[free] = Modular(1);
    for (std::size_t r = 0; r < rows.size(); ++r) x[leads_[r]] = -rows[r][free];
    basis.push_back(std::move(x));
  }
  return basis;
}

}  // namespace qdot
