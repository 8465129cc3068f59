#include "server/people.hpp"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "api/json/documents.hpp"
#include "api/json/writer.hpp"
#include "server/text_table.hpp"

namespace qdot::server {
namespace {

using api::Json;

constexpr std::size_t width_of_sparklines = 60;
constexpr std::size_t fewest_rows_of_a_sparkline = 8;
constexpr std::size_t longest_cell = 72;

bool is_plain(const Json& value) { return !value.is_structured(); }

std::string plain_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "-";
  if (!value.is_number_float()) return api::dump_json(value);
  std::string text;
  api::append_number(text, value.get<double>());
  return text;
}

/// {"text": "g/(2*l)", "latex": ..., "assumes": [...]}
bool is_formula(const Json& value) {
  if (!value.is_object()) return false;
  const auto is_text = [&value](const char* name) { return value.contains(name) && value[name].is_string(); };
  return is_text("text") && is_text("latex");
}

/// "g/(2*l), shape x = 1, theta = 1/l, assumes l > 0": what a person reads, so without LaTeX.
std::string formula_text(const Json& formula) {
  std::string text = formula["text"].get<std::string>();
  const auto append = [&](const std::string& words, const Json& part) {
    text += ", " + words + " = " + part["text"].get<std::string>();
  };
  for (const char* name : {"cos", "sin"})
    if (formula.contains(name)) append(name, formula[name]);
  const Json shape = formula.value("shape", Json::object());
  std::string word = "shape ";
  for (const auto& [name, part] : shape.items()) append(std::exchange(word, "") + name, part);
  const Json assumes = formula.value("assumes", Json::array());
  word = "assumes ";
  for (const Json& sentence : assumes) text += ", " + std::exchange(word, "") + sentence.get<std::string>();
  return text;
}

/// In one cell: of lists and objects their parts, one behind the other.
std::string cell_of(const Json& value) {
  if (is_plain(value)) return plain_text(value);
  if (is_formula(value)) return formula_text(value);
  std::string text;
  for (const auto& [name, part] : value.items()) {
    const std::string label = value.is_object() ? name + "=" : "";
    text +=
        (text.empty() ? "" : " ") + label + (is_plain(part) ? plain_text(part) : "{" + cell_of(part) + "}");
  }
  return text;
}

bool all_plain(const Json& list) { return std::ranges::all_of(list, is_plain); }

/// What stands in a line with its name.
bool is_short(const Json& value) { return is_plain(value) || (value.is_array() && all_plain(value)); }

/// {"t": [0, 1], "x": [3, 4]}
bool is_columns(const Json& value) {
  if (!value.is_object() || value.empty()) return false;
  const std::size_t rows = value.begin()->size();
  return rows > 0 && std::ranges::all_of(value, [&](const Json& column) {
           return column.is_array() && column.size() == rows && all_plain(column);
         });
}

bool is_matrix(const Json& value) {
  return value.is_array() && !value.empty() &&
         std::ranges::all_of(value, [](const Json& row) { return row.is_array() && all_plain(row); });
}

bool is_list_of_objects(const Json& value) {
  return value.is_array() && !value.empty() &&
         std::ranges::all_of(value, [](const Json& entry) { return entry.is_object(); });
}

class Page {
 public:
  Page(const Json& units, Colours colours, bool marks_text)
      : units_(units), colours_(colours), mark_(marks_text ? "# " : "") {}

  void line(const std::string& text) { text_ += mark_ + text + "\n"; }
  void heading(const std::string& text, std::size_t depth) { line(indent(depth) + bold(text)); }

  /// The members of an object: the plain ones aligned, then formulas, then the others, each below its name.
  void members(const Json& object, std::size_t depth) {
    std::vector<Cells> rows, formulas;
    for (const auto& [name, value] : object.items()) {
      if (is_short(value)) rows.push_back(row_of(name, value));
      if (is_formula(value)) formulas.push_back({name, formula_text(value)});
    }
    for (const std::string& row : aligned(rows)) line(indent(depth) + row);
    for (const std::string& row : aligned(formulas)) line(indent(depth) + row);
    for (const auto& [name, value] : object.items())
      if (!is_short(value) && !is_formula(value)) member(name, value, depth);
  }

  void member(const std::string& name, const Json& value, std::size_t depth) {
    if (value.empty()) return;
    heading(name, depth);
    if (is_columns(value)) {
      columns(value);
    } else if (is_matrix(value)) {
      matrix(value, depth + 1);
    } else if (is_list_of_objects(value)) {
      entries(value, depth + 1);
    } else if (value.is_object()) {
      members(value, depth + 1);
    } else {
      for (const Json& part : value) line(indent(depth + 1) + cell_of(part));
    }
  }

  [[nodiscard]] std::string text() && { return std::move(text_); }
  [[nodiscard]] std::string bold(const std::string& text) const {
    return colours_ == Colours::ansi ? "\x1b[1m" + text + "\x1b[0m" : text;
  }

 private:
  static std::string indent(std::size_t depth) { return std::string(2 * depth, ' '); }

  [[nodiscard]] std::string unit_of(const std::string& name) const {
    const auto unit = units_.find(name);
    return unit != units_.end() && unit->is_string() && *unit != "1" ? unit->get<std::string>() : "";
  }

  [[nodiscard]] Cells row_of(const std::string& name, const Json& value) const {
    return {name, cell_of(value), unit_of(name)};
  }

