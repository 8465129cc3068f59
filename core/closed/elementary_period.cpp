#include "core/closed/elementary_period.hpp"

#include <algorithm>
#include <functional>

#include "core/base/error.hpp"
#include "core/closed/place_algebra.hpp"
#include "core/closed/root_integral.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

/// What a function is by the unknown u, where its argument is a multiple of y.
using Rewrite = std::function<std::optional<Expression>(Function, const Number& multiple)>;

/// How often the way of w is gone: there and back, or twice where w is even in x.
constexpr int there_and_back = 2, both_sides = 4;

/// w by x: x itself, or |y| on one side of 0; or a function of y = part * argument, linear in x.
struct Substitution {
  enum class Kind { itself, one_side, sine, cosine, exponential };
  Kind kind{};
  Expression argument;
  Number part;
};

class PeriodSearch {
 public:
  PeriodSearch(const QuadratureProblem& problem, const ExactValues& values)
      : values_(values),
        graph_(*values.graph()),
        x_(problem.x),
        u_(graph_.symbol("w of x")),
        y_(graph_.symbol("argument of x")),
        speed2_(Number(2) * (problem.energy - problem.potential) / problem.inertia),
        tried_(speed2_),
        inertia_varies_(depends_on(problem.inertia, problem.x)) {}

  std::vector<Expression> periods() {
    take_numbers();
    for (const Substitution& w : substitutions()) {
      try {
        const bool fits_once = try_out(w);
        const bool fits_sides = w.kind == Substitution::Kind::one_side && try_both_sides(w.argument);
        if (fits_once || fits_sides) break;
      } catch (const Error&) {  // the algebra grows too large: another may do
      }
    }
    return std::move(found_);
  }

 private:
  /// In place of the parameters and constants, so that little algebra shows what is no such integral.
  void take_numbers() {
    constexpr int primes[]{3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73};
    const NodeId root = speed2_.id();
    std::size_t next = 0;
    for (const NodeId id : reachable(graph_, {&root, 1})) {
      const Expression e(graph_, id);
      if (!std::holds_alternative<Symbol>(e.node()) || e == x_ || next == std::size(primes)) continue;
      numbers_.emplace_back(e, graph_.number(Number(primes[next++])));
    }
    tried_ = substitute(speed2_, numbers_);
  }

  /// Whether w, or its square, makes it such an integral.
  bool try_out(const Substitution& w) {
    Substitution numbered = w;
    numbered.argument = substitute(w.argument, numbers_);
    const auto e = by_u(tried_, numbered);
    if (!e) return false;
    if (fits(e)) return take(by_u(speed2_, w), w);
    if (!fits(by_square(*e))) return false;
    const auto all = by_u(speed2_, w);
    return all && take(by_square(*all), w);
  }

  /// Where the potential has another form on each side of a place, as of two springs: there and back on both.
  bool try_both_sides(const Expression& argument) {
    Expression sum = graph_.number(0);
    for (const int side : {1, -1}) {
      const auto e = by_side(argument, side);
      if (!e) return false;
      const auto [above, below] = sides(*e);
      if (!above || !below) return false;
      const auto half = root_integral_from_zero(graph_, *above, *below, values_.sign_of(), there_and_back);
      if (!half) return false;
      sum = sum + *half;
    }
    found_.push_back(sum);
    return true;
  }

  /// (du/dt)^2 by u = |y| where y has this sign.
  [[nodiscard]] std::optional<Expression> by_side(const Expression& argument, int side) {
    const Expression slope = differentiate(argument, x_);
    if (slope.is_zero() || depends_on(slope, x_)) return std::nullopt;
    const Replacement zero{x_, graph_.number(0)};
    const Replacement by_y{x_, (y_ - substitute(argument, {&zero, 1})) / slope};
    const std::vector<Replacement> one_side{{graph_.call(Function::abs, y_), u_},
                                            {graph_.call(Function::sign, y_), graph_.number(Number(side))},
                                            {y_, Number(side) * u_}};
    const Expression e = substitute(substitute(speed2_, {&by_y, 1}), one_side);
    return depends_on(e, y_) ? std::nullopt : std::optional(e * slope * slope);
  }

