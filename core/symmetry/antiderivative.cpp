#include "core/symmetry/antiderivative.hpp"

#include <utility>
#include <vector>

#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"

namespace qdot {
namespace {

constexpr int highest_power = 6;  ///< of t, and of a sine

/// sin(phase) or cos(phase) with a factor.
struct Wave {
  Function function;
  Expression phase;
  Number factor;
};

/// A term by what depends on t: t^power exp(growth) times sines and cosines, or one other function.
struct Term {
  Expression constant, growth;
  int power{};
  std::vector<std::pair<Function, Expression>> waves;
  std::optional<std::pair<Expression, Number>> other;  ///< base and exponent
};

class Integrals {
 public:
  explicit Integrals(const Expression& t) : graph_(t.graph()), t_(t) {}

  [[nodiscard]] std::optional<Expression> of(const Expression& g) const {
    Expression sum = graph_.number(0);
    for (const auto& [monomial, coefficient] : multiplied_out(g)) {
      const auto term = parted(monomial);
      const auto part = !term ? std::nullopt : term->other ? of_other(*term) : of_waves(*term);
      if (!part) return std::nullopt;
      sum = sum + coefficient * term->constant * *part;
    }
    return sum;
  }

 private:
  /// The coefficient of t; no value where e is not linear in it.
  [[nodiscard]] std::optional<Expression> slope(const Expression& e) const {
    const Expression a = expand(differentiate(e, t_));
    return depends_on(a, t_) ? std::nullopt : std::optional(a);
  }

  [[nodiscard]] std::optional<Term> parted(const Monomial& monomial) const {
    Term term{graph_.number(1), graph_.number(0), 0, {}, {}};
    for (const Atom& atom : monomial) {
      const Expression base(graph_, atom.base);
      const Number exponent = Number::ratio(atom.p, atom.q);
      if (!depends_on(base, t_)) {
        term.constant = term.constant * pow(base, exponent);
        continue;
      }
      if (atom.q == 1 && take(base, atom.p, term)) continue;
      if (term.other) return std::nullopt;
      term.other = {base, exponent};
    }
    return term;
  }

  /// Whether it is one of those of the first kind.
  [[nodiscard]] bool take(const Expression& base, int p, Term& term) const {
    if (base == t_ && p > 0 && p <= highest_power) {
      term.power = p;
      return true;
    }
    const auto* call = std::get_if<Call>(&base.node());
    if (call == nullptr || !slope(Expression(graph_, call->argument))) return false;
    const Expression argument(graph_, call->argument);
    if (call->function == Function::exp) {
      term.growth = term.growth + Number(p) * argument;
      return true;
    }
    const bool is_wave = call->function == Function::sin || call->function == Function::cos;
    if (!is_wave || p < 0 || p > highest_power) return false;
    term.waves.insert(term.waves.end(), static_cast<std::size_t>(p), {call->function, argument});
    return true;
  }

  /// Products of sines and cosines as sums of them.
  [[nodiscard]] std::vector<Wave> single(const Term& term) const {
    std::vector<Wave> sum;
    for (const auto& [function, b] : term.waves) {
      std::vector<Wave> next;
      if (sum.empty()) next.push_back({function, b, Number(1)});
      for (const auto& [first, a, factor] : sum) {
        const bool is_sine = (first == Function::sin) != (function == Function::sin);
        const bool both_sines = first == Function::sin && function == Function::sin;
        const Number half = Number::ratio(1, 2) * factor;
        const Function kind = is_sine ? Function::sin : Function::cos;
        next.push_back({kind, expand(a + b), both_sines ? -half : half});
        next.push_back({kind, expand(a - b), is_sine && first == Function::cos ? -half : half});
      }
      sum = std::move(next);
    }
    if (sum.empty()) sum.push_back({Function::cos, graph_.number(0), Number(1)});
    return sum;
  }

  [[nodiscard]] std::optional<Expression> of_waves(const Term& term) const {
    const Expression a = *slope(term.growth), growing = graph_.call(Function::exp, term.growth);
    Expression sum = graph_.number(0);
    for (const auto& [function, phase, factor] : single(term)) {
      const Expression w = *slope(phase);
      if (a.is_zero() && w.is_zero()) {
        const Number next(term.power + 1);
        sum = sum + factor / next * graph_.call(function, phase) * growing * pow(t_, next);
        continue;
      }
      const Expression s = growing * graph_.call(Function::sin, phase),
                       c = growing * graph_.call(Function::cos, phase);
      const Expression one = graph_.number(1), zero = graph_.number(0);
      const bool is_sine = function == Function::sin;
      sum = sum + factor * by_parts(term.power, {is_sine ? one : zero, is_sine ? zero : one}, {s, c}, {a, w});
    }
    return sum;
  }

