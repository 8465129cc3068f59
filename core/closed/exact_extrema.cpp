#include "core/closed/exact_extrema.hpp"

#include <algorithm>

#include "core/closed/exact_roots.hpp"
#include "core/closed/inverted_roots.hpp"
#include "core/closed/tilted_angles.hpp"
#include "core/closed/trial.hpp"
#include "core/closed/turning_signs.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/special_angles.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {

namespace {

/// As written_length counts: roots of quadratics whose inertia at the start is a sum are that long.
constexpr std::size_t longest_extremum = 110;

/// The numerator of e without the factor x - x0: a cubic equation of which one end is known is quadratic.
std::optional<Expression> without_root(const Expression& e, const Expression& x, const Expression& x0) {
  const auto rest = exact_quotient(rational_function(e).above, rational_function(x - x0).above);
  return rest ? std::optional(to_expression(x.graph(), *rest)) : std::nullopt;
}

/// Without -x0 as well, where that is a root: of x^2 one is known.
std::optional<Expression> without_roots(const Expression& e, const Expression& x, const Expression& x0) {
  const auto rest = without_root(e, x, x0);
  const auto even = rest && !x0.is_zero() ? without_root(*rest, x, -x0) : std::nullopt;
  return even ? even : rest;
}

/// A sum of parameters under one name, where a symbol stands in it by itself and can be put out by it.
struct NamedSum {
  Expression name, sum;
  Replacement by_name;
};

std::optional<NamedSum> named_sum(const Expression& sum) {
  Graph& graph = sum.graph();
  const Expression name = graph.symbol("named sum");
  for (const auto& [term, number] : multiplied_out(sum)) {
    const Expression symbol = to_expression(graph, {{term, Number(1)}});
    const Expression rest = sum - number * symbol;
    if (!std::holds_alternative<Symbol>(symbol.node()) || depends_on(rest, symbol)) continue;
    return NamedSum{name, sum, {symbol, (Number(1) / number) * (name - rest)}};
  }
  return std::nullopt;
}

/// Of the first sum that is raised to a power and does not depend on x: the inertia where the motion begins.
std::optional<NamedSum> named_sum_in(const Expression& e, const Expression& x) {
  const NodeId root = e.id();
  for (const NodeId id : reachable(e.graph(), {&root, 1})) {
    const auto* power = std::get_if<Power>(&e.graph().node(id));
    if (power == nullptr) continue;
    const Expression base(e.graph(), power->base);
    if (std::holds_alternative<Sum>(base.node()) && !depends_on(base, x)) return named_sum(base);
  }
  return std::nullopt;
}

/// e with what stands under roots in short form.
Expression short_under_roots(const Expression& e) {
  std::vector<Replacement> taken;
  const NodeId root = e.id();
  for (const NodeId id : reachable(e.graph(), {&root, 1})) {
    const auto* power = std::get_if<Power>(&e.graph().node(id));
    if (power == nullptr || power->exponent.is_integer()) continue;
    const Number exponent = power->exponent;
    const Expression base(e.graph(), power->base);
    taken.emplace_back(Expression(e.graph(), id), pow(simplify(base), exponent));
  }
  return taken.empty() ? e : substitute(e, taken);
}

/// e without the name; sums that are shorter by themselves are written so.
Expression without_name(const Expression& e, const NamedSum& named) {
  Graph& graph = e.graph();
  const Replacement back{named.name, named.sum};
  std::vector<Replacement> taken;
  const NodeId root = e.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const Expression there(graph, id);
    if (!std::holds_alternative<Sum>(there.node()) || !depends_on(there, named.name)) continue;
    const Expression plain = substitute(there, {&back, 1});
    const Expression simple = simplify(plain);
    if (written_length(simple) < written_length(plain)) taken.emplace_back(there, simple);
  }
  taken.push_back(back);
  return substitute(e, taken);
}

}  // namespace

void ExactExtrema::consider(const Expression& left, const Relations& relations) {
  for (const Function function : {Function::cos, Function::sin}) {
    for (const Expression& root : roots_in(function, left)) {
      for (const End end : {End::maximum, End::minimum}) consider(end, function, root, left, relations);
    }
    if (!is_angle_) break;
  }
  consider_tilted(left, relations);
  if (is_angle_) return;
  const std::optional<Expression> start = equation_.start();
  if (const auto rest = start ? without_roots(left, equation_.x, *start) : std::nullopt) {
    for (const Expression& root : roots_in(Function::cos, *rest)) {
      for (const End end : {End::maximum, End::minimum}) consider(end, Function::cos, root, left, relations);
    }
  }
  for (const Expression& root : inverted_roots(left, equation_.x, equation_.values)) {
    for (const End end : {End::maximum, End::minimum}) consider(end, Function::cos, root, left, relations);
  }
}