  [[nodiscard]] std::vector<Substitution> substitutions() const {
    using Kind = Substitution::Kind;
    std::vector<Substitution> all;
    all.push_back({Kind::itself, x_, Number(1)});
    for (const Expression& argument : arguments({Function::abs, Function::sign}))
      all.push_back({Kind::one_side, argument, Number(1)});
    for (const Expression& argument : arguments({Function::sin, Function::cos, Function::tan})) {
      for (const Kind kind : {Kind::cosine, Kind::sine}) {
        all.push_back({kind, argument, Number(1)});
        if (inertia_varies_) all.push_back({kind, argument, Number::ratio(1, 2)});
      }
    }
    for (const Expression& argument :
         arguments({Function::exp, Function::sinh, Function::cosh, Function::tanh}))
      all.push_back({Kind::exponential, argument, Number(1)});
    return all;
  }

  /// (dw/dt)^2 by u = w, where x'^2 = e.
  [[nodiscard]] std::optional<Expression> by_u(const Expression& e, const Substitution& w) {
    using Kind = Substitution::Kind;
    const Expression argument = w.argument, slope = differentiate(argument, x_);
    if (slope.is_zero() || depends_on(slope, x_)) return std::nullopt;
    const Replacement zero{x_, graph_.number(0)};
    const Expression offset = substitute(argument, {&zero, 1});
    const Replacement y{x_, (y_ / graph_.number(w.part) - offset) / slope};
    const Expression by_y = substitute(e, {&y, 1});
    const Expression rate = graph_.number(w.part) * slope, one = graph_.number(1);
    std::optional<Expression> all;
    if (w.kind == Kind::itself || w.kind == Kind::one_side) {
      all = by_itself(by_y, w.kind == Kind::one_side);
      if (all) all = *all * rate * rate;
    }
    if (w.kind == Kind::cosine || w.kind == Kind::sine) {
      all = by_angle(by_y, w.kind);
      if (all) all = *all * rate * rate * (one - u_ * u_);
    }
    if (w.kind == Kind::exponential) {
      all = by_exponential(by_y);
      if (all) all = *all * rate * rate * u_ * u_;
    }
    return all;
  }

  [[nodiscard]] std::optional<Expression> by_itself(const Expression& e, bool one_side) {
    if (one_side)
      return rewritten(e, [&](Function function, const Number&) -> std::optional<Expression> {
        if (function == Function::abs) return u_;
        return function == Function::sign ? std::optional(graph_.number(1)) : std::nullopt;
      });
    const Replacement u{y_, u_};
    return substitute(e, {&u, 1});
  }

  [[nodiscard]] std::optional<Expression> by_angle(const Expression& e, Substitution::Kind kind) {
    const bool is_sine = kind == Substitution::Kind::sine;
    const RationalFunction f = rational_function(with_tangents_written(e));
    const Replacement u{is_sine ? sin(y_) : cos(y_), u_};
    const auto part = [&](const Polynomial& a) {
      const Polynomial single = with_single_angles(graph_, a);
      const Polynomial one = is_sine ? without_cosine_squares(graph_, single, y_) : single;
      return substitute(to_expression(graph_, one), {&u, 1});
    };
    const Expression quotient = part(f.above) / part(f.below);
    return depends_on(quotient, y_) ? std::nullopt : std::optional(quotient);
  }

  [[nodiscard]] std::optional<Expression> by_exponential(const Expression& e) {
    return rewritten(e, [&](Function function, const Number& k) -> std::optional<Expression> {
      const Expression up = pow(u_, k), down = pow(u_, -k);
      const Expression twice_sinh = up - down, twice_cosh = up + down;
      if (function == Function::exp) return up;
      if (function == Function::sinh) return Number::ratio(1, 2) * twice_sinh;
      if (function == Function::cosh) return Number::ratio(1, 2) * twice_cosh;
      return function == Function::tanh ? std::optional(twice_sinh / twice_cosh) : std::nullopt;
    });
  }

