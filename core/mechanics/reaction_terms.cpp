#include "core/mechanics/reaction_terms.hpp"

#include <algorithm>

#include "core/expr/simplify.hpp"

namespace qdot {

ReactionTerms reaction_terms(const Expression& smooth, const Unfolded& unfolded,
                             const std::vector<Expression>& multipliers) {
  ReactionTerms result{smooth, {}, true};
  for (std::size_t k = 0; k < unfolded.sides.size(); ++k) {
    const Expression& s = unfolded.sides[k];
    const Expression& lambda = unfolded.arguments[k];
    const Expression along = differentiate(smooth, s);
    result.of.push_back(differentiate(along, lambda));
    const bool is_size = std::ranges::find(multipliers, lambda) != multipliers.end() &&
                         simplify(along - lambda * result.of[k]).is_zero() &&
                         !depends_on(result.of[k], multipliers) && !depends_on(result.of[k], unfolded.sides);
    result.is_linear = result.is_linear && is_size;
    const std::vector<Replacement> none{{s, s.graph().number(0)}};
    result.without = substitute(result.without, none);
  }
  for (const Expression& lambda : multipliers)
    result.is_linear = result.is_linear && !depends_on(differentiate(result.without, lambda), multipliers);
  return result;
}

bool is_linear_in_reactions(const Expression& component, const std::vector<Expression>& multipliers) {
  if (!depends_on(component, multipliers)) return true;
  const Unfolded all = unfolded({&component, 1}, multipliers);
  return reaction_terms(all.smooth[0], all, multipliers).is_linear;
}

}  // namespace qdot
