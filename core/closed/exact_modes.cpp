#include "core/closed/exact_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/closed/algebra_budget.hpp"
#include "core/closed/allowed_motions.hpp"
#include "core/closed/assumed_signs.hpp"
#include "core/closed/decided_coordinates.hpp"
#include "core/closed/mode_options.hpp"
#include "core/closed/phases.hpp"
#include "core/closed/place_search.hpp"
#include "core/closed/rolling_forms.hpp"
#include "core/closed/steady_modes.hpp"
#include "core/expr/simplify.hpp"
#include "core/steady/surface_statics.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_coordinates = 12;
/// Of more, only what falls apart at once has formulas.
constexpr std::size_t most_with_all_work = 6;

/// Where the number of a coordinate or multiplier has no bound: of a place among others, a body that may be
/// anywhere.
double rounding_at(double x) { return 1e-12 * std::max(1.0, std::abs(x)); }

std::vector<Interval> enclosed_state(const Modes& found) {
  std::vector<Interval> near;
  for (std::size_t i = 0; i < found.y.size() / 2; ++i) {
    const double of_family = found.held.empty() ? 0 : rounding_at(found.y[i]);
    const double error = std::max(found.y_error[i].value_or(rounding_at(found.y[i])), of_family);
    near.emplace_back(found.y[i] - error, found.y[i] + error);
  }
  return near;
}

/// Formulas for all parameters that have the same signs and satisfy the same relations.
struct Prepared {
  std::shared_ptr<Graph> graph;
  std::vector<Expression> x, momenta, place;
  std::vector<ModeForms> options;
  std::vector<std::optional<ClosedForm>> state;
  ExactValues::Signs signs;           ///< of what the forms assume
  std::vector<Replacement> phases{};  ///< of which the signs speak as well
};

/// Where the system rests, or moves steadily with these momenta.
struct SteadyPlace {
  std::vector<Interval> x;
  std::vector<Real> momenta;  ///< those that are not 0
};

SteadyPlace steady_place(const Modes& found, std::span<const std::size_t> kept) {
  SteadyPlace place{those_of(enclosed_state(found), kept), {}};
  std::ranges::copy_if(found.momenta, std::back_inserter(place.momenta),
                       [](const Real& p) { return p != Real(0); });
  return place;
}

void set_momenta(ExactValues& values, const std::vector<Expression>& symbols, const SteadyPlace& place) {
  for (std::size_t c = 0; c < symbols.size(); ++c) values.set(symbols[c], place.momenta[c]);
}

/// The one coordinate's mode by its place, where that is shorter than by the momentum.
void consider_by_place(const LinearMotions& motions, const ExactValues& values, Prepared& result) {
  auto by_place = mode_by_place(motions, values);
  if (!by_place) return;
  const auto length = [](const ModeForms& option) { return option.form.square.text.size(); };
  if (!result.options.empty() && length(result.options[0]) <= length(*by_place)) return;
  result.options = {*std::move(by_place)};
}

enum class Wanted { place, modes };

/// Derives the options from a place that has formulas; `x`: the coordinates there.
void derive(const LinearMotions& all, const ExactPlace& place, const std::vector<Expression>& x,
            const ExactValues& values, Wanted wanted, Prepared& result) {
  const std::vector<std::string> conditions = assumed_at(all, place, values);
  if (wanted == Wanted::modes) {
    const std::optional<LinearMotions> motions =
        values.model().has_constraints() ? allowed_motions(all, place, values) : all;
    if (!motions) return;
    result.options = mode_options(*motions, place, values);
  }
  result.place = x;
  for (std::size_t k = 0; k < all.moving.size(); ++k) {
    auto& state = result.state[all.moving[k]];
    state = closed_form(values, x[k], {}, all.momenta);
    if (!state) continue;
    assume_signs(*state, values, x[k], all.momenta);
    state->assumes.insert(state->assumes.end(), conditions.begin(), conditions.end());
  }
}

