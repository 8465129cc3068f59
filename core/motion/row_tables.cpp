#include "core/motion/row_tables.hpp"

#include <algorithm>

#include "core/numerics/pairs.hpp"

namespace qdot {

std::vector<double> largest_in_columns(std::span<const double> table, std::size_t width) {
  std::vector<double> largest(width);
  for (std::size_t k = 0; k < width; k += 2) {
    PairOfDoubles most{};
    for (std::size_t i = k; i < table.size(); i += width)
      most = larger_or(magnitudes(pair_at(&table[i])), most);
    put_pair(&largest[k], most);
  }
  return largest;
}

std::vector<double> largest_differences(std::span<const double> one, std::span<const double> other,
                                        std::size_t width) {
  const std::size_t count = std::min(one.size(), other.size());
  std::vector<double> largest(width);
  for (std::size_t k = 0; k < width; k += 2) {
    PairOfDoubles most{};
    for (std::size_t i = k; i < count; i += width)
      most = larger_or(magnitudes(pair_at(&one[i]) - pair_at(&other[i])), most);
    put_pair(&largest[k], most);
  }
  return largest;
}

std::vector<bool> columns_that_vary(std::span<const double> table, std::size_t width) {
  std::vector<bool> varies(width);
  if (table.empty()) return varies;
  for (std::size_t k = 0; k < width; k += 2) {
    const PairOfDoubles first = pair_at(&table[k]);
    auto is_other = first != first;
    for (std::size_t i = k; i < table.size(); i += width) is_other |= pair_at(&table[i]) != first;
    varies[k] = is_other[0] != 0;
    varies[k + 1] = is_other[1] != 0;
  }
  return varies;
}

}  // namespace qdot
