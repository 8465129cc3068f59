#include "api/answers/simulate/motion_diagnostics.hpp"

#include "api/answers/answers.hpp"

namespace qdot::api {
namespace {

Json conserved_json(const Simulation& motion) {
  Json array = Json::array();
  for (const ConservedRecord& record : motion.conserved) {
    Json entry{{"name", record.name},
               {"unit", record.unit},
               {"initial", record.initial},
               {"max_abs_drift", record.max_abs_drift}};
    if (record.max_rel_drift) {
      entry["max_rel_drift"] = *record.max_rel_drift;
    } else {
      entry["max_rel_drift"] = nullptr;
      entry["reason"] = "The initial value is 0.";
    }
    array.push_back(std::move(entry));
  }
  return array;
}

Json constraints_json(const Simulation& motion) {
  Json array = Json::array();
  for (const ConstraintRecord& record : motion.constraints) {
    Json entry{{"name", record.name}};
    if (record.max_abs_value) entry["max_abs_value"] = *record.max_abs_value;
    entry["max_abs_rate"] = record.max_abs_rate;
    array.push_back(std::move(entry));
  }
  return array;
}

}  // namespace

Json diagnostics_json(const Simulation& motion, std::uint64_t total_evaluations) {
  Json json{{"conserved", conserved_json(motion)}};
  if (!motion.constraints.empty()) json["constraints"] = constraints_json(motion);
  json["steps"] = motion.steps;
  json["rhs_evaluations"] = motion.evaluations;
  json["total_evaluations"] = total_evaluations;
  return json;
}

Json sticking_json(const Simulation& motion) {
  Json array = Json::array();
  for (const StayRecord& stay : motion.stays) {
    array.push_back({{"where", stay.kink + " = 0"}, {"from", stay.from}, {"to", stay.to}});
  }
  return array;
}

Json impacts_json(const Scene& scene, const Simulation& motion) {
  Json array = Json::array();
  for (const SectionRecord& section : motion.sections) {
    array.push_back({{"t", section.t},
                     {"step_time", section.duration},
                     {"pre_impact", state_json(scene, section.before)},
                     {"state", state_json(scene, section.after)}});
  }
  return array;
}

}  // namespace qdot::api
