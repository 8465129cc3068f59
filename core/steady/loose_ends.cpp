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
    const auto is_near = [&](const CriticalValue& c) {
      return c.value + c.error >= low && c.value - c.error <= high;
    };
    const auto is_between = [&](double value) { return value >= low && value <= high; };
    return std::ranges::any_of(critical, is_near) || std::ranges::any_of(elsewhere, is_between);
  };
  return std::ranges::any_of(branches, [&](const EquilibriumBranch& branch) {
    const auto first = columns.find(branch.parameter.front()), last = columns.find(branch.parameter.back());
    const bool begins = first != columns.begin() && !is_known(*std::prev(first), *first);
    return begins || (std::next(last) != columns.end() && !is_known(*last, *std::next(last)));
  });
}

}  // namespace qdot
