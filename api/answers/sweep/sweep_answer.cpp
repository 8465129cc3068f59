#include "api/answers/sweep/sweep_answer.hpp"

#include <algorithm>
#include <utility>

#include "api/answers/answers.hpp"
#include "api/answers/sweep/answer_bound.hpp"
#include "api/json/documents.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

bool is_whole(const SweptRow& row) { return row.status == 200 && row.reason.empty(); }

class SweepAnswer {
 public:
  SweepAnswer(const SweepPlan& plan, SweptRows swept, const Call& call)
      : plan_(plan), swept_(std::move(swept)), call_(call), bound_(call.request.work) {}

  /// Takes the values out of the rows, so that they are not in memory twice.
  [[nodiscard]] Response json() && {
    JsonWriter writer(call_.layout);
    writer.begin_object();
    write_head(writer, *plan_.scene, plan_.echo, call_.notes);
    writer.member("rows", swept_.rows.size());
    writer.key("columns");
    write_columns(writer);
    writer.key("failed");
    write_failed(writer);
    writer.member("units", units());
    writer.end_object();
    std::string text = std::move(writer).finish();
    bound_.check(text.size());
    return {.content_type = "application/json", .body = std::move(text)};
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
      bound_.check(text.size());
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
      bound_.check(text.size());
    }
    return {.content_type = sweep_csv, .body = std::move(text)};
  }

 private:
  void write_columns(JsonWriter& writer) {
    writer.begin_object();
    std::vector<double> column(swept_.rows.size());
    for (std::size_t i = 0; i < plan_.swept.variables.size(); ++i) {
      for (std::size_t row = 0; row < column.size(); ++row) column[row] = plan_.swept.value(row, i);
      writer.key(plan_.swept.variables[i].name);
      writer.numbers(column);
      bound_.check(writer.size());
    }
    for (std::size_t i = 0; i < plan_.columns.size(); ++i) {
      writer.key(plan_.columns[i].name);
      if (has_digits(i)) {
        writer.begin_array();
        for (const SweptRow& row : swept_.rows) write_value(writer, row, i);
        writer.end_array();
      } else {
        Json values = Json::array();
        for (SweptRow& row : swept_.rows) values.push_back(std::move(row.values[i]));
        writer.value(values);
      }
      bound_.check(writer.size());
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

  void write_failed(JsonWriter& writer) const {
    writer.begin_array();
    for (std::size_t row = 0; row < swept_.rows.size(); ++row) {
      const SweptRow& answered = swept_.rows[row];
      if (is_whole(answered)) continue;
      writer.begin_object();
      writer.member("row", row);
      writer.member("status", answered.status);
      writer.member("reason", answered.reason);
      writer.end_object();
      bound_.check(writer.size());
    }
    writer.end_array();
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
  SweptRows swept_;
  const Call& call_;
  AnswerBound bound_;
};

}  // namespace

Response sweep_answer(const SweepPlan& plan, SweptRows swept, const Call& call) {
  SweepAnswer answer(plan, std::move(swept), call);
  switch (plan.format) {
    case SweepFormat::csv:
      return answer.csv();
    case SweepFormat::ndjson:
      return answer.ndjson();
    case SweepFormat::json:
      break;
  }
  return std::move(answer).json();
}

}  // namespace qdot::api
