#include "core/closed/inverted_roots.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "core/closed/exact_roots.hpp"
#include "core/closed/one_unknown.hpp"
#include "core/closed/place_algebra.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/rational_function.hpp"
#include "core/expr/trigonometry.hpp"
#include "core/steady/exponential_form.hpp"

namespace qdot {
namespace {

class Inversion {
 public:
  Inversion(const Expression& e, const Expression& x, const ExactValues& values)
      : e_(e), x_(x), graph_(e.graph()), values_(values) {}

  std::vector<Expression> roots() {
    by_exponentials(Exponential::rising);
    by_exponentials(Exponential::falling);
    by_power();
    std::ranges::copy(roots_of_power(e_, x_), std::back_inserter(found_));
    by_circular_functions();
    by_inner_functions();
    by_lengths();
    by_one_side();
    return std::move(found_);
  }

 private:
  /// Of u with c0 + c1 u + c2 u^2 = 0; none where another function of x is left.
  [[nodiscard]] std::vector<Expression> roots_of_polynomial(const Expression& e, const Expression& u) const {
    if (depends_on(e, x_)) return {};
    if (const auto c = quadratic_in(e, u)) return roots_of((*c)[0], (*c)[1], (*c)[2], values_.sign_of());
    return roots_of_power(e, u);
  }

  /// Of c0 + c1 u^n + c2 u^2n = 0.
  [[nodiscard]] std::vector<Expression> roots_of_power(const Expression& e, const Expression& u) const {
    std::vector<Expression> roots;
    const auto parts = quadratic_in_power(graph_, rational_function(e).above, u);
    if (!parts || std::ranges::any_of(parts->c, [&](const Expression& c) { return depends_on(c, x_); }))
      return roots;
    for (const Expression& value : roots_of(parts->c[0], parts->c[1], parts->c[2], values_.sign_of())) {
      if (values_.sign(value) <= 0) continue;
      const Expression root = root_of_power(value, parts->n, values_.sign_of());
      roots.push_back(root);
      if ((parts->n / Number(2)).is_integer()) roots.push_back(-root);
    }
    return roots;
  }

  /// x where a linear function of it has a value.
  void add(const Expression& linear, const Expression& value) {
    const Expression slope = differentiate(linear, x_);
    const Replacement origin{x_, graph_.number(0)};
    found_.push_back((value - substitute(linear, {&origin, 1})) / slope);
  }

  [[nodiscard]] bool is_linear(const Expression& argument) const {
    const Expression slope = differentiate(argument, x_);
    return !slope.is_zero() && !depends_on(slope, x_);
  }

  void by_exponentials(Exponential which) {
    const auto found = by_exponential(e_, {&x_, 1}, which);
    if (!found) return;
    const ByExponential by_w = in_powers_apart(*found);
    if (!is_linear(by_w.argument)) return;
    for (const Expression& w : roots_of_polynomial(to_expression(graph_, by_w.e), by_w.w)) {
      if (values_.sign(w) <= 0) continue;
      const Expression inverse = graph_.number(1) / w;
      const bool turned = written_length(inverse) < written_length(w);
      add(by_w.argument, turned ? -graph_.call(Function::log, inverse) : graph_.call(Function::log, w));
    }
  }

  void by_power() {
    const Polynomial above = without_factor(rational_function(e_).above, x_);
    const int n = highest_power(above, x_);
    const auto parts = n > 2 ? linear_in(graph_, above, x_, x_, n) : std::nullopt;
    if (!parts) return;
    const RationalFunction value = -in_lowest_terms(parts->rest, parts->slope);
    const auto size = [&](const RationalFunction& f) {
      return root_of_product(graph_, f, n, values_.sign_of());
    };
    if (const auto root = size(value)) found_.insert(found_.end(), {*root, -*root});
    if (const auto root = n % 2 == 0 ? std::nullopt : size(-value)) found_.push_back(-*root);
  }

  /// |x|: what x is on either side.
  void by_one_side() {
    const Expression size = graph_.call(Function::abs, x_);
    if (!depends_on(e_, size)) return;
    for (const int side : {1, -1}) {
      const Replacement there{size, Number(side) * x_};
      add_roots_of(substitute(e_, {&there, 1}));
    }
  }

  void add_roots_of(const Expression& e) {
    std::ranges::copy(inverted_roots(e, x_, values_), std::back_inserter(found_));
    std::ranges::copy(qdot::roots_in(e, x_, values_), std::back_inserter(found_));
  }

  /// x in one function of another one, log(cosh(x)) or sqrt(1 + x^2): what that one is.
  void by_inner_functions() {
    const Expression u = graph_.symbol("function of x");
    const NodeId root = e_.id();
    for (const NodeId id : reachable(graph_, {&root, 1})) {
      const Expression outer(graph_, id);
      if (!depends_on(outer, x_)) continue;
      const Replacement named{outer, u};
      const auto inner = inner_function(outer);
      if (!inner) continue;
      for (const Expression& value : roots_of_polynomial(substitute(e_, {&named, 1}), u)) {
        if (const auto inverse = inverse_of(outer, value)) add_roots_of(*inner - *inverse);
      }
    }
  }

