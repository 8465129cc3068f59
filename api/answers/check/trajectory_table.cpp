#include "api/answers/check/trajectory_table.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "api/json/text.hpp"

namespace qdot::api {
namespace {

constexpr std::size_t most_columns = 64;

TrajectoryTable no_table(std::string why) { return {.unreadable = std::move(why)}; }

std::string_view next_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// What parts the cells of the first line.
char separator_of(std::string_view header) {
  for (const char c : {',', ';', '\t'}) {
    if (header.find(c) != std::string_view::npos) return c;
  }
  return ',';
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t end = line.find(separator);
    std::string_view cell = trimmed(line.substr(0, end));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    cells.push_back(cell);
    if (end == std::string_view::npos || cells.size() > most_columns) return cells;
    line.remove_prefix(end + 1);
  }
}

std::optional<double> number_of(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value{};
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool is_whole = error == std::errc() && end == cell.data() + cell.size();
  return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The columns by name; the time is called t or time.
TrajectoryTable named(const std::vector<std::string>& names, std::vector<std::vector<double>> columns) {
  TrajectoryTable table;
  bool has_time = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == "t" || names[i] == "time") {
      if (has_time) return no_table("There are two columns of instants.");
      table.t = std::move(columns[i]);
      has_time = true;
    } else if (!table.columns.emplace(names[i], std::move(columns[i])).second) {
      return no_table("Two columns are called " + in_quotes(names[i]) + ".");
    }
  }
  return has_time ? table : no_table("A column 't' with the instants is needed.");
}

TrajectoryTable from_csv(std::string_view text) {
  if (constexpr std::string_view mark = "\xEF\xBB\xBF"; text.starts_with(mark))
    text.remove_prefix(mark.size());  // spreadsheets write it
  const std::string_view header = next_line(text);
  const char separator = separator_of(header);
  std::vector<std::string> names;
  for (const std::string_view cell : cells_of(header, separator))
    names.push_back(lower_case(cell) == "time" ? "t" : std::string(cell));
  if (names.size() > most_columns) return no_table("There are more than 64 columns.");
  std::vector<std::vector<double>> columns(names.size());
  for (std::size_t row = 2; !text.empty(); ++row) {
    const std::string_view line = next_line(text);
    if (trimmed(line).empty()) continue;
    const std::string where = "Line " + std::to_string(row);
    if (row > most_trajectory_rows + 1) return no_table("There are more than 10000 rows.");
    const auto cells = cells_of(line, separator);
    if (cells.size() != names.size())
      return no_table(where + " has another number of cells than the first line.");
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = number_of(cells[i]);
      if (!value) return no_table(where + ": " + in_quotes(cells[i]) + " is not a number.");
      columns[i].push_back(*value);
    }
  }
  return named(names, std::move(columns));
}

TrajectoryTable from_json(const Json& object) {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  if (object.size() > most_columns) return no_table("There are more than 64 columns.");
  for (const auto& [name, values] : object.items()) {
    if (!values.is_array()) return no_table(in_quotes(name) + " needs an array of numbers.");
    if (values.size() > most_trajectory_rows) return no_table("There are more than 10000 rows.");
    names.push_back(name);
    columns.emplace_back();
    for (const Json& value : values) {
      if (!value.is_number()) return no_table(in_quotes(name) + " has an entry that is not a number.");
      columns.back().push_back(value.get<double>());
    }
    if (columns.back().size() != columns.front().size())
      return no_table("The columns are not of one length.");
  }
  return named(names, std::move(columns));
}

}  // namespace

TrajectoryTable trajectory_table(const Json& submitted) {
  if (submitted.is_string()) return from_csv(submitted.get_ref<const std::string&>());
  if (submitted.is_object()) return from_json(submitted);
  return no_table("A trajectory is CSV, or an object of columns.");
}

}  // namespace qdot::api