  void columns(const Json& columns) {
    std::vector<Cells> rows(2 + columns.begin()->size());
    for (const auto& [name, values] : columns.items()) {
      rows[0].push_back(name);
      rows[1].push_back(unit_of(name).empty() ? "1" : unit_of(name));
      for (std::size_t i = 0; i < values.size(); ++i) rows[2 + i].push_back(plain_text(values[i]));
    }
    // The mark of the headings takes the place of a blank, so that the columns stay below them.
    for (Cells& row : rows) row.insert(row.begin(), "");
    const std::vector<std::string> lines = aligned(rows);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::string line = i < 2 && !mark_.empty() ? "#" + lines[i].substr(1) : lines[i];
      text_ += (i == 0 ? bold(line) : line) + "\n";
    }
    if (columns.begin()->size() < fewest_rows_of_a_sparkline) return;
    std::vector<Cells> pictures;
    for (const auto& [name, values] : columns.items()) {
      if (name == "t" || !std::ranges::all_of(values, [](const Json& v) { return v.is_number(); })) continue;
      pictures.push_back({name, sparkline(values.get<std::vector<double>>(), width_of_sparklines)});
    }
    for (const std::string& picture : aligned(pictures)) line(picture);
  }

  void matrix(const Json& matrix, std::size_t depth) {
    std::vector<Cells> rows;
    for (const Json& row : matrix) {
      rows.emplace_back();
      for (const Json& entry : row) rows.back().push_back(plain_text(entry));
    }
    for (const std::string& row : aligned(rows)) line(indent(depth) + row);
  }

  /// A list of objects of one kind is a table, as long as its cells are short; closed forms stand below it.
  void entries(const Json& list, std::size_t depth) {
    Json rows = list;
    for (Json& row : rows) row.erase("exact");
    table(rows, depth);
    for (std::size_t i = 0; i < list.size(); ++i)
      if (list[i].contains("exact")) closed_forms(std::to_string(i + 1) + ". ", list[i]["exact"], depth);
  }

  void closed_forms(const std::string& number, const Json& exact, std::size_t depth) {
    if (is_formula(exact)) {
      const std::string of = exact.contains("of") ? plain_text(exact["of"]) + " = " : "";
      return line(indent(depth) + number + of + formula_text(exact));
    }
    for (const auto& [name, part] : exact.items())
      line(indent(depth) + number + name + " = " + cell_of(part));
  }

  void table(const Json& list, std::size_t depth) {
    Cells names;
    bool short_cells = true;
    for (const Json& entry : list) {
      for (const auto& [name, value] : entry.items()) {
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
        short_cells = short_cells && width_of(cell_of(value)) <= longest_cell;
      }
    }
    if (!short_cells) return entries_below_each_other(list, depth);
    std::vector<Cells> rows{names, {}};
    for (const std::string& name : names) rows[1].push_back(unit_of(name));
    if (std::ranges::all_of(rows[1], &std::string::empty)) rows.pop_back();
    for (const Json& entry : list) {
      rows.emplace_back();
      for (const std::string& name : names)
        rows.back().push_back(entry.contains(name) ? cell_of(entry[name]) : "");
    }
    const std::vector<std::string> lines = aligned(rows);
    for (std::size_t i = 0; i < lines.size(); ++i) line(indent(depth) + (i == 0 ? bold(lines[i]) : lines[i]));
  }

  void entries_below_each_other(const Json& list, std::size_t depth) {
    for (const Json& entry : list) {
      if (&entry != &list.front()) line("");
      members(entry, depth);
    }
  }

  const Json& units_;
  Colours colours_;
  std::string mark_;
  std::string text_;
};

/// Parameters and initial state, as they were understood.
void write_request(const Json& answer, Page& page) {
  if (!answer.contains("system")) return;
  page.heading(plain_text(answer["system"]), 0);
  const auto request = answer.find("request");
  if (request == answer.end()) return;
  for (const char* name : {"parameters", "initial", "inputs"})
    if (request->contains(name) && !(*request)[name].empty()) page.line(cell_of((*request)[name]));
}

bool is_said_elsewhere(const std::string& name) {
  constexpr std::string_view names[] = {"system", "model_version", "service_version", "request", "units"};
  return std::ranges::find(names, name) != std::end(names);
}

}  // namespace

std::string answer_as_text(const Json& answer, Colours colours) {
  static const Json none = Json::object();
  const auto units = answer.find("units");
  const bool is_motion = answer.contains("trajectory");
  Page page(units != answer.end() && units->is_object() ? *units : none, colours, is_motion);
  write_request(answer, page);
  Json rest = Json::object();
  for (const auto& [name, value] : answer.items())
    if (!answer.contains("request") || !is_said_elsewhere(name)) rest[name] = value;
  page.members(rest, 0);
  return std::move(page).text();
}

std::string problem_as_text(const Json& problem, Colours colours) {
  Page page(problem, colours, false);
  page.line(page.bold(problem.value("title", "")) + ": " + problem.value("detail", ""));
  if (problem.contains("reason")) page.line("  reason: " + plain_text(problem["reason"]));
  for (const Json& error : problem.value("errors", Json::array())) {
    const std::string place = error.value("pointer", error.value("parameter", ""));
    std::string text = "  " + page.bold(place) + ": " + error.value("detail", "");
    if (error.contains("did_you_mean"))
      text += " Did you mean " + error["did_you_mean"].get<std::string>() + "?";
    else if (error.contains("allowed"))
      text += " There are: " + cell_of(error["allowed"]) + ".";
    page.line(text);
  }
  return std::move(page).text();
}

}  // namespace qdot::server
