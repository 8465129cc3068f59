#include "core/closed/exact_extrema.hpp"

#include <algorithm>

#include "core/closed/exact_roots.hpp"
#include "core/closed/inverted_roots.hpp"
#include "core/closed/trial.hpp"
#include "core/closed/turning_signs.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/special_angles.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {

namespace {

/// The numerator of e without the factor x - x0: a cubic equation of which one end is known is quadratic.
std::optional<Expression> without_root(const Expression& e, const Expression& x, const Expression& x0) {
  const auto rest = exact_quotient(rational_function(e).above, rational_function(x - x0).above);
  return rest ? std::optional(to_expression(x.graph(), *rest)) : std::nullopt;
}

}  // namespace

void ExactExtrema::consider(const Expression& left, const Relations& relations) {
  for (const Function function : {Function::cos, Function::sin}) {
    const Expression unknown = is_angle_ ? equation_.graph->call(function, equation_.x) : equation_.x;
    for (const Expression& root : roots_in(unknown, left)) {
      for (const End end : {End::maximum, End::minimum}) consider(end, function, root, left, relations);
    }
    if (!is_angle_) break;
  }
  if (is_angle_) return;
  const std::optional<Expression> start = equation_.start();
  if (const auto rest = start ? without_root(left, equation_.x, *start) : std::nullopt) {
    for (const Expression& root : roots_in(equation_.x, *rest)) {
      for (const End end : {End::maximum, End::minimum}) consider(end, Function::cos, root, left, relations);
    }
  }
  for (const Expression& root : inverted_roots(left, equation_.x, equation_.values)) {
    for (const End end : {End::maximum, End::minimum}) consider(end, Function::cos, root, left, relations);
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

std::vector<Expression> ExactExtrema::roots_in(const Expression& unknown, const Expression& left) const {
  const Polynomial above = with_single_angles(*equation_.graph, rational_function(left).above);
  const Expression u = equation_.graph->symbol("cosine or sine");
  Expression e = to_expression(*equation_.graph, above);
  if (unknown == sin(equation_.x)) {
    const Polynomial sines = without_cosine_squares(*equation_.graph, above, equation_.x);
    e = to_expression(*equation_.graph, sines);
  }
  const Replacement replacement{unknown, u};
  e = substitute(e, {&replacement, 1});
  if (is_angle_ && depends_on(e, equation_.x)) return {};
  if (!is_angle_) return qdot::roots_in(e, u, equation_.values);
  const auto c = quadratic_in(e, u);
  return c ? roots_of((*c)[0], (*c)[1], (*c)[2], equation_.values.sign_of()) : std::vector<Expression>{};
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
      auto form = equation_.formula(x, relations, started());
      auto of_function = equation_.formula(root, relations, started());
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
