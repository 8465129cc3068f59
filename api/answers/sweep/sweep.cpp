#include <utility>
#include <variant>

#include "api/answers/answers.hpp"
#include "api/answers/sweep/answer_bound.hpp"
#include "api/answers/sweep/rows.hpp"
#include "api/answers/sweep/sweep_answer.hpp"
#include "api/contract/answering.hpp"
#include "api/json/limits.hpp"

namespace qdot::api {
namespace {

constexpr std::int64_t rows_of_own_machine = 100'000'000;  ///< more do not fit into memory

SweepFormat format_of_sweep(const SweepRequest& request, const Call& call) {
  if (request.format) return *request.format;
  if (call.accepted == sweep_csv) return SweepFormat::csv;
  return call.accepted == sweep_ndjson ? SweepFormat::ndjson : SweepFormat::json;
}

Response answer_sweep(Call& call, const FindSystem& find_system, Models& models) {
  const auto submission = submission_of(call);
  if (const auto* problem = std::get_if<Problem>(&submission))
    return to_response(*problem, call.target.path, call.layout);
  const std::int64_t most = call.request.work == Work::bounded ? limits::sweep_rows : rows_of_own_machine;
  SweepRequest request;
  auto read = plan_of(std::get<Submission>(submission), find_system, most, request);
  call.timing.lap("parse");
  if (const auto* problem = std::get_if<Problem>(&read))
    return to_response(*problem, call.target.path, call.layout);
  auto& plan = std::get<SweepPlan>(read);
  plan.format = format_of_sweep(request, call);
  call.notes.insert(call.notes.end(), plan.swept.notes.begin(), plan.swept.notes.end());
  try {
    SweptRows rows = answered_rows(plan, call, find_system, models);
    call.timing.lap("solve");
    if (rows.rows.size() < plan.swept.rows)
      call.notes.push_back("Stopped: these are the first " + std::to_string(rows.rows.size()) + " of " +
                           std::to_string(plan.swept.rows) + " rows.");
    Response response = sweep_answer(plan, std::move(rows), call);
    call.timing.lap("encode");
    return response;
  } catch (const AnswerTooLong&) {
    return to_response(answer_too_long(), call.target.path, call.layout);
  }
}

Handler sweep_handler(const FindSystem& find_system, Models& models) {
  return [find_system, &models](Call& call) {
    return guarded(call, [&] { return answer_sweep(call, find_system, models); });
  };
}

}  // namespace

Endpoint sweep_endpoint() {
  return {
      .name = "sweep",
      .help = "Ask one question over a grid or a sample of parameters and initial values",
      .question = {&sweep_table().set(), sweep_handler},
      .cost = {.milliseconds = 0.1, .made_of = Cost::MadeOf::rows},
      .example = [](const Scene&, const Json&) { return std::optional<Json>(); },
      .offers = {"application/json", sweep_csv, sweep_ndjson},
      .other_names = {"scan", "grid", "parameter_sweep", "ensemble", "monte_carlo", "vary", "parametric"}};
}

}  // namespace qdot::api
