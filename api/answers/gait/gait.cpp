#include <algorithm>
#include <cmath>
#include <complex>

#include "api/answers/exact_json.hpp"
#include "api/answers/gait/request.hpp"
#include "api/answers/lost_inertia.hpp"
#include "api/answers/stated.hpp"
#include "core/closed/exact_gait.hpp"

namespace qdot::api {
namespace {

constexpr const char* undecided =
    "The largest multiplier has the magnitude 1 within its error, so that linearization does not decide.";

constexpr const char* at_a_fold =
    "A multiplier is 1 within its error: other gaits may lie beside this one, and there may be none at all.";

constexpr const char* not_all =
    "Gaits are found from starts that are tried, and followed from each other; no proof excludes more of them.";

bool may_be_at_a_fold(const Gait& gait) {
  for (std::size_t i = 0; i < gait.multipliers.size(); ++i) {
    if (std::abs(gait.multipliers[i] - 1.0) <= gait.multiplier_errors[i]) return true;
  }
  return false;
}

class GaitAnswer {
 public:
  GaitAnswer(const Scene& scene, int digits) : scene_(scene), digits_(digits) {}

  [[nodiscard]] Json gait_json(const Gait& gait) const {
    Json json{{"kind", name(gait.kind)},
              {"state", values(gait.state)},
              {"pre_impact", values(gait.pre_impact)},
              {"step_time", gait.step_time.value}};
    if (gait.step_length) json["step_length"] = gait.step_length->value;
    Json& multipliers = json["multipliers"] = Json::array();
    for (const auto& multiplier : gait.multipliers)
      multipliers.push_back({{"re", multiplier.real()}, {"im", multiplier.imag()}});
    json["stable"] = gait.stability == GaitStability::stable;
    if (gait.stability == GaitStability::undecided) {
      json["stable"] = nullptr;
      json["reason"] = may_be_at_a_fold(gait) ? at_a_fold : undecided;
    }
    json["residual"] = gait.residual;
    json["error"] = errors(gait);
    return json;
  }

  [[nodiscard]] Json units() const {
    Json units = state_units(scene_);
    units.update(Json{{"step_time", "s"}, {"step_length", "m"}, {"multipliers", "1"}});
    return units;
  }

 private:
  [[nodiscard]] Json written_error(const Uncertain& number) const {
    return stated_error({number.value, number.error}, digits_);
  }
  [[nodiscard]] Json values(const std::vector<Uncertain>& state) const {
    std::vector<double> y;
    for (const Uncertain& number : state) y.push_back(number.value);
    return state_json(scene_, y);
  }

  [[nodiscard]] Json errors_of(const std::vector<Uncertain>& state) const {
    Json errors = values(state);
    std::size_t i = 0;
    for (auto& [name, error] : errors.items()) error = written_error(state[i++]);
    return errors;
  }

  [[nodiscard]] Json errors(const Gait& gait) const {
    Json error{{"state", errors_of(gait.state)},
               {"pre_impact", errors_of(gait.pre_impact)},
               {"step_time", written_error(gait.step_time)}};
    if (gait.step_length) error["step_length"] = written_error(*gait.step_length);
    Json& multipliers = error["multipliers"] = Json::array();
    for (std::size_t i = 0; i < gait.multipliers.size(); ++i) {
      multipliers.push_back(stated_error(gait.multipliers[i], gait.multiplier_errors[i], digits_));
    }
    return error;
  }

  const Scene& scene_;
  int digits_;
};

GaitNumbers numbers_of(const Gait& gait) {
  GaitNumbers numbers{{}, {}, gait.multipliers, gait.multiplier_errors};
  for (const auto& [value, error] : gait.state) {
    numbers.state.push_back(value);
    numbers.errors.push_back(error);
  }
  return numbers;
}

/// {"of": "theta_dot^2", "text": ...}, its multiplier beside it.
void put_exact(Json& json, const ResolvedSystem& system, const WrittenTexts& written, const Gait& gait) {
  const auto exact = exact_gait(*system.dynamics, system.state.parameters, written, numbers_of(gait));
  if (!exact) return;
  Json form{{"of", system.scene().coordinates[exact->coordinate].name + "_dot^2"}};
  form.update(exact_json(exact->square));
  if (exact->multiplier) form["multiplier"] = exact_json(*exact->multiplier);
  json["exact"] = std::move(form);
}

std::string no_such(Gait::Kind kind, const Gaits& found) {
  if (found.gaits.empty()) return found.reason;
  return std::string(
             "Only one gait was found, which is neither the long nor the short one of two; leave out ") +
         "'gait' to see it (" + name(kind) + " was asked for).";
}

Response answer_gait(const Resolved<GaitRequest>& resolved, Call& call, Models& models) {
  const GaitRequest& request = resolved.request;
  ResolvedSystem system = resolved_system(request.system, resolved.echo, models);
  note_lost_inertia(system, call);
  system.echo.erase("initial");  // a gait starts where it must
  Gaits found = periodic_gaits(*system.dynamics, system.state.parameters);
  std::string reason = found.reason;
  if (request.gait) {
    const auto others = [&](const Gait& gait) { return gait.kind != *request.gait; };
    if (std::ranges::all_of(found.gaits, others)) reason = no_such(*request.gait, found);
    std::erase_if(found.gaits, others);
  }
  call.timing.lap("solve");
  const GaitAnswer answer(system.scene(), request.digits.value_or(shortest_digits));
  Json gaits = Json::array();
  for (const Gait& gait : found.gaits) {
    gaits.push_back(answer.gait_json(gait));
    if (wants(call, "exact")) put_exact(gaits.back(), system, written_texts(request.system), gait);
  }
  Json body{{"gaits", std::move(gaits)}, {"complete", false}};
  body["reason"] = found.gaits.empty() ? reason : not_all;
  body["units"] = answer.units();
  return written_answer(call, system.scene(), system.echo, body, request.digits);
}

}  // namespace

Endpoint gait_endpoint() {
  return {.name = "gait",
          .help = "Motions that repeat from impact to impact: gaits",
          .question = question(gait_table(), answer_gait),
          .cost = {.milliseconds = 20},
          .other_names = {"gaits", "walk"}};
}

}  // namespace qdot::api