  /// x^2 and u = sqrt(a x^2 + c), a spring beside a wire: what u is.
  void by_lengths() {
    const Expression u = graph_.symbol("function of x");
    const NodeId root = e_.id();
    for (const NodeId id : reachable(graph_, {&root, 1})) {
      const auto* power = std::get_if<Power>(&graph_.node(id));
      if (power == nullptr || power->exponent != Number::ratio(1, 2)) continue;
      const Expression length(graph_, id), base(graph_, power->base);
      const auto c = quadratic_in(base, x_);
      if (!c || !(*c)[1].is_zero() || (*c)[2].is_zero()) continue;
      const auto by_u = without_squares(length, u, (u * u - (*c)[0]) / (*c)[2]);
      if (!by_u) continue;
      for (const Expression& value : roots_of_polynomial(*by_u, u)) {
        const Expression square = (value * value - (*c)[0]) / (*c)[2];
        if (values_.sign(value) <= 0 || values_.sign(square) <= 0) continue;
        found_.insert(found_.end(), {sqrt(square), -sqrt(square)});
      }
    }
  }

  /// With u for the length and what x^2 is by it; none where an odd power of x is left.
  [[nodiscard]] std::optional<Expression> without_squares(const Expression& length, const Expression& u,
                                                          const Expression& square) const {
    const Replacement named{length, u};
    Expression sum = graph_.number(0);
    for (const auto& [monomial, coefficient] : rational_function(substitute(e_, {&named, 1})).above) {
      const int n = exponent_of(monomial, x_.id());
      if (n % 2 != 0 || n < 0) return std::nullopt;
      const Expression rest = to_expression(graph_, {{times(monomial, x_.id(), -n), coefficient}});
      sum = sum + rest * pow(square, Number(n / 2));
    }
    return sum;
  }

  [[nodiscard]] std::optional<Expression> inner_function(const Expression& outer) const {
    if (const auto* power = std::get_if<Power>(&outer.node())) {
      const Expression base(graph_, power->base);
      return !power->exponent.is_integer() && !(base == x_) ? std::optional(base) : std::nullopt;
    }
    const auto* call = std::get_if<Call>(&outer.node());
    if (call == nullptr) return std::nullopt;
    const Expression argument(graph_, call->argument);
    const bool is_known_road = call->function != Function::log && call->function != Function::atan &&
                               call->function != Function::asin && is_linear(argument);
    return is_known_road ? std::nullopt : std::optional(argument);
  }

  /// y with outer(y) = value.
  [[nodiscard]] std::optional<Expression> inverse_of(const Expression& outer, const Expression& value) const {
    if (const auto* power = std::get_if<Power>(&outer.node())) {
      if (values_.sign(value) <= 0) return std::nullopt;
      return power->exponent.is_negative() ? pow(value, Number(1) / power->exponent)
                                           : root_of_power(value, power->exponent, values_.sign_of());
    }
    switch (std::get<Call>(outer.node()).function) {
      case Function::log:
        return graph_.call(Function::exp, value);
      case Function::exp:
        return values_.sign(value) > 0 ? std::optional(graph_.call(Function::log, value)) : std::nullopt;
      case Function::atan:
        return graph_.call(Function::tan, value);
      case Function::asin:
        return sin(value);
      default:
        return std::nullopt;
    }
  }

  [[nodiscard]] std::vector<Expression> circular_arguments() const {
    std::vector<Expression> arguments;
    const NodeId root = e_.id();
    for (const NodeId id : reachable(graph_, {&root, 1})) {
      const auto* call = std::get_if<Call>(&graph_.node(id));
      if (call == nullptr) continue;
      const Function f = call->function;
      const Expression argument(graph_, call->argument);
      if ((f == Function::sin || f == Function::cos || f == Function::tan) && is_linear(argument) &&
          std::ranges::find(arguments, argument) == arguments.end())
        arguments.push_back(argument);
    }
    return arguments;
  }

  /// The tangent, the sine or the cosine of a linear function; the others by it.
  void by_circular_functions() {
    const Expression u = graph_.symbol("function of x"), pi = graph_.symbol("pi");
    for (const Expression& y : circular_arguments()) {
      for (const auto& [function, inverse] :
           {std::pair(Function::tan, Function::atan), std::pair(Function::sin, Function::asin),
            std::pair(Function::cos, Function::acos)}) {
        for (const Expression& root : roots_of_polynomial(by_one(function, y, u), u)) {
          const Expression angle = graph_.call(inverse, root);
          add(y, angle);
          if (function == Function::sin) add(y, pi - angle);
          if (function == Function::cos) add(y, -angle);
        }
      }
    }
  }

  [[nodiscard]] Expression by_one(Function function, const Expression& y, const Expression& u) const {
    const Replacement named{graph_.call(function, y), u};
    if (function == Function::tan) return substitute(e_, {&named, 1});
    const Polynomial above = with_single_angles(graph_, rational_function(e_).above);
    const Polynomial one = function == Function::sin ? without_cosine_squares(graph_, above, y) : above;
    return substitute(to_expression(graph_, one), {&named, 1});
  }

  Expression e_, x_;
  Graph& graph_;
  const ExactValues& values_;
  std::vector<Expression> found_;
};

}  // namespace

std::vector<Expression> inverted_roots(const Expression& e, const Expression& x, const ExactValues& values) {
  return Inversion(e, x, values).roots();
}

}  // namespace qdot
