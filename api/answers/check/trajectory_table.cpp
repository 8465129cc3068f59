#include "api/answers/check/trajectory_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "api/answers/check/column_heading.hpp"
#include "api/contract/json_reader.hpp"
#include "api/json/limits.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

constexpr std::size_t most_columns = 64;

TrajectoryTable no_table(std::string why) { return {.unreadable = std::move(why)}; }

/// Lines end as those of Unix, Windows or old spreadsheets.
std::string_view next_line(std::string_view& rest) {
  const std::size_t end = rest.find_first_of("\r\n");
  const std::string_view line = rest.substr(0, end);
  const bool is_pair = end != std::string_view::npos && rest.substr(end).starts_with("\r\n");
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + (is_pair ? 2 : 1));
  return line;
}

/// What parts the cells of the first line.
char separator_of(std::string_view header) {
  for (const char c : {';', ',', '\t', ' '}) {
    if (header.find(c) != std::string_view::npos) return c;
  }
  return ',';
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  if (separator == ' ') line = trimmed(line);
  for (;;) {
    const std::size_t end = line.find(separator);
    std::string_view cell = trimmed(line.substr(0, end));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    cells.push_back(cell);
    if (end == std::string_view::npos || cells.size() > most_columns) return cells;
    line.remove_prefix(end + 1);
    if (separator == ' ') line = trimmed(line);
  }
}

std::optional<double> number_of(std::string_view cell, bool has_decimal_commas) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  std::string room;
  if (const std::size_t comma = cell.find(','); has_decimal_commas && comma != std::string_view::npos) {
    room = std::string(cell);
    room[comma] = '.';
    cell = room;
  }
  double value{};
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool is_whole = error == std::errc() && end == cell.data() + cell.size();
  return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The columns by name; the time is called t or time.
TrajectoryTable named(const std::vector<ColumnHeading>& headings, std::vector<std::vector<double>> columns) {
  TrajectoryTable table;
  bool has_time = false;
  for (std::size_t i = 0; i < headings.size(); ++i) {
    const std::string& name = headings[i].name;
    if (name == "t") {
      if (has_time) return no_table("There are two columns of instants.");
      table.t = std::move(columns[i]);
      for (double& t : table.t) t *= headings[i].factor;
      has_time = true;
    } else if (!table.columns.emplace(name, std::move(columns[i])).second) {
      return no_table("Two columns are called " + in_quotes(name) + ".");
    } else {
      table.units[name] = headings[i];
    }
  }
  return has_time ? table : no_table("A column 't' with the instants is needed.");
}

/// The first line that is no comment, or that with names behind the comment's sign.
std::string_view header_of(std::string_view& text, std::size_t& row) {
  std::string_view header = trimmed(next_line(text));
  for (; !text.empty() && (header.empty() || header.starts_with('#') || header.starts_with('%')); ++row) {
    std::string_view ahead = text;
    const std::string_view next = trimmed(next_line(ahead));
    const bool begins_data = !next.empty() && next.find_first_of("0123456789") <= 2 && !header.empty();
    if (begins_data) return trimmed(header.substr(1));
    header = next;
    text = ahead;
  }
  return header;
}

TrajectoryTable from_csv(std::string_view text) {
  if (constexpr std::string_view mark = "\xEF\xBB\xBF"; text.starts_with(mark))
    text.remove_prefix(mark.size());  // spreadsheets write it
  std::size_t row = 2;
  const std::string_view header = header_of(text, row);
  const char separator = separator_of(header);
  std::vector<ColumnHeading> headings;
  for (const std::string_view cell : cells_of(header, separator)) headings.push_back(column_heading(cell));
  if (headings.size() > most_columns) return no_table("There are more than 64 columns.");
  std::vector<std::vector<double>> columns(headings.size());
  for (std::size_t count = 0; !text.empty(); ++row) {
    const std::string_view line = next_line(text);
    if (trimmed(line).empty()) continue;
    const std::string where = "Line " + std::to_string(row);
    if (++count > most_trajectory_rows) return no_table("There are more than 10000 rows.");
    const auto cells = cells_of(line, separator);
    if (cells.size() != headings.size())
      return no_table(where + " has another number of cells than the first line.");
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = number_of(cells[i], separator == ';');
      if (!value) return no_table(where + ": " + in_quotes(cells[i]) + " is not a number.");
      columns[i].push_back(*value);
    }
  }
  return named(headings, std::move(columns));
}

TrajectoryTable from_json(const Json& object) {
  std::vector<ColumnHeading> headings;
  std::vector<std::vector<double>> columns;
  if (object.size() > most_columns) return no_table("There are more than 64 columns.");
  for (const auto& [name, values] : object.items()) {
    if (!values.is_array()) return no_table(in_quotes(name) + " needs an array of numbers.");
    if (values.size() > most_trajectory_rows) return no_table("There are more than 10000 rows.");
    headings.push_back(column_heading(name));
    columns.emplace_back();
    for (const Json& value : values) {
      if (!value.is_number()) return no_table(in_quotes(name) + " has an entry that is not a number.");
      columns.back().push_back(value.get<double>());
    }
    if (columns.back().size() != columns.front().size())
      return no_table("The columns are not of one length.");
  }
  return named(headings, std::move(columns));
}

/// Rows that each name their columns, as columns.
std::optional<Json> columns_of_rows(const Json& rows) {
  Json columns = Json::object();
  for (const Json& row : rows) {
    if (!row.is_object() || row.size() != rows.front().size()) return std::nullopt;
    for (const auto& [name, value] : row.items()) columns[name].push_back(value);
  }
  return columns;
}

}  // namespace

TrajectoryTable trajectory_table(const Json& submitted) {
  if (submitted.is_string()) {
    const std::string_view text = trimmed(submitted.get_ref<const std::string&>());
    if (!text.starts_with('{')) return from_csv(submitted.get_ref<const std::string&>());
    const auto read = read_json(text, {.bytes = limits::large_body_bytes, .nodes = limits::large_json_nodes});
    const auto* document = std::get_if<JsonDocument>(&read);
    return document != nullptr && document->duplicates.empty() && document->value.is_object()
               ? trajectory_table(document->value)
               : no_table("The JSON cannot be read.");
  }
  if (submitted.is_object()) {
    const bool is_answer = submitted.contains("trajectory") && submitted["trajectory"].is_object();
    return from_json(is_answer ? submitted["trajectory"] : submitted);
  }
  if (submitted.is_array() && !submitted.empty() && submitted.size() <= most_trajectory_rows) {
    if (const auto columns = columns_of_rows(submitted)) return from_json(*columns);
  }
  return no_table("A trajectory is CSV, or an object of columns.");
}

}  // namespace qdot::api
