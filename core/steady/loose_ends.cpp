#include "core/steady/loose_ends.hpp"

#include <algorithm>
#include <set>

namespace qdot {

bool has_loose_ends(std::span<const EquilibriumBranch> branches, std::span<const CriticalValue> critical,
                    std::span<const double> elsewhere) {
  std::set<double> columns;
  for (const EquilibriumBranch& branch : branches)
    columns.insert(branch.parameter.begin(), branch.parameter.end());
  const auto is_known = [&](double low, double high) {
    return is_known_between(low, high, critical, elsewhere);
  };
  return std::ranges::any_of(branches, [&](const EquilibriumBranch& branch) {
    const auto first = columns.find(branch.parameter.front()), last = columns.find(branch.parameter.back());
    const bool begins = first != columns.begin() && !is_known(*std::prev(first), *first);
    return begins || (std::next(last) != columns.end() && !is_known(*last, *std::next(last)));
  });
}

}  // namespace qdot