void ExactExtrema::consider_tilted(const Expression& left, const Relations& relations) {
  const Expression turn = Number(2) * equation_.graph->symbol("pi");
  for (const Expression& root : tilted_angles(left, equation_.x, equation_.start(), equation_.values)) {
    for (const Expression& place : {root, root + turn, root - turn}) {
      for (const End end : {End::maximum, End::minimum}) {
        if (number_of(end).value) keep(end, number(place, number_of(end), relations), left, relations);
      }
    }
  }
}

void ExactExtrema::consider_start(const Expression& left, const Relations& relations) {
  const std::optional<Expression> start = equation_.start();
  if (!start) return;
  for (const Expression& place : {*start, -*start, equation_.graph->symbol("pi") - *start}) {
    for (const End end : {End::maximum, End::minimum}) {
      if (number_of(end).value) keep(end, number(place, number_of(end), relations), left, relations);
    }
  }
}

void ExactExtrema::consider(End end, Function function, const Expression& root, const Expression& left,
                            const Relations& relations) {
  const Finding& extremum = number_of(end);
  if (!extremum.value) return;
  keep(end, is_angle_ ? angle(function, root, extremum, relations) : number(root, extremum, relations), left,
       relations);
}

void ExactExtrema::keep(End end, Found found, const Expression& left, const Relations& relations) {
  if (!found || !is_root(found->first, left, relations)) return;
  kept_[end].push_back({found->first, std::move(found->second), relations});
}

void ExactExtrema::assume_signs() {
  maximum = shortest(End::maximum);
  minimum = shortest(End::minimum);
}

std::optional<ExactExtremum> ExactExtrema::shortest(End end) {
  std::vector<Kept>& kept = kept_[end];
  std::ranges::stable_sort(kept, {}, [](const Kept& each) { return each.form.value.text.size(); });
  for (Kept& each : kept) {
    if (assume_signs(end, each)) return std::move(each.form);
  }
  return std::nullopt;
}

bool ExactExtrema::assume_signs(End end, Kept& kept) const {
  ExactExtremum& form = kept.form;
  const auto needed =
      signs_of_extremum(equation_, kept.x, end == End::maximum ? 1 : -1, kept.relations, form.value.assumes);
  if (!needed) return false;
  for (ClosedForm* each :
       {&form.value, form.cosine ? &*form.cosine : nullptr, form.sine ? &*form.sine : nullptr}) {
    if (each != nullptr) each->assumes.insert(each->assumes.end(), needed->begin(), needed->end());
  }
  return true;
}

std::vector<Expression> ExactExtrema::roots_in(Function function, const Expression& left) const {
  Graph& graph = *equation_.graph;
  const Polynomial above = with_single_angles(graph, rational_function(left).above);
  const auto polynomial = [&](const Polynomial& p, const Expression& angle) {
    const bool of_sines = is_angle_ && function == Function::sin;
    return to_expression(graph, of_sines ? without_cosine_squares(graph, p, angle) : p);
  };
  const Expression unknown = is_angle_ ? graph.call(function, equation_.x) : equation_.x;
  const Expression u = graph.symbol("cosine or sine");
  const Replacement replacement{unknown, u};
  const Expression e = substitute(polynomial(above, equation_.x), {&replacement, 1});
  if (!is_angle_) return qdot::roots_in(e, u, equation_.values);
  if (depends_on(e, equation_.x)) return {};
  auto c = quadratic_in(e, u);
  const std::optional<Expression> start = c ? std::nullopt : equation_.start();
  if (start) {
    const Expression there = with_special_angles(graph.call(function, *start));
    const Polynomial single = with_single_angles(graph, multiplied_out(there));
    const auto rest = without_root(polynomial(multiplied_out(e), *start), u, polynomial(single, *start));
    if (rest) c = quadratic_in(*rest, u);
  }
  if (!c) return {};
  return start ? roots_beside_start(*c, left)
               : roots_of((*c)[0], (*c)[1], (*c)[2], equation_.values.sign_of());
}

