#include "core/motion/row_tables.hpp"

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

}  // namespace qdot
