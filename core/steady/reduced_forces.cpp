#include "core/steady/reduced_forces.hpp"

#include <algorithm>
#include <optional>
#include <set>
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
constexpr std::size_t most_crossed_terms = 12;

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

  /// m_i p - c m_j q, in which the monomials a of p and b of q cancel each other; none where one of them
  /// divides the other, and where m_i or m_j may be infinite.
  [[nodiscard]] std::optional<Polynomial> crossed(const Polynomial& p, const Monomial& a, const Polynomial& q,
                                                  const Monomial& b) const {
    Monomial of_p, of_q;
    for (const Atom& atom : a* inverse(b)) {
      if (atom.p > 0) of_q.push_back(atom);
      if (atom.p < 0) of_p.push_back({atom.base, -atom.p, atom.q});
    }
    if (of_p.empty() || of_q.empty()) return std::nullopt;
    if (!is_finite_everywhere(of_p) || !is_finite_everywhere(of_q)) return std::nullopt;
    Polynomial result = scaled(p, of_p, 1);
    add(result, scaled(q, of_q, Number(-1) * p.at(a) / q.at(b)));
    return result;
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

class Reduced {
 public:
  explicit Reduced(std::span<const Expression> variables) : variables_(variables), divisions_(variables) {}

  /// Of p by q.
  void divide(const Polynomial& p, const Polynomial& q) {
    for (const auto& [leading, coefficient] : q) keep(divisions_.remainder(p, q, leading), length(p));
  }

  void cross(const Polynomial& p, const Polynomial& q) {
    const std::size_t shorter = std::min(length(p), length(q));
    if (std::max(p.size(), q.size()) > most_crossed_terms) return;
    for (const auto& [a, of_p] : p) {
      for (const auto& [b, of_q] : q) keep(divisions_.crossed(p, a, q, b), shorter);
    }
  }

  /// The few that are shortest.
  [[nodiscard]] std::vector<Expression> expressions(Graph& graph) {
    std::ranges::stable_sort(found_, {}, [this](const Polynomial& p) { return length(p); });
    if (found_.size() > most_reduced) found_.resize(most_reduced);
    std::vector<Expression> result;
    for (const Polynomial& p : found_) result.push_back(simplify(to_expression(graph, p)));
    return result;
  }

 private:
  void keep(const std::optional<Polynomial>& p, std::size_t longer) {
    if (!p || p->empty() || length(*p) >= longer) return;
    if (std::ranges::find(found_, *p) == found_.end()) found_.push_back(*p);
  }

  /// How many products of variables have a coefficient, which may be a sum of parameters.
  [[nodiscard]] std::size_t length(const Polynomial& p) const {
    std::set<Monomial, LeadingFirst> parts;
    for (const auto& [monomial, coefficient] : p) {
      Monomial part = monomial;
      std::erase_if(part, [this](const Atom& atom) {
        return !depends_on(Expression(variables_[0].graph(), atom.base), variables_);
      });
      parts.insert(part);
    }
    return parts.size();
  }

  std::span<const Expression> variables_;
  Divisions divisions_;
  std::vector<Polynomial> found_;
};

}  // namespace

std::vector<Expression> reduced_equations(std::span<const Expression> equations,
                                          std::span<const Expression> variables) {
  if (equations.size() < 2 || equations.size() > most_equations) return {};
  const std::vector<Polynomial> polynomials = short_polynomials(equations);
  Reduced reduced(variables);
  for (std::size_t i = 0; i < polynomials.size(); ++i) {
    for (std::size_t j = 0; j < polynomials.size(); ++j) {
      if (i != j) reduced.divide(polynomials[i], polynomials[j]);
      if (i < j) reduced.cross(polynomials[i], polynomials[j]);
    }
  }
  return reduced.expressions(equations[0].graph());
}

}  // namespace qdot
