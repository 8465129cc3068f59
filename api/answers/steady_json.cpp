#include "api/answers/steady_json.hpp"

#include "api/answers/answers.hpp"
#include "api/answers/stated.hpp"

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

}  // namespace qdot::api