  /// No value where y stands in something else.
  [[nodiscard]] std::optional<Expression> rewritten(const Expression& e, const Rewrite& by_u) {
    std::vector<Replacement> written;
    for (const Call& call : calls(e)) {
      const Expression argument(graph_, call.argument);
      if (!depends_on(argument, y_)) continue;
      const auto [multiple, rest] = split_coefficient(argument);
      const auto value = rest == y_ ? by_u(call.function, multiple) : std::nullopt;
      if (!value) return std::nullopt;
      written.emplace_back(graph_.call(call.function, argument), *value);
    }
    written.emplace_back(y_, u_);
    return substitute(e, written);
  }

  /// Of v = u^2, where (dv/dt)^2 = 4 v (du/dt)^2.
  [[nodiscard]] std::optional<Expression> by_square(const Expression& e) {
    const RationalFunction f = rational_function(e);
    const auto halved = [&](const Polynomial& a) -> std::optional<Expression> {
      Polynomial result;
      for (const auto& [monomial, coefficient] : a) {
        const int power = exponent_of(monomial, u_.id());
        if (power % 2 != 0) return std::nullopt;
        add(result, times(monomial, u_.id(), -power / 2), coefficient);
      }
      return to_expression(graph_, result);
    };
    const auto above = halved(f.above), below = halved(f.below);
    if (!above || !below) return std::nullopt;
    return Number(4) * u_ * *above / *below;
  }

  [[nodiscard]] std::vector<Call> calls(const Expression& e) const {
    std::vector<Call> found;
    const NodeId root = e.id();
    for (const NodeId id : reachable(graph_, {&root, 1})) {
      if (const auto* call = std::get_if<Call>(&graph_.node(id))) found.push_back(*call);
    }
    return found;
  }

  /// Of these functions, those that depend on x.
  [[nodiscard]] std::vector<Expression> arguments(const std::vector<Function>& functions) const {
    std::vector<Expression> found;
    for (const Call& call : calls(speed2_)) {
      const Expression argument(graph_, call.argument);
      const bool is_new = std::ranges::find(found, argument) == found.end();
      if (std::ranges::find(functions, call.function) != functions.end() && is_new &&
          depends_on(argument, x_))
        found.push_back(argument);
    }
    return found;
  }

  struct Sides {
    std::optional<Univariate> above, below;
  };
  [[nodiscard]] Sides sides(const Expression& e) {
    const RationalFunction f = rational_function(e);
    return {univariate(graph_, f.above, u_), univariate(graph_, f.below, u_)};
  }

  [[nodiscard]] bool fits(const std::optional<Expression>& e) {
    if (!e) return false;
    const auto [above, below] = sides(*e);
    return above && below && is_root_integral(*above, *below);
  }

  /// Whether the potential says the same on both sides, whatever the parameters.
  [[nodiscard]] bool is_even(const Expression& argument) {
    const auto right = by_side(argument, 1), left = by_side(argument, -1);
    return right && left && rational_function(*right - *left).is_zero();
  }

  bool take(const std::optional<Expression>& e, const Substitution& w) {
    if (!e) return false;
    const auto [above, below] = sides(*e);
    if (!above || !below) return false;
    const bool is_one_side = w.kind == Substitution::Kind::one_side;
    const auto integral = is_one_side ? root_integral_from_zero : root_integral;
    for (const int passes : {there_and_back, both_sides}) {
      if (is_one_side && passes == both_sides && !is_even(w.argument)) continue;
      if (const auto period = integral(graph_, *above, *below, values_.sign_of(), passes))
        found_.push_back(*period);
    }
    return !found_.empty();
  }

  const ExactValues& values_;
  Graph& graph_;
  Expression x_, u_, y_;
  Expression speed2_;                 ///< x'^2 by x
  std::vector<Replacement> numbers_;  ///< for the symbols in it
  Expression tried_;                  ///< with these
  bool inertia_varies_;
  std::vector<Expression> found_;
};

}  // namespace

std::vector<Expression> elementary_periods(const QuadratureProblem& problem, const ExactValues& values) {
  return PeriodSearch(problem, values).periods();
}

}  // namespace qdot
