#include "core/closed/exact_ends.hpp"

#include <cmath>
#include <map>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/closed/algebra_budget.hpp"
#include "core/closed/exact_roots.hpp"
#include "core/closed/linear_motions.hpp"
#include "core/steady/search_region.hpp"

namespace qdot {
namespace {

/// The number was found at an end of the region far out, not at infinity.
constexpr double as_found = 1e-9;

/// By powers of x; none where x stands in other functions.
std::optional<std::map<int, Polynomial>> coefficients(const Expression& force, const Expression& x) {
  std::map<int, Polynomial> parts;
  for (const auto& [monomial, coefficient] : rational_function(force).above) {
    const int power = exponent_of(monomial, x.id());
    const Monomial rest = times(monomial, x.id(), -power);
    if (depends_on(to_expression(force.graph(), rest), x)) return std::nullopt;
    add(parts[power], rest, coefficient);
  }
  std::erase_if(parts, [](const auto& part) { return part.second.empty(); });
  return parts;
}

/// Of the coefficient of the highest power of x, where the next lower power stays.
std::optional<Expression> root_at_infinity(const LinearMotions& motions, const ExactValues& values,
                                           const Expression& p, double near) {
  const auto parts = coefficients(motions.forces[0], motions.x[0]);
  if (!parts || parts->size() < 2) return std::nullopt;
  const auto highest = parts->rbegin(), next = std::next(highest);
  if (next->first != highest->first - 1) return std::nullopt;
  const Expression leading = to_expression(*motions.graph, highest->second);
  for (const Expression& root : roots_in(leading, p, values)) {
    const std::vector<Replacement> there{{p, root}};
    const Real rest = values.value(substitute(to_expression(*motions.graph, next->second), there));
    if (!(std::abs(rest.value) > rest.error)) continue;
    if (agrees(values.value(root), near, as_found * std::abs(near)) &&
        rational_function(substitute(leading, there)).is_zero())
      return root;
  }
  return std::nullopt;
}

std::optional<ClosedForm> form_at(const Dynamics& dynamics, const Reals& given, const Reals& y,
                                  std::size_t index, const WrittenTexts& written, double value) {
  Reals there = given;
  there.set(index, value);
  const auto statics = dynamics.statics(there);
  if (statics->rest.size() != 1 || !momenta_vanish(dynamics, *statics, there, y)) return std::nullopt;
  const LinearMotions motions = linear_motions(statics->reduction, dynamics.model().scene);
  const ExactValues values(dynamics.model(), motions.graph, written, there, index);
  const auto root = root_at_infinity(motions, values, values.symbols()[index], value);
  return root ? closed_form(values, *root, {}) : std::nullopt;
}

}  // namespace

std::vector<std::optional<ClosedForm>> exact_end_values(const Dynamics& dynamics, const Reals& parameters,
                                                        const Reals& y, std::size_t index,
                                                        const WrittenTexts& written,
                                                        const Bifurcations& found) {
  std::vector<std::optional<ClosedForm>> result;
  for (const EndCrossing& crossing : found.crossings) {
    result.emplace_back();
    const double value = crossing.p.middle();
    const bool is_far = std::abs(crossing.end) >= largest_length;
    if (!is_far || value == 0 || dynamics.model().has_constraints()) continue;
    try {
      const WorkScope budget(most_algebra);
      result.back() = form_at(dynamics, parameters, y, index, written, value);
    } catch (const Error&) {  // the algebra grows too large, or divides by what vanishes
    }
  }
  return result;
}

}  // namespace qdot
