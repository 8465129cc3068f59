#include "core/closed/barriers.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/closed/exact_roots.hpp"
#include "core/compile/tape_builder.hpp"
#include "core/expr/rational_function.hpp"

namespace qdot {
namespace {

void add_factors(const Polynomial& a, const Expression& x, std::vector<Expression>& factors) {
  Graph& graph = x.graph();
  const auto take = [&](const Expression& factor) {
    if (depends_on(factor, x)) factors.push_back(factor);
  };
  const Monomial common = common_monomial(a);
  for (const Atom& atom : common) take(Expression(graph, atom.base));
  take(to_expression(graph, scaled(a, inverse(common), Number(1))));
}

/// Zeros of the function about 0.
std::vector<Expression> zeros_of(Function function, Graph& graph) {
  const Expression pi = graph.symbol("pi");
  switch (function) {
    case Function::cos:
      return {Number::ratio(1, 2) * pi, Number::ratio(-1, 2) * pi};
    case Function::sin:
    case Function::tan:
      return {graph.number(0), pi, -pi};
    case Function::log:
      return {graph.number(1)};
    default:
      return {};
  }
}

/// Where the sum is linear in x, or in x^2 alone.
std::vector<Expression> zeros_of_sum(const Expression& sum, const Expression& x) {
  const auto c = quadratic_in(sum, x);
  if (!c) return {};
  const Expression &c0 = (*c)[0], &c1 = (*c)[1], &c2 = (*c)[2];
  if (c2.is_zero()) return {-c0 / c1};
  if (!c1.is_zero()) return {};
  const Expression root = sqrt(-c0 / c2);
  return {root, -root};
}

std::vector<Expression> zeros_of(const Expression& factor, const Expression& x) {
  if (factor == x) return {x.graph().number(0)};
  const auto* call = std::get_if<Call>(&factor.node());
  if (call == nullptr) return zeros_of_sum(factor, x);
  const Expression argument(x.graph(), call->argument), slope = differentiate(argument, x);
  if (slope.is_zero() || depends_on(slope, x)) return {};
  const Replacement at_zero{x, x.graph().number(0)};
  const Expression offset = substitute(argument, {&at_zero, 1});
  std::vector<Expression> zeros;
  for (const Expression& y : zeros_of(call->function, x.graph())) zeros.push_back((y - offset) / slope);
  return zeros;
}

}  // namespace

std::vector<Expression> factors_of_inertia(const Expression& inertia, const Expression& x) {
  std::vector<Expression> factors;
  if (!depends_on(inertia, x)) return factors;
  const RationalFunction f = rational_function(inertia);
  add_factors(f.above, x, factors);
  add_factors(f.below, x, factors);
  return factors;
}

std::vector<Expression> places_of_barriers(const std::vector<Expression>& factors, const Expression& x) {
  std::vector<Expression> places;
  for (const Expression& factor : factors) {
    try {
      const std::vector<Expression> zeros = zeros_of(factor, x);
      places.insert(places.end(), zeros.begin(), zeros.end());
    } catch (const Error&) {  // the algebra grows too large: this one stays unknown
    }
  }
  return places;
}

namespace {

/// What decides whether one of the factors vanishes on a way.
struct BarrierSigns {
  std::vector<Expression> once;   ///< vanish at most once: the signs at the ends of the way tell
  std::vector<Expression> turns;  ///< linear in x: where one is a whole number the factor vanishes
  std::vector<Expression> others;
};

BarrierSigns signs_of(const std::vector<Expression>& factors, const Expression& x) {
  BarrierSigns signs;
  const Expression half_turn = x.graph().number(1) / x.graph().symbol("pi");
  for (const Expression& factor : factors) {
    const auto* call = std::get_if<Call>(&factor.node());
    const Expression inner = call == nullptr ? factor : Expression(x.graph(), call->argument);
    const bool is_linear = !depends_on(differentiate(inner, x), x);
    if (is_linear && call == nullptr) {
      signs.once.push_back(factor);
    } else if (is_linear && call->function == Function::cos) {
      signs.turns.push_back(half_turn * inner + x.graph().number(Number::ratio(1, 2)));
    } else if (is_linear && (call->function == Function::sin || call->function == Function::tan)) {
      signs.turns.push_back(half_turn * inner);
    } else {
      signs.others.push_back(factor);
    }
  }
  return signs;
}

/// A function of one place with its numbers put in, and room for its values.
class ValuesAt {
 public:
  ValuesAt(const CompiledFunction& function, std::span<const double> numbers)
      : function_(&function), workspace_(function.bind(numbers)), values_(function.outputs()) {}

  [[nodiscard]] const std::vector<double>& at(double x) {
    (void)function_->evaluate(0, {&x, 1}, workspace_, values_);
    return values_;
  }

 private:
  const CompiledFunction* function_;
  Workspace workspace_;
  std::vector<double> values_;
};

bool have_same_signs(const std::vector<double>& a, const std::vector<double>& b, std::size_t count) {
  return std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(count), b.begin(),
                    [](double x, double y) { return (x > 0) == (y > 0); });
}

/// Whether no whole number lies between those after the first.
bool have_same_floors(const std::vector<double>& a, const std::vector<double>& b, std::size_t first) {
  for (std::size_t i = first; i < a.size(); ++i) {
    if (std::floor(a[i]) != std::floor(b[i])) return false;
  }
  return true;
}

/// Null where there is none.
std::optional<CompiledFunction> compiled(const std::vector<Expression>& outputs, const Expression& x,
                                         const std::vector<Expression>& symbols) {
  if (outputs.empty()) return std::nullopt;
  TapeBuilder tape(x.graph(), symbols, x.graph().symbol("t"), {&x, 1});
  for (const Expression& e : outputs) tape.output(e);
  return tape.finish();
}

}  // namespace

Barriers::Barriers(const Expression& inertia, const Expression& x, const std::vector<Expression>& symbols) {
  BarrierSigns signs = signs_of(factors_of_inertia(inertia, x), x);
  once_ = signs.once.size();
  signs.once.insert(signs.once.end(), signs.turns.begin(), signs.turns.end());
  at_ends_ = compiled(signs.once, x, symbols);
  on_the_way_ = compiled(signs.others, x, symbols);
}

Barriers::Meets Barriers::at(std::span<const double> numbers) const {
  if (!at_ends_ && !on_the_way_) return {};
  std::optional<ValuesAt> ends, way;
  if (at_ends_) ends.emplace(*at_ends_, numbers);
  if (on_the_way_) way.emplace(*on_the_way_, numbers);
  return [ends, way, once = once_](double from, double to, int pieces) mutable {
    const double step = (to - from) / pieces, first = from + step / 2;
    if (ends) {
      const std::vector<double> before = ends->at(first), &after = ends->at(to - step / 2);
      if (!have_same_signs(before, after, once) || !have_same_floors(before, after, once)) return true;
    }
    if (!way) return false;
    const std::vector<double> before = way->at(first);
    for (int i = 1; i < pieces; ++i) {
      if (!have_same_signs(before, way->at(first + i * step), before.size())) return true;
    }
    return false;
  };
}

}  // namespace qdot
