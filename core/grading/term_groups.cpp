#include "core/grading/term_groups.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/expr/calculus.hpp"

namespace qdot {

std::vector<TermGroup> groups_of_terms(std::span<const Expression> terms, std::span<const Expression> symbols,
                                       std::span<const Expression> accelerations) {
  constexpr std::size_t most = 24;
  std::vector<TermGroup> groups;
  if (terms.size() > most) return groups;
  for (const Expression& symbol : symbols) {
    std::vector<Expression> sharing;
    std::ranges::copy_if(terms, std::back_inserter(sharing),
                         [&](const Expression& term) { return depends_on(term, symbol); });
    if (sharing.size() < 2 || sharing.size() == terms.size()) continue;
    const Expression sum = symbol.graph().sum(sharing);
    const auto in_sum = [&](const Expression& a) { return depends_on(sum, a); };
    groups.push_back({symbol, sum, std::ranges::any_of(accelerations, in_sum), sharing.size()});
  }
  std::ranges::stable_sort(
      groups, {}, [](const TermGroup& group) { return std::pair(group.has_accelerations, group.count); });
  return groups;
}

}  // namespace qdot