std::vector<Expression> ExactExtrema::roots_beside_start(std::vector<Expression> c,
                                                         const Expression& left) const {
  Graph& graph = *equation_.graph;
  const std::optional<NamedSum> named = named_sum_in(left, equation_.x);
  for (Expression& each : c) {
    if (!named) break;
    const Expression by_name = substitute(each, {&named->by_name, 1});
    each = to_expression(graph, with_single_angles(graph, multiplied_out(by_name)));
  }
  const SignOf sign = [&](const Polynomial& e) {
    const Expression value = to_expression(graph, e);
    return equation_.values.sign(named ? without_name(value, *named) : value);
  };
  std::vector<Expression> roots = roots_of(c[0], c[1], c[2], sign);
  for (Expression& root : roots)
    root =
        named ? without_name(short_under_roots(simplify(root)), *named) : short_form(equation_.values, root);
  return roots;
}

/// By other parameters another root is the nearest, or the motion starts at the other end.
std::vector<std::string> ExactExtrema::started() const {
  std::vector<std::string> all = equation_.assumed;
  const InitialPlace place = equation_.found.initial;
  if (all.empty() || place == InitialPlace::between) return all;
  const std::string& name = equation_.values.model().scene.coordinates[equation_.found.coordinate].name;
  all.push_back(name + "(0) " +
                (place == InitialPlace::maximum   ? "= " + name + "_max"
                 : place == InitialPlace::minimum ? "= " + name + "_min"
                                                  : "is an equilibrium"));
  return all;
}

ExactExtrema::Found ExactExtrema::number(const Expression& root, const Finding& extremum,
                                         const Relations& relations) const {
  if (!agrees(equation_.values.value(root), *extremum.value, extremum.error)) return std::nullopt;
  auto form = equation_.formula(root, relations, started());
  if (!form) return std::nullopt;
  return {{root, {*std::move(form), std::nullopt, std::nullopt}}};
}

ExactExtrema::Found ExactExtrema::angle(Function function, const Expression& root, const Finding& extremum,
                                        const Relations& relations) const {
  const Expression pi = equation_.graph->symbol("pi");
  const Expression inverse =
      equation_.graph->call(function == Function::cos ? Function::acos : Function::asin, root);
  std::vector<Expression> principal{inverse};
  if (const auto* call = std::get_if<Call>(&root.node()); call != nullptr && call->function == function)
    principal.insert(principal.begin(),
                     Expression(*equation_.graph, call->argument));  // where the motion began
  if (root.number() != nullptr || written_length(root) < 8) add_known(function, root, principal);
  for (const Expression& value : principal) {
    const Expression other = function == Function::cos ? -value : pi - value;
    for (const Expression& x : {value, other, other + Number(2) * pi, other - Number(2) * pi}) {
      if (!agrees(equation_.values.value(x), *extremum.value, extremum.error)) continue;
      auto form = equation_.formula(x, relations, started(), {}, longest_extremum);
      auto of_function = equation_.formula(root, relations, started(), {}, longest_extremum);
      if (!form || !of_function) continue;
      ExactExtremum result{*std::move(form), std::nullopt, std::nullopt};
      (function == Function::cos ? result.cosine : result.sine) = std::move(of_function);
      return {{x, std::move(result)}};
    }
  }
  return std::nullopt;
}

void ExactExtrema::add_known(Function function, const Expression& value,
                             std::vector<Expression>& principal) const {
  const Expression pi = equation_.graph->symbol("pi");
  for (const Number& r :
       {Number(0), Number::ratio(1, 6), Number::ratio(1, 4), Number::ratio(1, 3), Number::ratio(1, 2),
        Number::ratio(2, 3), Number::ratio(3, 4), Number::ratio(5, 6), Number(1), Number::ratio(-1, 6),
        Number::ratio(-1, 4), Number::ratio(-1, 3), Number::ratio(-1, 2)}) {
    const Expression angle = r * pi;
    const Expression known = with_special_angles(equation_.graph->call(function, angle));
    if (rational_function(known - value).is_zero()) {
      principal.insert(principal.begin(), angle);
      return;
    }
  }
}

bool ExactExtrema::is_root(const Expression& x, const Expression& left, const Relations& relations) const {
  Trial trial(equation_.values, relations);
  std::vector<Expression> numbers;
  for (const Expression& p : equation_.constants)
    numbers.push_back(equation_.graph->number(Number::real(equation_.values.value(p).value)));
  // Some place in reach, so that there are turning points.
  const Replacement there{equation_.x,
                          equation_.graph->number(Number::real(equation_.values.value(x).value))};
  numbers.back() = substitute(equation_.potential, {&there, 1});
  trial.set(equation_.constants, numbers);
  trial.set({equation_.x}, {x});
  trial.vanishes(terms_of(left));
  return trial.passes();
}

}  // namespace qdot
