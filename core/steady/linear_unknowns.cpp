#include "core/steady/linear_unknowns.hpp"

#include <algorithm>
#include <optional>
#include <variant>

#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"
#include "core/steady/combined_forces.hpp"

namespace qdot {
namespace {

class Elimination {
 public:
  Elimination(std::vector<Expression> equations, std::span<const Expression> unknowns,
              const std::vector<bool>& may_go, std::span<const Expression> constants,
              const Expression& parameter)
      : may_go_(may_go), x_(unknowns.begin(), unknowns.end()), varying_(x_), constants_(constants) {
    varying_.push_back(parameter);
    result_.equations = std::move(equations);
    result_.values = x_;
    for (std::size_t j = 0; j < x_.size(); ++j) result_.unknowns.push_back(j);
  }

  LinearUnknowns run() {
    while (result_.unknowns.size() > 1 && leaves_one_out()) {
    }
    return std::move(result_);
  }

 private:
  bool leaves_one_out() {
    for (std::size_t i = 0; i < result_.equations.size(); ++i) {
      if (solves(result_.equations[i], i)) return true;
    }
    if (result_.equations.size() != 2) return false;
    const std::vector<Expression> combined = combinations(result_.equations);
    return std::ranges::any_of(combined, [&](const Expression& e) { return solves(simplify(e), 0); });
  }

  /// With `equation` in the place of number i.
  bool solves(const Expression& equation, std::size_t i) {
    for (const std::size_t j : result_.unknowns) {
      if (!may_go_[j]) continue;
      if (const auto value = solved_for(equation, x_[j])) {
        put_in(j, *value, i);
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] std::optional<Expression> solved_for(const Expression& equation, const Expression& x) const {
    const Expression slope = simplify(differentiate(equation, x));
    if (!is_constant_other_than_zero(slope)) return std::nullopt;
    const Expression rest = simplify(equation - slope * x);
    if (depends_on(rest, x) || !is_finite_everywhere(rest)) return std::nullopt;
    return simplify(Number(-1) * rest / slope);
  }

  [[nodiscard]] bool is_constant_other_than_zero(const Expression& slope) const {
    const Polynomial terms = multiplied_out(slope);
    return terms.size() == 1 && std::ranges::all_of(terms.begin()->first, [&](const Atom& atom) {
             return std::ranges::find(constants_, atom.base, &Expression::id) != constants_.end();
           });
  }

  /// Sums, products, whole powers, and functions that are.
  [[nodiscard]] bool is_finite_everywhere(const Expression& e) const {
    const NodeId root = e.id();
    return std::ranges::all_of(reachable(e.graph(), {&root, 1}), [&](NodeId id) {
      const Node& node = e.graph().node(id);
      if (const auto* call = std::get_if<Call>(&node)) {
        return call->function == Function::sin || call->function == Function::cos ||
               call->function == Function::exp;
      }
      const auto* power = std::get_if<Power>(&node);
      if (power == nullptr) return true;
      const Expression base(e.graph(), power->base);
      return !depends_on(base, varying_) || (power->exponent.is_integer() && !power->exponent.is_negative());
    });
  }

  void put_in(std::size_t j, const Expression& value, std::size_t used) {
    const std::vector<Replacement> replacement{{x_[j], value}};
    result_.equations.erase(result_.equations.begin() + static_cast<std::ptrdiff_t>(used));
    for (Expression& e : result_.equations) e = simplify(substitute(e, replacement));
    for (Expression& e : result_.values) e = simplify(substitute(e, replacement));
    std::erase(result_.unknowns, j);
  }

  const std::vector<bool>& may_go_;
  std::vector<Expression> x_, varying_;
  std::span<const Expression> constants_;
  LinearUnknowns result_;
};

}  // namespace

LinearUnknowns without_linear_unknowns(std::vector<Expression> equations,
                                       std::span<const Expression> unknowns, const std::vector<bool>& may_go,
                                       std::span<const Expression> constants, const Expression& parameter) {
  return Elimination(std::move(equations), unknowns, may_go, constants, parameter).run();
}

}  // namespace qdot