/// Where the place has formulas by phases.
void derive_by_phases(const LinearMotions& all, std::span<const Interval> near, ExactValues& values,
                      Wanted wanted, Prepared& result) {
  const auto by = by_phases(all, values, near);
  if (!by) return;
  const PlaceProblem problem = place_problem(by->motions, values, by->near);
  const auto place = exact_place(problem);
  if (!place) return;
  std::vector<Replacement> there;
  for (std::size_t k = 0; k < all.x.size(); ++k) there.emplace_back(by->motions.x[k], place->x()[k]);
  std::vector<Expression> x;
  for (const Expression& e : by->x) x.push_back(simplify(substitute(e, there)));
  result.phases = by->phases;
  derive(by->motions, *place, x, values, wanted, result);
}

Prepared prepared(const Model& model, const LinearMotions& all, const SteadyPlace& near,
                  const Reals& parameters, const WrittenTexts& written, Wanted wanted) {
  Prepared result{all.graph, all.x, all.momenta, {}, {}, {}, {}};
  result.state.resize(model.scene.coordinates.size());
  ExactValues values(model, all.graph, written, parameters);
  set_momenta(values, all.momenta, near);
  PlaceProblem problem = place_problem(all, values, near.x);
  std::vector<bool> decided;
  problem.is_decided = [&](std::size_t k) {
    if (decided.empty()) decided = decided_coordinates(all, values);
    return decided[k];
  };
  if (const auto place = exact_place(problem))
    derive(all, *place, place->x(), values, wanted, result);
  else
    derive_by_phases(all, near.x, values, wanted, result);
  if (wanted == Wanted::modes) consider_by_place(all, values, result);
  result.signs = values.asked();
  return result;
}

/// Where no mode was found, or asked for, there is only a formula for the place.
Wanted wanted_of(const Modes& found) { return found.modes.empty() ? Wanted::place : Wanted::modes; }

/// Nothing where the algebra grows too large, or divides by what vanishes.
template <class Make>
Prepared within_budget(std::size_t coordinates, const Make& make) {
  try {
    const WorkScope budget(coordinates > most_with_all_work ? most_algebra / 8 : most_algebra);
    return make();
  } catch (const Error&) {
    return {};
  }
}

/// Names what formulas depend on: the signs of the parameters, which of them are given, and in which eighth
/// of a turn the place is.
std::string key_of(const Reals& parameters, const WrittenTexts& written, const Modes& found) {
  std::string key = wanted_of(found) == Wanted::modes ? "modes" : "place";
  for (const Real& p : found.momenta) key += p == Real(0) ? '0' : p.value < 0 ? '-' : '+';
  for (const double p : parameters) key += p > 0 ? '+' : p < 0 ? '-' : '0';
  for (const auto& [name, text] : written) key += " " + name;
  for (std::size_t i = 0; i < found.y.size() / 2; ++i) {
    const double eighths = std::clamp(found.y[i] / (std::numbers::pi / 4), -5.0, 5.0);
    key += (std::abs(found.y[i]) <= found.y_error[i].value_or(0) ? " zero" : " ") +
           std::to_string(static_cast<int>(std::lround(2 * eighths)));
  }
  return key;
}

bool is_empty(const Prepared& forms) { return forms.place.empty() && forms.options.empty(); }

ExactValues values_near(const Prepared& forms, const SteadyPlace& near, ExactValues values) {
  for (std::size_t k = 0; k < forms.x.size(); ++k)
    values.set(forms.x[k], Real(near.x[k].middle(), 0, near.x[k].width()));
  set_momenta(values, forms.momenta, near);
  for (const auto& [phase, by_place] : forms.phases) values.set(phase, values.value(by_place));
  return values;
}

/// Whether the forms have the signs of these numbers and give the place that was found.
bool fits(const Prepared& forms, const SteadyPlace& near, const ExactValues& values) {
  const ExactValues here = values_near(forms, near, values);
  if (!here.gives(forms.signs)) return false;
  for (std::size_t k = 0; k < forms.place.size(); ++k) {
    const double number = near.x[k].middle();
    if (!(std::abs(here.value(forms.place[k]).value - number) <= 1e-9 * std::max(1.0, std::abs(number))))
      return false;
  }
  return true;
}

ExactModes no_forms(const Modes& found) {
  ExactModes none;
  none.modes.resize(found.modes.size());
  none.state.resize(found.y.size() / 2);
  return none;
}

