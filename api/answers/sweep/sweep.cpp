#include <algorithm>
#include <variant>

#include "api/answers/answers.hpp"
#include "api/answers/sweep/rows.hpp"
#include "api/contract/answering.hpp"
#include "api/json/documents.hpp"
#include "api/json/limits.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

constexpr const char* sweep_csv = "text/csv";
constexpr const char* sweep_ndjson = "application/x-ndjson";
constexpr std::int64_t rows_of_own_machine = 100'000'000;  ///< more do not fit into memory

bool is_whole(const SweptRow& row) { return row.status == 200 && row.reason.empty(); }

class SweepAnswer {
 public:
  SweepAnswer(const SweepPlan& plan, const SweptRows& swept, Call& call)
      : plan_(plan), swept_(swept), call_(call) {}

  [[nodiscard]] Response json() const {
    JsonWriter writer(call_.layout);
    writer.begin_object();
    write_head(writer, *plan_.scene, plan_.echo, call_.notes);
    writer.member("rows", swept_.rows.size());
    writer.key("columns");
    write_columns(writer);
    writer.member("failed", failed());
    writer.member("units", units());
    writer.end_object();
    return {.content_type = "application/json", .body = std::move(writer).finish()};
  }

  /// A row that is not whole says so at its end.
  [[nodiscard]] Response ndjson() const {
    std::string text;
    for (std::size_t row = 0; row < swept_.rows.size(); ++row) {
      JsonWriter writer(Layout::compact);
      writer.begin_object();
      for (std::size_t i = 0; i < plan_.swept.variables.size(); ++i)
        writer.member(plan_.swept.variables[i].name, plan_.swept.value(row, i));
      const SweptRow& answered = swept_.rows[row];
      for (std::size_t i = 0; i < plan_.columns.size(); ++i) {
        writer.key(plan_.columns[i].name);
        write_value(writer, answered, i);
      }
      if (!is_whole(answered)) {
        writer.member("status", answered.status);
        writer.member("reason", answered.reason);
      }
      writer.end_object();
      text += std::move(writer).finish();
    }
    return {.content_type = sweep_ndjson, .body = std::move(text)};
  }

  /// RFC 4180 with LF; the columns status and reason say why a cell is empty.
  [[nodiscard]] Response csv() const {
    std::string text;
    for (const SweepVariable& variable : plan_.swept.variables) text += variable.name + ",";
    for (const CollectedColumn& column : plan_.columns) text += column.name + ",";
    text += "status,reason\n";
    for (std::size_t row = 0; row < swept_.rows.size(); ++row) {
      for (std::size_t i = 0; i < plan_.swept.variables.size(); ++i) {
        append_number(text, plan_.swept.value(row, i));
        text += ',';
      }
      const SweptRow& answered = swept_.rows[row];
      for (std::size_t i = 0; i < plan_.columns.size(); ++i) append_cell(text, answered, i);
      text += std::to_string(answered.status) + ",";
      append_text_cell(text, answered.reason);
      text += '\n';
    }
    return {.content_type = sweep_csv, .body = std::move(text)};
  }

 private:
  void write_columns(JsonWriter& writer) const {
    writer.begin_object();
    std::vector<double> column(swept_.rows.size());
    for (std::size_t i = 0; i < plan_.swept.variables.size(); ++i) {
      for (std::size_t row = 0; row < column.size(); ++row) column[row] = plan_.swept.value(row, i);
      writer.key(plan_.swept.variables[i].name);
      writer.numbers(column);
    }
    for (std::size_t i = 0; i < plan_.columns.size(); ++i) {
      writer.key(plan_.columns[i].name);
      if (has_digits(i)) {
        writer.begin_array();
        for (const SweptRow& row : swept_.rows) write_value(writer, row, i);
        writer.end_array();
      } else {
        Json values = Json::array();
        for (const SweptRow& row : swept_.rows) values.push_back(row.values[i]);
        writer.value(values);
      }
    }
    writer.end_object();
  }

  [[nodiscard]] bool has_digits(std::size_t column) const {
    return std::ranges::any_of(swept_.rows,
                               [&](const SweptRow& row) { return digits_of(row, column) != nullptr; });
  }

  static const std::string* digits_of(const SweptRow& row, std::size_t column) {
    return row.digits.empty() || row.digits[column].empty() ? nullptr : &row.digits[column];
  }

  static void write_value(JsonWriter& writer, const SweptRow& row, std::size_t column) {
    if (const std::string* digits = digits_of(row, column))
      writer.number_text(*digits);
    else
      writer.value(row.values[column]);
  }

  [[nodiscard]] Json failed() const {
    Json failed = Json::array();
    for (std::size_t row = 0; row < swept_.rows.size(); ++row) {
      const SweptRow& answered = swept_.rows[row];
      if (is_whole(answered)) continue;
      failed.push_back({{"row", row}, {"status", answered.status}, {"reason", answered.reason}});
    }
    return failed;
  }

  [[nodiscard]] Json units() const {
    Json units = Json::object();
    for (const SweepVariable& variable : plan_.swept.variables) units[variable.name] = variable.unit;
    for (std::size_t i = 0; i < plan_.columns.size(); ++i) units[plan_.columns[i].name] = swept_.units[i];
    return units;
  }

  static void append_text_cell(std::string& text, const std::string& cell) {
    if (cell.find_first_of(",\"\n") == std::string::npos) {
      text += cell;
      return;
    }
    text += '"';
    for (const char c : cell) text += c == '"' ? "\"\"" : std::string(1, c);
    text += '"';
  }

  static void append_cell(std::string& text, const SweptRow& row, std::size_t column) {
    const Json& value = row.values[column];
    if (const std::string* digits = digits_of(row, column)) {
      text += *digits;
    } else if (value.is_number_float()) {
      append_number(text, value.get<double>());
    } else if (value.is_string()) {
      append_text_cell(text, value.get<std::string>());
    } else if (!value.is_null()) {
      text += dump_json(value);
    }
    text += ',';
  }

  const SweepPlan& plan_;
  const SweptRows& swept_;
  Call& call_;
};

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
  const auto read = plan_of(std::get<Submission>(submission), find_system, most, request);
  call.timing.lap("parse");
  if (const auto* problem = std::get_if<Problem>(&read))
    return to_response(*problem, call.target.path, call.layout);
  const auto& plan = std::get<SweepPlan>(read);
  call.notes.insert(call.notes.end(), plan.swept.notes.begin(), plan.swept.notes.end());
  const SweptRows rows = answered_rows(plan, call, find_system, models);
  call.timing.lap("solve");
  if (rows.rows.size() < plan.swept.rows)
    call.notes.push_back("Stopped: these are the first " + std::to_string(rows.rows.size()) + " of " +
                         std::to_string(plan.swept.rows) + " rows.");
  const SweepAnswer answer(plan, rows, call);
  const SweepFormat format = format_of_sweep(request, call);
  Response response = format == SweepFormat::json  ? answer.json()
                      : format == SweepFormat::csv ? answer.csv()
                                                   : answer.ndjson();
  call.timing.lap("encode");
  return response;
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
