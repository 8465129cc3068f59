#include "api/answers/accuracy/request.hpp"

#include "api/answers/motion_fields.hpp"
#include "api/contract/text_checks.hpp"

namespace qdot::api {
namespace {

void check_accuracy(AccuracyRequest& request, Findings& findings) {
  const Scene* scene = request.system.scene.get();
  if (scene == nullptr) return;
  if (!findings.has_error_at({"t_start", "t_end", "samples", "dt", "times"})) {
    read_grid(request, 1 + 2 * static_cast<std::int64_t>(scene->coordinates.size()), findings);
  }
  check_inputs(request.system, findings);
  if (findings.echo().contains("methods") && request.methods.empty()) {
    findings.report("methods", "empty", "'methods' needs at least one.");
  }
  check_impacts(request, findings);
}

Json names_of_methods() {
  Json names = Json::array();
  for (const MethodRecord& record : methods()) names.push_back(record.name);
  return names;
}

RequestTable<AccuracyRequest> make_accuracy_table() {
  std::vector<RequestField<AccuracyRequest>> fields{
      system_field<AccuracyRequest>(), parameters_field<AccuracyRequest>(), initial_field<AccuracyRequest>(),
      inputs_field<AccuracyRequest>()};
  append_grid_fields(fields);
  const std::vector<RequestField<AccuracyRequest>> rest{
      impacts_field<AccuracyRequest>(),
      choices("methods", &AccuracyRequest::methods, words_of_methods(),
              "the integrators to compare; " + methods_in_words(),
              {.default_value = names_of_methods(), .aliases = {"method", "solvers"}}),
      number("max_error", &AccuracyRequest::max_error, {"1", {limits::least_error, 1}},
             "the error to recommend a method for; without this field 1e-3, 1e-6, 1e-9 and 1e-12",
             {.aliases = {"max_abs_error", "error", "global_error"}}),
      boolean("measure", &AccuracyRequest::measure,
              "measure the CPU time of each run too, and recommend by it; the answer then differs from run "
              "to run",
              {.default_value = false}),
      digits_field<AccuracyRequest>(),
  };
  fields.insert(fields.end(), rest.begin(), rest.end());
  return RequestTable<AccuracyRequest>(std::move(fields), {ways_of_grid}, check_accuracy);
}

}  // namespace

const RequestTable<AccuracyRequest>& accuracy_table() {
  static const RequestTable<AccuracyRequest> table = make_accuracy_table();
  return table;
}

}  // namespace qdot::api
