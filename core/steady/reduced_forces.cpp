#include "core/steady/reduced_forces.hpp"

#include <algorithm>
#include <optional>
#include <variant>

#include "core/base/error.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_equations = 3, most_reduced = 4;
constexpr std::size_t most_divided_terms = 40;
constexpr int most_divisions = 16;  ///< of a division

class Divisions {
 public:
  explicit Divisions(std::span<const Expression> variables) : variables_(variables) {}

  /// Without the terms that the leading monomial of the divisor divides; none where that grows.
  [[nodiscard]] std::optional<Polynomial> remainder(Polynomial p, const Polynomial& divisor,
                                                    const Monomial& leading) const {
    const Monomial below = inverse(leading);
    const Number coefficient = divisor.at(leading);
    for (int step = 0; step < most_divisions; ++step) {
      const auto divided =
          std::ranges::find_if(p, [&](const auto& term) { return is_finite_everywhere(term.first * below); });
      if (divided == p.end()) return p;
      const Number factor = Number(-1) * divided->second / coefficient;
      add(p, scaled(divisor, divided->first * below, factor));
      if (p.size() > most_divided_terms) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool is_finite_everywhere(const Monomial& m) const {
    return std::ranges::all_of(m, [&](const Atom& atom) {
      const Expression base(variables_[0].graph(), atom.base);
      return !depends_on(base, variables_) || (atom.p > 0 && atom.q == 1 && is_finite(base));
    });
  }

  [[nodiscard]] static bool is_finite(const Expression& atom) {
    const auto* call = std::get_if<Call>(&atom.node());
    if (call == nullptr) return std::holds_alternative<Symbol>(atom.node());
    return call->function == Function::sin || call->function == Function::cos;
  }

  std::span<const Expression> variables_;
};

/// Multiplied out; none where that is long.
std::vector<Polynomial> short_polynomials(std::span<const Expression> equations) {
  std::vector<Polynomial> polynomials;
  try {
    for (const Expression& e : equations) polynomials.push_back(multiplied_out(e));
  } catch (const Error&) {
    return {};
  }
  const bool are_short =
      std::ranges::all_of(polynomials, [](const Polynomial& p) { return p.size() <= most_divided_terms; });
  return are_short ? polynomials : std::vector<Polynomial>();
}

}  // namespace

std::vector<Expression> reduced_equations(std::span<const Expression> equations,
                                          std::span<const Expression> variables) {
  if (equations.size() < 2 || equations.size() > most_equations) return {};
  const std::vector<Polynomial> polynomials = short_polynomials(equations);
  const Divisions divisions(variables);
  std::vector<Polynomial> found;
  for (std::size_t i = 0; i < polynomials.size(); ++i) {
    for (std::size_t j = 0; j < polynomials.size(); ++j) {
      if (i == j) continue;
      for (const auto& [leading, coefficient] : polynomials[j]) {
        const auto now = divisions.remainder(polynomials[i], polynomials[j], leading);
        const bool is_shorter = now && !now->empty() && now->size() < polynomials[i].size();
        if (is_shorter && std::ranges::find(found, *now) == found.end()) found.push_back(*now);
      }
    }
  }
  std::ranges::stable_sort(found, {}, &Polynomial::size);
  if (found.size() > most_reduced) found.resize(most_reduced);
  std::vector<Expression> result;
  for (const Polynomial& p : found) result.push_back(simplify(to_expression(equations[0].graph(), p)));
  return result;
}

}  // namespace qdot
