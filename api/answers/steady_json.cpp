#include "api/answers/steady_json.hpp"

#include <algorithm>

#include "api/answers/answers.hpp"
#include "api/answers/stated.hpp"
#include "core/base/short_number.hpp"

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

std::vector<std::string> notes_on_rates(const Dynamics& dynamics, const SystemChoice& choice,
                                        const ResolvedState& state) {
  const Model& model = dynamics.model();
  const auto& rates = model.parsed.symbols.coordinates.rate;
  const auto statics = dynamics.statics(state.parameters);
  const auto momenta = momentum_columns(model, statics->reduction.ignored);
  std::vector<std::string> notes;
  for (const std::size_t i : statics->reduction.kept) {
    const std::string& name = model.scene.coordinates[i].name;
    const double rate = state.y[rates.size() + i];
    const bool was_given =
        std::ranges::any_of(choice.initial, [&](const auto& given) { return given.first == name + "_dot"; });
    const bool counts =
        std::ranges::any_of(momenta, [&](const qdot::Column& p) { return depends_on(p.value, rates[i]); });
    if (!was_given || counts || rate == 0) continue;
    notes.push_back("The start has " + name + "_dot = " + short_number(rate) +
                    ", but these are places of rest or steady motions, in which " + name +
                    " rests: its rate is left out.");
  }
  return notes;
}

}  // namespace qdot::api
