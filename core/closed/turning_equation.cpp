#include "core/closed/turning_equation.hpp"

#include <algorithm>

#include "core/expr/print/print.hpp"
#include "core/expr/special_angles.hpp"
#include "core/mechanics/notation.hpp"

namespace qdot {

TurningEquation::TurningEquation(const Dynamics& dynamics, const Reals& parameters,
                                 const WrittenTexts& written, const TurningPoints& turning_points,
                                 const std::string& energy_name)
    : statics(dynamics.statics(parameters)),
      graph(std::make_shared<Graph>(*statics->reduction.graph)),
      values(dynamics.model(), graph, written, parameters),
      found(turning_points),
      x(graph->adopt(statics->reduction.x[0])) {
  take_constants(energy_name);
}

void TurningEquation::take_constants(const std::string& energy_name) {
  const Reduction& reduction = statics->reduction;
  const Expression rate = graph->adopt(reduction.x_dot[0]);
  const Replacement rest{rate, graph->number(0)};
  std::vector<Replacement> vanishing;
  for (std::size_t c = 0; c < reduction.ignored.size(); ++c) {
    const std::size_t place = reduction.constants.size() - reduction.ignored.size() + c;
    const Expression p = graph->adopt(reduction.constants[place]);
    const bool vanishes = found.momenta[c] == 0 && found.momenta_errors[c] == 0;
    if (vanishes) vanishing.emplace_back(p, graph->number(0));
    constants.push_back(p);
    values.set(p, {found.momenta[c], 0, found.momenta_errors[c]});
  }
  const Expression routhian = substitute(graph->adopt(reduction.routhian), vanishing);
  potential = -substitute(routhian, {&rest, 1});
  inertia = substitute(differentiate(differentiate(routhian, rate), rate), {&rest, 1});
  energy_symbol = graph->symbol(energy_name);
  by_constants = std::ranges::find(values.symbols(), energy_symbol) == values.symbols().end();
  if (by_constants) values.set(energy_symbol, {*found.energy.value, 0, found.energy.error});
  constants.push_back(energy_symbol);
}

bool TurningEquation::take_start() {
  if (take_initial_state()) return true;
  leave_start();
  return false;
}

bool TurningEquation::take_initial_state() {
  const auto& symbols = values.model().parsed.symbols.coordinates;
  for (std::size_t i = 0; i < symbols.value.size(); ++i) {
    const auto q = values.coordinate(i), rate = values.velocity(i);
    if (!q || !rate) return false;
    if (!is_without_units(i, *q, *rate)) return false;
    take_assumption(i, *q, *rate);
    start_.emplace_back(graph->adopt(symbols.value[i]), *q);
    start_.emplace_back(graph->adopt(symbols.rate[i]), *rate);
  }
  return true;
}

bool TurningEquation::is_without_units(std::size_t i, const Expression& q, const Expression& rate) const {
  const Scene& scene = values.model().scene;
  const auto has_unit = [](const Expression& e) { return e.number() != nullptr && !e.is_zero(); };
  return scene.without_units || !(has_unit(rate) || (scene.coordinates[i].unit != "rad" && has_unit(q)));
}

bool TurningEquation::take_place_of_start() {
  const std::size_t i = found.coordinate;
  const auto q = values.coordinate(i), rate = values.velocity(i);
  if (!q || !rate || !rate->is_zero() || !is_without_units(i, *q, *rate)) return false;
  take_assumption(i, *q, *rate);
  start_.emplace_back(x, *q);
  energy = at_start(potential);
  return true;
}

void TurningEquation::leave_start() {
  start_.clear();
  assumed.clear();
  energy.reset();
}

std::vector<Expression> TurningEquation::free_constants() const {
  if (assumed.empty()) return constants;
  return momenta.empty() ? std::vector<Expression>(constants.begin(), constants.end() - 1)
                         : std::vector<Expression>{};
}

void TurningEquation::take_assumption(std::size_t i, const Expression& q, const Expression& rate) {
  const std::string& name = values.model().scene.coordinates[i].name;
  const Notation notation = notation_of(values.model().scene);
  const bool matters = i == found.coordinate;
  if (matters) assumed.push_back(name + "(0) = " + print(q, Form::text, notation));
  assumed.push_back(name + "_dot(0) = " + print(rate, Form::text, notation));
}

std::optional<ClosedForm> TurningEquation::formula(const Expression& e, const Relations& relations,
                                                   const std::vector<std::string>& started,
                                                   std::span<const Expression> allowed,
                                                   std::size_t longest) const {
  std::vector<Expression> symbols = constants;
  symbols.insert(symbols.end(), allowed.begin(), allowed.end());
  auto form = closed_form(values, e, relations, symbols, longest);
  if (!form) return form;
  assume_signs(*form, values, e, constants);
  form->assumes.insert(form->assumes.end(), started.begin(), started.end());
  return form;
}

Expression TurningEquation::at_start(const Expression& e) const {
  return with_special_angles(substitute(e, start_));
}

std::optional<Expression> TurningEquation::start() const {
  if (start_.empty()) return std::nullopt;
  return at_start(x);
}

Expression TurningEquation::with_start() {
  const Reduction& reduction = statics->reduction;
  const Expression rate = graph->adopt(reduction.x_dot[0]);
  for (std::size_t c = 0; c < reduction.ignored.size(); ++c) {
    const Expression p = graph->adopt(values.model().momenta[reduction.ignored[c]]);
    momenta.emplace_back(constants[c], at_start(without_zeros(p)));
  }
  const Expression at_momenta = substitute(potential, momenta);
  const Expression kinetic = Number::ratio(1, 2) * substitute(inertia, momenta) * rate * rate;
  energy = at_start(at_momenta) + at_start(kinetic);
  return at_momenta - *energy;
}

Expression TurningEquation::without_zeros(const Expression& e) const {
  std::vector<Replacement> zeros;
  for (std::size_t i = 0; i < values.symbols().size(); ++i) {
    if (values.is_zero(i)) zeros.emplace_back(values.symbols()[i], graph->number(0));
  }
  return substitute(e, zeros);
}

}  // namespace qdot
