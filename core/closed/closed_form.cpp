#include "core/closed/closed_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/closed/joined_roots.hpp"
#include "core/closed/linear_factors.hpp"
#include "core/closed/sine_squares.hpp"
#include "core/closed/split_roots.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/rational_function.hpp"
#include "core/mechanics/notation.hpp"

namespace qdot {
namespace {

bool speaks_only_of(const Expression& e, std::span<const Expression> symbols,
                    std::span<const Expression> allowed) {
  const NodeId root = e.id();
  const auto is = [](NodeId id) { return [id](const Expression& symbol) { return symbol.id() == id; }; };
  for (const NodeId id : reachable(e.graph(), {&root, 1})) {
    const auto* symbol = std::get_if<Symbol>(&e.graph().node(id));
    if (symbol == nullptr || symbol->name == "pi") continue;
    if (std::ranges::none_of(symbols, is(id)) && std::ranges::none_of(allowed, is(id))) return false;
  }
  return true;
}

/// Whether a root of an even order, abs or sign takes something of the symbol: sqrt(d^2), abs(d).
bool is_under_a_size(const Expression& e, const Expression& symbol) {
  Graph& graph = e.graph();
  const NodeId root = e.id();
  const auto takes = [&](NodeId id) {
    if (const auto* call = std::get_if<Call>(&graph.node(id)))
      return (call->function == Function::abs || call->function == Function::sign) &&
             depends_on(Expression(graph, call->argument), symbol);
    const auto* power = std::get_if<Power>(&graph.node(id));
    return power != nullptr && (power->exponent.denominator() / Number(2)).is_integer() &&
           depends_on(Expression(graph, power->base), symbol);
  };
  return std::ranges::any_of(reachable(graph, {&root, 1}), takes);
}

/// Whether the formula, which does not speak of it, was made with the parameter's sign: sqrt(d^2) = d.
bool has_used_sign_of(const ExactValues& values, std::size_t parameter) {
  const double value = values.parameters()[parameter];
  if (!values.model().scene.parameters[parameter].domain.contains(-value)) return false;
  const Lagrangian& own = values.model().lagrangian;
  const auto takes = [&](const Expression& e) {
    return is_under_a_size(e, own.symbols.parameters[parameter]);
  };
  if (!takes(own.lagrangian) && std::ranges::none_of(own.generalized_forces, takes)) return false;
  const Expression& p = values.symbols()[parameter];
  return std::ranges::any_of(values.asked(), [&](const auto& asked) {
    const auto& [e, sign] = asked;
    if (sign == 0 || !depends_on(e, p)) return false;
    const Replacement turned{p, -p};
    return values.value(substitute(e, {&turned, 1})).value * sign < 0;
  });
}

std::vector<std::string> assumptions(const ExactValues& values, const Expression& e,
                                     const Relations& relations) {
  const Notation notation = notation_of(values.model().scene);
  std::vector<std::string> found;
  for (std::size_t i = 0; i < values.symbols().size(); ++i) {
    const Expression& p = values.symbols()[i];
    const std::string& name = values.model().scene.parameters[i].name;
    const ExponentValues& put_in = values.model().parsed.exponents.put_in;
    if (const auto exponent = put_in.find(name); exponent != put_in.end()) {
      found.push_back(name + " = " + print(e.graph().number(exponent->second), Form::text));
    } else if (values.is_zero(i)) {
      found.push_back(name + " = 0");
    } else if (depends_on(e, p) || has_used_sign_of(values, i)) {
      found.push_back(name + (values.parameters()[i] > 0 ? " > 0" : " < 0"));
    }
  }
  for (const auto& [symbol, value] : relations.replacements)
    found.push_back(print(symbol, Form::text) + " = " + print(value, Form::text, notation));
  return found;
}

}  // namespace

void assume_signs(ClosedForm& form, const ExactValues& values, const Expression& e,
                  std::span<const Expression> symbols) {
  for (const Expression& symbol : symbols) {
    if (depends_on(e, symbol))
      form.assumes.push_back(print(symbol, Form::text) + (values.sign(symbol) < 0 ? " < 0" : " > 0"));
  }
}

bool agrees(const Real& formula, double number, double error) {
  const double rounding = std::numeric_limits<double>::epsilon() * std::abs(number);
  return formula.is_finite() &&
         std::abs((formula.value - number) + formula.low) <= error + formula.error + rounding;
}

namespace {

/// With the numbers that stand for exponents in all other places, too.
Expression with_exponents_put_in(const ExactValues& values, const Expression& e) {
  std::vector<Replacement> numbers;
  const ExponentValues& put_in = values.model().parsed.exponents.put_in;
  for (std::size_t i = 0; i < values.symbols().size() && !put_in.empty(); ++i) {
    const auto exponent = put_in.find(values.model().scene.parameters[i].name);
    if (exponent != put_in.end())
      numbers.emplace_back(values.symbols()[i], e.graph().number(exponent->second));
  }
  return numbers.empty() ? e : substitute(e, numbers);
}

/// exp(1)^3 as exp(3).
Expression with_short_exponentials(const Expression& e) {
  Graph& graph = e.graph();
  std::vector<Replacement> taken;
  const NodeId root = e.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    const auto* call = power == nullptr ? nullptr : std::get_if<Call>(&graph.node(power->base));
    if (call == nullptr || call->function != Function::exp) continue;
    const Expression argument = power->exponent * Expression(graph, call->argument);
    taken.emplace_back(Expression(graph, id), graph.call(Function::exp, expand(argument)));
  }
  return taken.empty() ? e : substitute(e, taken);
}

/// Sums of fractions under roots as one fraction.
Expression with_fractions_under_roots(const Expression& e) {
  Graph& graph = e.graph();
  std::vector<Replacement> taken;
  const NodeId root = e.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    if (power == nullptr || power->exponent.is_integer()) continue;
    const Expression base(graph, power->base);
    if (!std::holds_alternative<Sum>(base.node())) continue;
    const RationalFunction f = rational_function(base);
    if (f.below.size() == 1 && f.below.begin()->first.empty()) continue;
    const Expression quotient = to_expression(graph, f.above) / to_expression(graph, f.below);
    taken.emplace_back(Expression(graph, id), pow(quotient, power->exponent));
  }
  return taken.empty() ? e : substitute(e, taken);
}

