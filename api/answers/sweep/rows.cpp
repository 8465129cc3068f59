#include "api/answers/sweep/rows.hpp"

#include <algorithm>
#include <limits>
#include <mutex>

#include "api/answers/many.hpp"
#include "api/answers/sweep/answer_bound.hpp"
#include "api/contract/json_reader.hpp"
#include "api/json/documents.hpp"
#include "api/json/pointer.hpp"
#include "core/base/work.hpp"

namespace qdot::api {
namespace {

/// "1 field is wrong." says less than what is wrong with it.
std::string reason_of_problem(const Json& problem) {
  if (!problem.is_object()) return "There is no answer.";
  const auto errors = problem.find("errors");
  if (errors != problem.end() && !errors->empty()) return (*errors)[0].value("detail", "");
  return problem.value("detail", "");
}

/// The digits of collected numbers, as the answer has them.
std::vector<std::string> digits_in(const std::string& answer, const std::vector<CollectedColumn>& columns) {
  constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
  const auto read = read_json(answer, {.bytes = any, .nodes = any});
  const auto* document = std::get_if<JsonDocument>(&read);
  std::vector<std::string> digits(columns.size());
  for (std::size_t i = 0; i < columns.size() && document != nullptr; ++i) {
    const auto found = document->numbers.find(std::string(root_pointer) + columns[i].pointer);
    if (found != document->numbers.end()) digits[i] = found->second;
  }
  return digits;
}

SweptRow read_row(const Response& response, const std::vector<CollectedColumn>& columns,
                  std::vector<std::string>& units) {
  SweptRow row{.status = response.status, .values = std::vector<Json>(columns.size())};
  const Json answer = parse_json_or_discard(response.body);
  if (response.status != 200) {
    row.reason = reason_of_problem(answer);
    return row;
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    CollectedValue found = collected(answer, columns[i]);
    row.values[i] = std::move(found.value);
    units.push_back(found.unit);
    if (!found.reason.empty())
      row.reason += (row.reason.empty() ? "" : " ") + columns[i].name + ": " + found.reason;
  }
  return row;
}

/// What a row takes in the answer, whose form may add quotes, commas and escapes: no more than it will.
std::size_t least_bytes(const SweepPlan& plan, const SweptRow& row) {
  std::size_t bytes = row.reason.size();
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    const Json& value = row.values[i];
    bytes += value.is_string() ? value.get_ref<const std::string&>().size() : 1;
    if (plan.format == SweepFormat::ndjson) bytes += plan.columns[i].name.size();
  }
  return bytes;
}

/// Asks one row as a client would ask it alone.
Response asked_row(const SweepPlan& plan, std::size_t row, const std::vector<std::string>& wanted,
                   const Call& call, const Answering& answering) {
  const Submission submission = row_request(plan, row);
  const Request inner{.method = submission.road == Road::query ? "GET" : "POST",
                      .target = "/v1/" + std::string(plan.question->name),
                      .headers = {},
                      .body = {},
                      .interrupted = call.request.interrupted,
                      .work = call.request.work};
  Call one{.request = inner, .target = {.path = inner.target, .query = {}}};
  one.accepted = "application/json";
  if (!wanted.empty()) one.wanted = &wanted;
  return answering(submission, one);
}

/// Nobody waits at a service any more; but who ends a sweep on a machine of their own wants what there is.
void keep_what_was_asked(const Call& call, std::vector<SweptRow>& rows) {
  rows.erase(std::ranges::find(rows, 0, &SweptRow::status), rows.end());
  if (call.request.work == Work::bounded || rows.empty()) throw Interrupted();
}

}  // namespace

SweptRows answered_rows(const SweepPlan& plan, const Call& call, const FindSystem& find_system,
                        Models& models) {
  Models carried;
  if (plan.is_carried) carried.add(*plan.scene);
  Models own(plan.is_carried ? carried : models);
  const FindSystem same = [&plan](const Json&, const Place&, Errors&) { return plan.scene; };
  const Answering answering = plan.question->question.answering(plan.is_carried ? same : find_system, own);
  const std::vector<std::string> wanted = members_read(plan.columns);
  const bool has_more_digits = is_text(plan.asked.fields.value("precision", Json()), "extended");
  SweptRows answered;
  // Refuses now what no memory holds, and touches none of it.
  answered.rows.reserve(plan.swept.rows);
  std::vector<std::string> units(plan.columns.size());
  std::vector<std::size_t> first(plan.columns.size(), plan.swept.rows);  // row that the unit is of
  const AnswerBound bound(call.request.work);
  std::size_t bytes = 0;
  std::mutex mutex;
  const auto ask = [&](std::size_t i) {
    std::vector<std::string> own_units;
    const Response response = asked_row(plan, i, wanted, call, answering);
    SweptRow row = read_row(response, plan.columns, own_units);
    if (has_more_digits && response.status == 200) row.digits = digits_in(response.body, plan.columns);
    const std::lock_guard lock(mutex);
    bytes += least_bytes(plan, row);
    bound.check(bytes);
    if (answered.rows.size() <= i) answered.rows.resize(i + 1);
    answered.rows[i] = std::move(row);
    for (std::size_t column = 0; column < own_units.size(); ++column) {
      if (own_units[column].empty() || first[column] < i) continue;
      first[column] = i;
      units[column] = own_units[column];
    }
  };
  try {
    for_each(call.request, plan.swept.rows, ask);
  } catch (const Interrupted&) {
    keep_what_was_asked(call, answered.rows);
  }
  for (const std::string& unit : units) answered.units.push_back(unit.empty() ? "1" : unit);
  return answered;
}

}  // namespace qdot::api
