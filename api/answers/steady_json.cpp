#include "api/answers/steady_json.hpp"

#include <algorithm>

#include "api/answers/answers.hpp"
#include "api/answers/stated.hpp"
#include "core/base/short_number.hpp"
#include "core/steady/surface_statics.hpp"

namespace qdot::api {

void put_stability(Json& json, const SteadyStability& stability, int digits) {
  json["stability"] = name(stability.stability);
  if (!stability.undecided.empty()) json["nonlinear"] = stability.undecided;
  if (stability.rate2 && stability.rate2->is_finite()) {
    const Stated rate2 = Stated::within(stability.rate2->middle(), *stability.rate2);
    json["rate2"] = rate2.value;
    json["rate2_error"] = stated_error(rate2, digits);
  }
  json["eigenvalues"] = Json::array();
  for (const auto& [s, error] : stability.eigenvalues) {
    json["eigenvalues"].push_back(
        {{"re", s.real()}, {"im", s.imag()}, {"error", stated_error(s, error, digits)}});
  }
}

Json steady_units(const Scene& scene) {
  Json units = state_units(scene);
  units["rate2"] = units["rate2_error"] = "1/s^2";
  units["re"] = units["im"] = "1/s";
  return units;
}

namespace {

std::vector<std::size_t> ignored_coordinates(const Dynamics& dynamics, const Reals& parameters) {
  if (dynamics.model().has_constraints())
    return surface_statics(dynamics, parameters).statics->reduction.ignored;
  return dynamics.statics(parameters)->reduction.ignored;
}

}  // namespace

std::vector<std::string> notes_on_rates(const Dynamics& dynamics, const SystemChoice& choice,
                                        const ResolvedState& state) {
  const Model& model = dynamics.model();
  const auto& rates = model.parsed.symbols.coordinates.rate;
  std::vector<std::size_t> moving;  // at the start, as the request has it
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const std::string rate = model.scene.coordinates[i].name + "_dot";
    const auto is_it = [&](const auto& given) { return given.first == rate; };
    const bool was_given = choice.is_carried || std::ranges::any_of(choice.initial, is_it);
    if (was_given && state.y[rates.size() + i] != 0) moving.push_back(i);
  }
  if (moving.empty()) return {};
  const std::vector<std::size_t> ignored = ignored_coordinates(dynamics, state.parameters);
  const auto momenta = momentum_columns(model, ignored);
  std::vector<std::string> notes;
  for (const std::size_t i : moving) {
    const auto counts = [&](const qdot::Column& p) { return depends_on(p.value, rates[i]); };
    if (std::ranges::find(ignored, i) != ignored.end() || std::ranges::any_of(momenta, counts)) continue;
    const std::string& name = model.scene.coordinates[i].name;
    notes.push_back("The start has " + name + "_dot = " + short_number(state.y[rates.size() + i]) +
                    ", but these are places of rest or steady motions, in which " + name +
                    " rests: its rate is left out.");
  }
  return notes;
}

}  // namespace qdot::api
