#include "core/closed/place_brackets.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "core/closed/one_unknown.hpp"

namespace qdot {
namespace {

/// e = first u_0 + second u_1 + rest with u_k = B_k^(exponent).
struct LinearForce {
  std::array<Polynomial, 2> slopes;
  Polynomial rest;
};

class Brackets {
 public:
  Brackets(Graph& graph, const std::vector<Expression>& x, const SignOf& sign)
      : graph_(graph), x_(x), sign_(sign) {}

  /// False where the force has more brackets, or products of them.
  [[nodiscard]] bool take(const Polynomial& force) {
    forces_.emplace_back();
    for (const auto& [monomial, coefficient] : force) {
      Monomial rest;
      std::optional<std::size_t> bracket;
      for (const Atom& atom : monomial) {
        if (!is_bracket(atom)) {
          rest.push_back(atom);
          continue;
        }
        const auto known = number_of(atom);
        if (bracket || !known) return false;
        bracket = known;
      }
      add(bracket ? forces_.back().slopes[*bracket] : forces_.back().rest, rest, coefficient);
    }
    return true;
  }

  [[nodiscard]] std::vector<Expression> equations() const {
    if (forces_.size() != 2 || brackets_.size() != 2) return {};
    std::vector<Expression> found;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto value = value_of(k);
      if (!value) return {};
      found.push_back(Expression(graph_, brackets_[k].base) - *value);
    }
    const std::vector<Expression> both = found;
    for (const Expression& x : x_) {
      if (const auto left = without_square(both[0], both[1], x)) found.push_back(*left);
    }
    return found;
  }

 private:
  [[nodiscard]] bool depends(const Expression& e) const { return depends_on(e, x_); }

  [[nodiscard]] bool is_bracket(const Atom& atom) const {
    const Expression base(graph_, atom.base);
    return atom.q > 1 && std::holds_alternative<Sum>(base.node()) && depends(base);
  }

  /// Each bracket has one exponent.
  [[nodiscard]] std::optional<std::size_t> number_of(const Atom& atom) {
    for (std::size_t k = 0; k < brackets_.size(); ++k) {
      if (brackets_[k].base == atom.base) return brackets_[k] == atom ? std::optional(k) : std::nullopt;
    }
    if (brackets_.size() == 2) return std::nullopt;
    brackets_.push_back(atom);
    return brackets_.size() - 1;
  }

  /// B_k by Cramer's rule; none where it depends on the place.
  [[nodiscard]] std::optional<Expression> value_of(std::size_t k) const {
    const auto &a = forces_[0], &b = forces_[1];
    const std::size_t other = 1 - k;
    Polynomial below = a.slopes[k] * b.slopes[other], above = b.rest * a.slopes[other];
    add(below, a.slopes[other] * b.slopes[k], Number(-1));
    add(above, a.rest * b.slopes[other], Number(-1));
    if (below.empty() || above.empty()) return std::nullopt;
    const RationalFunction power = in_lowest_terms(above, below);
    const Expression u = to_expression(graph_, power);
    if (depends(u) || sign_(power.above) * sign_(power.below) <= 0) return std::nullopt;
    const Number exponent = Number::ratio(brackets_[k].p, brackets_[k].q);
    return exponent.is_negative() ? root_of_power(graph_.number(1) / u, -exponent, sign_)
                                  : root_of_power(u, exponent, sign_);
  }

  /// The combination of a and b in which x^2 does not stand.
  [[nodiscard]] std::optional<Expression> without_square(const Expression& a, const Expression& b,
                                                         const Expression& x) const {
    const auto slope = [&](const Expression& e) { return expand(differentiate(differentiate(e, x), x)); };
    const Expression of_a = slope(a), of_b = slope(b);
    if (of_a.is_zero() || of_b.is_zero() || depends(of_a) || depends(of_b)) return std::nullopt;
    const Expression left = expand(of_b * a - of_a * b);
    return left.is_zero() ? std::nullopt : std::optional(left);
  }

  Graph& graph_;
  const std::vector<Expression>& x_;
  const SignOf& sign_;
  std::vector<Atom> brackets_;
  std::vector<LinearForce> forces_;
};

}  // namespace

std::vector<Expression> equations_of_brackets(const std::vector<Expression>& forces,
                                              const std::vector<Expression>& x, const SignOf& sign) {
  if (x.size() != 2) return {};
  Brackets brackets(x[0].graph(), x, sign);
  for (const Expression& force : forces) {
    const Polynomial terms = multiplied_out(force);
    if (!terms.empty() && !brackets.take(terms)) return {};
  }
  return brackets.equations();
}

}  // namespace qdot