ExactModes chosen(const Prepared& forms, const SteadyPlace& near, const ExactValues& values,
                  const Modes& found) {
  ExactModes result = no_forms(found);
  if (is_empty(forms) || !fits(forms, near, values)) return result;
  const ExactValues here = values_near(forms, near, values);
  result.state = forms.state;
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    const ModeForms* option = option_of_mode(forms.options, found.modes[i], here);
    if (option == nullptr) continue;
    result.modes[i] = option->form;
    if (has_shape(*option, found.modes[i], here)) continue;
    result.modes[i]->shape.clear();
    result.modes[i]->scaled_shape.clear();
  }
  return result;
}

bool rests(const Modes& found) {
  const auto rates = found.y.begin() + static_cast<std::ptrdiff_t>(found.y.size() / 2);
  return std::all_of(rates, found.y.end(), [](double rate) { return rate == 0; });
}

/// With the multipliers that hold the system there; one that is nearly 0 may be 0, which is then proven.
std::vector<Interval> enclosed_place(const Dynamics& dynamics, const Reals& parameters, const Modes& found) {
  std::vector<Interval> near = enclosed_state(found);
  const std::vector<double> all = with_multipliers(dynamics, parameters, found.y);
  for (std::size_t j = near.size(); j < all.size(); ++j) {
    near.emplace_back(all[j] - rounding_at(all[j]), all[j] + rounding_at(all[j]));
  }
  return near;
}

/// Of a scene with constraints.
ExactModes forms_within_constraints(const Dynamics& dynamics, const Reals& parameters,
                                    const WrittenTexts& written, const Modes& found) {
  if (found.modes.size() > most_coordinates) return no_forms(found);
  const SteadyPlace near{enclosed_place(dynamics, parameters, found), {}};
  const Prepared forms = within_budget(found.modes.size(), [&] {
    const auto motions = motions_with_multipliers(dynamics.model(), parameters);
    return motions ? prepared(dynamics.model(), *motions, near, parameters, written, wanted_of(found))
                   : Prepared{};
  });
  return chosen(forms, near, ExactValues(dynamics.model(), parameters), found);
}

/// Of a steady motion with constraints in the velocities.
ExactModes forms_of_rolling(const Dynamics& dynamics, const Reals& parameters, const WrittenTexts& written,
                            const Modes& found) {
  ExactModes result = no_forms(found);
  try {
    const WorkScope budget(most_algebra);
    result.modes = rolling_forms(dynamics.model(), parameters, written, found);
  } catch (const Error&) {  // the algebra grows too large, or divides by what vanishes
  }
  return result;
}

}  // namespace

ExactModes exact_modes(const Dynamics& dynamics, const Reals& parameters, const WrittenTexts& all_written,
                       const Modes& found) {
  WrittenTexts written;  // where the search for a place began does not matter
  for (const Parameter& p : dynamics.model().scene.parameters) {
    if (const auto text = all_written.find(p.name); text != all_written.end()) written.insert(*text);
  }
  if (dynamics.model().has_constraints())
    return rests(found) ? forms_within_constraints(dynamics, parameters, written, found)
                        : forms_of_rolling(dynamics, parameters, all_written, found);
  const auto statics = dynamics.statics(parameters);
  const std::vector<std::size_t>& kept = statics->reduction.kept;
  if (kept.size() > most_coordinates) return no_forms(found);
  const SteadyPlace near = steady_place(found, kept);
  const ExactValues values(dynamics.model(), parameters);
  const auto make = [&](const Statics& from) {
    return within_budget(kept.size(), [&] {
      std::vector<bool> vanishes;
      for (const Real& p : found.momenta) vanishes.push_back(p == Real(0));
      const LinearMotions motions = linear_motions(from.reduction, dynamics.model().scene, vanishes);
      return prepared(dynamics.model(), motions, near, parameters, written, wanted_of(found));
    });
  };
  if (!values.may_have_relations(written)) {
    const auto forms = dynamics.derived<Prepared>(key_of(parameters, written, found), parameters, make);
    if (is_empty(*forms) || fits(*forms, near, values)) return chosen(*forms, near, values, found);
  }
  return chosen(make(*statics), near, values, found);
}

}  // namespace qdot
