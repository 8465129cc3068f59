#include "core/closed/elementary_period.hpp"

#include <algorithm>
#include <functional>

#include "core/base/error.hpp"
#include "core/closed/root_integral.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

/// What a function is by the unknown u, where its argument is a multiple of y.
using Rewrite = std::function<std::optional<Expression>(Function, const Number& multiple)>;

/// How often the way of w is gone: there and back, or twice where w is even in x.
constexpr int possible_passes[]{2, 4};

class PeriodSearch {
 public:
  PeriodSearch(const QuadratureProblem& problem, const ExactValues& values)
      : values_(values),
        graph_(*values.graph()),
        x_(problem.x),
        u_(graph_.symbol("w of x")),
        y_(graph_.symbol("argument of x")),
        speed2_(Number(2) * (problem.energy - problem.potential) / problem.inertia) {}

  std::vector<Expression> periods() {
    tried([&] { by_powers(); });
    for (const Expression& argument : arguments({Function::sin, Function::cos, Function::tan}))
      tried([&] { by_angle(argument); });
    for (const Expression& argument :
         arguments({Function::exp, Function::sinh, Function::cosh, Function::tanh}))
      tried([&] { by_exponential(argument); });
    return std::move(found_);
  }

 private:
  static void tried(const std::function<void()>& substitution) {
    try {
      substitution();
    } catch (const Error&) {  // the algebra grows too large: others may do
    }
  }

  /// w = x, or x^2; and |x| on one side.
  void by_powers() {
    const Replacement u{x_, u_};
    const Expression e = substitute(speed2_, {&u, 1});
    consider(e);
    consider_square(e);
    const auto one_side = [&](Function function, const Number&) -> std::optional<Expression> {
      if (function == Function::abs) return u_;
      return function == Function::sign ? std::optional(graph_.number(1)) : std::nullopt;
    };
    const Replacement y{x_, y_};
    if (const auto side = rewritten(substitute(speed2_, {&y, 1}), one_side)) consider_from_zero(*side);
  }

  /// y = argument/1 or argument/2: w = sin(y), cos(y).
  void by_angle(const Expression& argument) {
    for (const Number& part : {Number(1), Number::ratio(1, 2)}) {
      const auto [e, slope] = in_argument(argument, part);
      if (!e) continue;
      const Expression sine = sin(y_), cosine = cos(y_);
      const RationalFunction f = rational_function(with_tangents_written(*e));
      const Polynomial above = with_single_angles(graph_, f.above),
                       below = with_single_angles(graph_, f.below);
      const Expression one = graph_.number(1);
      const auto consider_as = [&](const Expression& w, const Polynomial& a, const Polynomial& b) {
        const Replacement u{w, u_};
        const Expression quotient =
            substitute(to_expression(graph_, a), {&u, 1}) / substitute(to_expression(graph_, b), {&u, 1});
        if (depends_on(quotient, y_)) return;
        const Expression all = quotient * slope * slope * (one - u_ * u_);
        consider(all);
        consider_square(all);
      };
      consider_as(cosine, above, below);
      consider_as(sine, without_cosine_squares(graph_, above, y_), without_cosine_squares(graph_, below, y_));
    }
  }

  /// y = argument: w = exp(y), and its square.
  void by_exponential(const Expression& argument) {
    const auto [e, slope] = in_argument(argument, Number(1));
    if (!e) return;
    const auto by_powers_of_u = [&](Function function, const Number& k) -> std::optional<Expression> {
      const Expression up = pow(u_, k), down = pow(u_, -k);
      const Expression twice_sinh = up - down, twice_cosh = up + down;
      if (function == Function::exp) return up;
      if (function == Function::sinh) return Number::ratio(1, 2) * twice_sinh;
      if (function == Function::cosh) return Number::ratio(1, 2) * twice_cosh;
      return function == Function::tanh ? std::optional(twice_sinh / twice_cosh) : std::nullopt;
    };
    const auto by_u = rewritten(*e, by_powers_of_u);
    if (!by_u) return;
    const Expression all = *by_u * slope * slope * u_ * u_;
    consider(all);
    consider_square(all);
  }

  struct InArgument {
    std::optional<Expression> e;  ///< x'^2 by y
    Expression slope;             ///< dy/dx
  };

  /// y = part * argument, which is linear in x.
  [[nodiscard]] InArgument in_argument(const Expression& argument, const Number& part) {
    const Expression slope = differentiate(argument, x_);
    if (slope.is_zero() || depends_on(slope, x_)) return {};
    const Replacement zero{x_, graph_.number(0)};
    const Expression offset = substitute(argument, {&zero, 1});
    const Replacement y{x_, (y_ / graph_.number(part) - offset) / slope};
    return {substitute(speed2_, {&y, 1}), graph_.number(part) * slope};
  }

  [[nodiscard]] Expression with_tangents_written(const Expression& e) {
    std::vector<Replacement> tangents;
    for (const Call& call : calls(e)) {
      if (call.function != Function::tan) continue;
      const Expression argument(graph_, call.argument);
      tangents.emplace_back(graph_.call(Function::tan, argument), sin(argument) / cos(argument));
    }
    return substitute(e, tangents);
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
    const Expression result = substitute(e, written);
    return depends_on(result, y_) ? std::nullopt : std::optional(result);
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

  /// (du/dt)^2 by u.
  void consider(const Expression& e) {
    const RationalFunction f = rational_function(e);
    const auto above = univariate(graph_, f.above, u_), below = univariate(graph_, f.below, u_);
    for (const int passes : possible_passes) {
      if (above && below) add(root_integral(graph_, *above, *below, values_.sign_of(), passes));
    }
  }

  void consider_from_zero(const Expression& e) {
    const RationalFunction f = rational_function(e);
    const auto above = univariate(graph_, f.above, u_), below = univariate(graph_, f.below, u_);
    for (const int passes : possible_passes) {
      if (above && below) add(root_integral_from_zero(graph_, *above, *below, values_.sign_of(), passes));
    }
  }

  /// The same for v = u^2, where (dv/dt)^2 = 4 v (du/dt)^2.
  void consider_square(const Expression& e) {
    const RationalFunction f = rational_function(e);
    const auto halved = [&](const Polynomial& a) -> std::optional<Expression> {
      Polynomial result;
      for (const auto& [monomial, coefficient] : a) {
        const int power = exponent_of(monomial, u_.id());
        if (power % 2 != 0) return std::nullopt;
        qdot::add(result, qdot::times(monomial, u_.id(), -power / 2), coefficient);
      }
      return to_expression(graph_, result);
    };
    const auto above = halved(f.above), below = halved(f.below);
    if (above && below) consider(Number(4) * u_ * *above / *below);
  }

  void add(const std::optional<Expression>& integral) {
    if (integral) found_.push_back(*integral);
  }

  const ExactValues& values_;
  Graph& graph_;
  Expression x_, u_, y_;
  Expression speed2_;  ///< x'^2 by x
  std::vector<Expression> found_;
};

}  // namespace

std::vector<Expression> elementary_periods(const QuadratureProblem& problem, const ExactValues& values) {
  return PeriodSearch(problem, values).periods();
}

}  // namespace qdot