  using Pair = std::pair<Expression, Expression>;

  /// Of x S + y C by S and C.
  [[nodiscard]] static Pair waves_integral(const Pair& factors, const Pair& rates) {
    const auto& [x, y] = factors;
    const auto& [a, w] = rates;
    if (a.is_zero()) return {y / w, -x / w};
    if (w.is_zero()) return {x / a, y / a};
    const Expression square = a * a + w * w;
    return {(a * x + w * y) / square, (a * y - w * x) / square};
  }

  /// Of t^n (x S + y C).
  [[nodiscard]] Expression by_parts(int n, const Pair& factors, const Pair& waves, const Pair& rates) const {
    const Pair integral = waves_integral(factors, rates);
    const Expression whole =
        pow(t_, Number(n)) * (integral.first * waves.first + integral.second * waves.second);
    return n == 0 ? whole : whole - Number(n) * by_parts(n - 1, integral, waves, rates);
  }

  /// t f = t F - int F, or f.
  [[nodiscard]] std::optional<Expression> of_other(const Term& term) const {
    const auto& [base, exponent] = *term.other;
    if (!term.growth.is_zero() || !term.waves.empty() || term.power > 1) return std::nullopt;
    const auto a = slope(base);
    const auto* call = std::get_if<Call>(&base.node());
    if (call != nullptr && exponent.is_one()) return of_call(*call, term.power);
    if (!a) return exponent == Number(-1) ? of_hump(base, term.power) : std::nullopt;
    const Expression first = of_power(base, exponent) / *a;
    if (term.power == 0) return first;
    // a t u^n = u^(n+1) - b u^n
    const Expression b = expand(base - *a * t_);
    return of_power(base, exponent + Number(1)) / (*a * *a) - b / *a * first;
  }

  /// Over u, of u < 0 as well.
  [[nodiscard]] Expression of_power(const Expression& u, const Number& n) const {
    const Number next = n + Number(1);
    if (!next.is_zero()) return pow(u, next) / graph_.number(next);
    return Number::ratio(1, 2) * graph_.call(Function::log, pow(u, Number(2)));
  }

  /// t^power/(a + b t^2).
  [[nodiscard]] std::optional<Expression> of_hump(const Expression& square, int power) const {
    const Expression b = expand(Number::ratio(1, 2) * differentiate(differentiate(square, t_), t_)),
                     a = expand(square - b * pow(t_, Number(2)));
    if (b.is_zero() || depends_on(a, t_) || depends_on(b, t_)) return std::nullopt;
    if (power == 1) return graph_.call(Function::log, square) / (Number(2) * b);
    const auto rate = exact_root(multiplied_out(b / a));
    if (!rate) return std::nullopt;
    const Expression w = to_expression(graph_, *rate);
    return graph_.call(Function::atan, w * t_) / (a * w);
  }

  [[nodiscard]] std::optional<Expression> of_call(const Call& call, int power) const {
    const Expression u(graph_, call.argument);
    const auto a = slope(u);
    const auto integrals = a ? over_argument(call.function, u) : std::nullopt;
    if (!integrals || (power == 1 && !integrals->second)) return std::nullopt;
    const Expression first = integrals->first / *a;
    return power == 0 ? first : t_ * first - *integrals->second / (*a * *a);
  }

  /// Of f(u) over u, once and twice.
  [[nodiscard]] std::optional<std::pair<Expression, std::optional<Expression>>> over_argument(
      Function function, const Expression& u) const {
    const auto f = [&](Function name) { return graph_.call(name, u); };
    const Number half = Number::ratio(1, 2);
    const Expression square = pow(u, Number(2)), one = graph_.number(1);
    switch (function) {
      case Function::sinh:
        return {{f(Function::cosh), f(Function::sinh)}};
      case Function::cosh:
        return {{f(Function::sinh), f(Function::cosh)}};
      case Function::log:
        return {{u * f(Function::log) - u, half * square * f(Function::log) - Number::ratio(3, 4) * square}};
      case Function::abs:
        return {{half * u * f(Function::abs), Number::ratio(1, 6) * square * f(Function::abs)}};
      case Function::sign:
        return {{f(Function::abs), half * u * f(Function::abs)}};
      case Function::tanh:
        return {{graph_.call(Function::log, f(Function::cosh)), std::nullopt}};
      case Function::atan:
        return {{u * f(Function::atan) - half * graph_.call(Function::log, one + square), std::nullopt}};
      default:
        return std::nullopt;
    }
  }

  Graph& graph_;
  Expression t_;
};

}  // namespace

std::optional<Expression> antiderivative(const Expression& g, const Expression& t) {
  return Integrals(t).of(g);
}

}  // namespace qdot
