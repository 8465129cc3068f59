#include "api/answers/steady_json.hpp"

#include <cmath>

#include "api/answers/answers.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {

Json written_error(double value, double error, int digits) {
  const double whole = error + std::abs(rounded(value, digits) - value);
  return std::isfinite(whole) ? Json(whole) : Json(nullptr);
}

void put_stability(Json& json, const SteadyStability& stability, int digits) {
  json["stability"] = name(stability.stability);
  if (!stability.undecided.empty()) json["nonlinear"] = stability.undecided;
  if (stability.rate2 && stability.rate2->is_finite()) {
    json["rate2"] = stability.rate2->middle();
    json["rate2_error"] = written_error(stability.rate2->middle(), stability.rate2->radius(), digits);
  }
  json["eigenvalues"] = Json::array();
  for (const auto& s : stability.eigenvalues) {
    json["eigenvalues"].push_back({{"re", s.real()}, {"im", s.imag()}});
  }
}

Json steady_units(const Scene& scene) {
  Json units = state_units(scene);
  units["rate2"] = units["rate2_error"] = "1/s^2";
  units["re"] = units["im"] = "1/s";
  return units;
}

}  // namespace qdot::api
