#include "core/closed/place_balances.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/closed/one_unknown.hpp"
#include "core/closed/place_algebra.hpp"

namespace qdot {

Polynomial without_lasting_factors(const Graph& graph, const Polynomial& e) {
  if (e.empty()) return e;
  Monomial lasting;
  for (const Atom& atom : common_monomial(e)) {
    const auto* call = std::get_if<Call>(&graph.node(atom.base));
    if (call != nullptr && (call->function == Function::exp || call->function == Function::cosh))
      lasting.push_back(atom);
  }
  return lasting.empty() ? e : scaled(e, inverse(lasting), Number(1));
}

namespace {

/// What stands before one power of a function of x; before 1 where there is none.
struct Side {
  Polynomial factor;
  std::optional<Atom> power;
};

class Balance {
 public:
  Balance(const PlaceProblem& problem, std::size_t k)
      : problem_(problem), x_(problem.x[k]), graph_(x_.graph()) {}

  [[nodiscard]] std::optional<Expression> of(const Expression& force) {
    for (const auto& [monomial, coefficient] : multiplied_out(force)) {
      if (!take(monomial, coefficient)) return std::nullopt;
    }
    std::erase_if(sides_, [](const Side& side) { return side.factor.empty(); });
    if (sides_.size() != 2) return std::nullopt;
    if (!sides_[0].power) std::swap(sides_[0], sides_[1]);
    const auto exponent = common_exponent();
    return exponent ? equation(*exponent) : std::nullopt;
  }

 private:
  bool take(const Monomial& monomial, const Number& coefficient) {
    Side side;
    Monomial rest;
    for (const Atom& atom : monomial) {
      if (!depends_on(Expression(graph_, atom.base), problem_.x)) {
        rest.push_back(atom);
        continue;
      }
      if (side.power) return false;
      side.power = atom;
    }
    auto same = std::ranges::find(sides_, side.power, &Side::power);
    if (same == sides_.end()) {
      if (sides_.size() == 2) return false;
      same = sides_.insert(sides_.end(), side);
    }
    add(same->factor, rest, coefficient);
    return true;
  }

  /// Of both, where they have one that is not 1 or -1, and are linear; none of x alone.
  [[nodiscard]] std::optional<Number> common_exponent() const {
    const Atom& first = *sides_[0].power;
    const auto is_linear = [&](const Side& side) {
      const Expression base(graph_, side.power->base);
      const Expression slope = differentiate(base, x_);
      return !slope.is_zero() && !depends_on(slope, problem_.x);
    };
    const bool are_equal =
        !sides_[1].power || (sides_[1].power->p == first.p && sides_[1].power->q == first.q);
    if (!are_equal || (first.q == 1 && (first.p == 1 || first.p == -1))) return std::nullopt;
    if (!is_linear(sides_[0]) || (sides_[1].power && !is_linear(sides_[1]))) return std::nullopt;
    if (!sides_[1].power && x_.id() == first.base) return std::nullopt;
    return Number::ratio(first.p, first.q);
  }

  /// A below^(1/m) - s B above^(1/m) with (A/B)^m = above/below, s the sign of A/B.
  [[nodiscard]] std::optional<Expression> equation(const Number& exponent) const {
    const RationalFunction ratio = -in_lowest_terms(sides_[1].factor, sides_[0].factor);
    const Expression a(graph_, sides_[0].power->base);
    const Expression b = sides_[1].power ? Expression(graph_, sides_[1].power->base) : graph_.number(1);
    const int side = problem_.sign(multiplied_out(a)) * problem_.sign(multiplied_out(b));
    const bool turned = exponent.is_negative();
    const auto above = positive(turned ? ratio.below : ratio.above),
               below = positive(turned ? ratio.above : ratio.below);
    if (side == 0 || !above || !below) return std::nullopt;
    const Number size = turned ? -exponent : exponent;
    return a * root_of_power(*below, size, problem_.sign) -
           Number(side) * b * root_of_power(*above, size, problem_.sign);
  }

  [[nodiscard]] std::optional<Expression> positive(const Polynomial& e) const {
    const Expression whole = to_expression(graph_, e);
    const int sign = depends_on(whole, problem_.x) ? 0 : problem_.sign(e);
    return sign == 0 ? std::nullopt : std::optional(Number(sign) * whole);
  }

  const PlaceProblem& problem_;
  const Expression& x_;
  Graph& graph_;
  std::vector<Side> sides_;
};

}  // namespace

std::optional<Expression> balance_of_powers(const PlaceProblem& problem, std::size_t k,
                                            const Expression& force) {
  return Balance(problem, k).of(force);
}

std::optional<Expression> without_logarithm(Graph& graph, const Polynomial& e, const Expression& x) {
  const NodeId root = to_expression(graph, e).id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call == nullptr || call->function != Function::log) continue;
    const Expression logarithm(graph, id), argument(graph, call->argument);
    if (!depends_on(argument, x)) continue;
    const auto parts = linear_in(graph, e, logarithm, x);
    if (!parts) return std::nullopt;
    const Expression value = to_expression(graph, -in_lowest_terms(parts->rest, parts->slope));
    return argument - graph.call(Function::exp, value);
  }
  return std::nullopt;
}

}  // namespace qdot