/// With more than some fifteen digits, which no book prints.
bool has_long_numbers(const Expression& e) {
  constexpr std::size_t most_bits = 50;
  const NodeId root = e.id();
  const auto is_long = [&](NodeId id) {
    const Node& node = e.graph().node(id);
    if (const auto* product = std::get_if<Product>(&node)) return product->coefficient.bits() > most_bits;
    const auto* literal = std::get_if<Literal>(&node);
    return literal != nullptr && literal->value.bits() > most_bits;
  };
  return std::ranges::any_of(reachable(e.graph(), {&root, 1}), is_long);
}

}  // namespace

/// What stands under roots is taken to keep its sign, unless it contains a coordinate: a formula in
/// coordinates holds for any value of theirs.
Expression short_form(const ExactValues& values, const Expression& formula) {
  const std::vector<Expression>& coordinates = values.model().parsed.symbols.coordinates.value;
  const SignOf sign = [&](const Polynomial& a) {
    return depends_on(to_expression(formula.graph(), a), coordinates) ? 0 : values.sign(a);
  };
  constexpr std::size_t few_operations = 3, several = 12;  // of what cannot be made much shorter
  const auto shortened = [&](const Expression& e) {
    const std::size_t length = written_length(e);
    if (length < few_operations) return e;
    if (length < several) return with_joined_roots(e, sign);
    return with_linear_factors(with_joined_roots(with_split_roots(e, sign), sign));
  };
  const Expression put_in = with_short_exponentials(with_exponents_put_in(values, formula));
  Expression best = shortened(put_in);
  for (const Expression& other : {with_fractions_under_roots(put_in), with_sine_squares(put_in, sign)}) {
    if (other == put_in) continue;
    const Expression found = shortened(other);
    if (written_length(found) < written_length(best)) best = found;
  }
  return written_length(put_in) < written_length(best) ? put_in : best;
}

std::optional<ClosedForm> closed_form(const ExactValues& values, const Expression& formula,
                                      const Relations& relations, std::span<const Expression> allowed,
                                      std::size_t longest) {
  const Expression e = short_form(values, formula);
  const bool is_short = written_length(e) <= longest && !has_long_numbers(e);
  if (!is_short || !speaks_only_of(e, values.symbols(), allowed)) return std::nullopt;
  const Notation notation = notation_of(values.model().scene);
  return ClosedForm{print(e, Form::text, notation), print(e, Form::latex, notation),
                    assumptions(values, e, relations)};
}

}  // namespace qdot
