#include "api/json/writer.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "api/json/documents.hpp"
#include "core/base/work.hpp"

namespace qdot::api {
namespace {

constexpr std::size_t rows_between_looks = 256;  // whether anyone still waits for the answer

// -1.7976931348623157e+308 has 24 characters, -0.0001 with 17 digits 23.
constexpr std::size_t longest_number = 32;

double require_finite(double value) {
  if (!std::isfinite(value)) throw std::logic_error("a number that is not finite was to be written");
  return value;
}

/// Where the notation without exponent is the one that people read.
std::chars_format notation(double magnitude) {
  return magnitude >= 1e-4 && magnitude < 1e15 ? std::chars_format::fixed : std::chars_format::scientific;
}

bool holds_structures(const Json& json) {
  return json.is_array() &&
         std::ranges::any_of(json, [](const Json& element) { return element.is_structured(); });
}

/// A value without line breaks: a scalar, or an array of scalars.
void append_flat(std::string& out, const Json& json, std::string_view comma, int digits) {
  if (json.is_array()) {
    out += '[';
    for (std::size_t i = 0; i < json.size(); ++i) {
      if (i > 0) out += comma;
      append_flat(out, json[i], comma, digits);
    }
    out += ']';
  } else if (json.is_number_float()) {
    append_number(out, json.get<double>(), digits);
  } else if (json.is_string()) {
    append_string(out, json.get_ref<const std::string&>());
  } else {
    out += dump_json(json);  // null, true, false and integers
  }
}

/// What follows the first of a pointer's names: "theta/100" in "/trajectory/theta/100". None where it has
/// another one, or nothing follows.
std::optional<std::string_view> after_name(std::string_view pointer, std::string_view name) {
  if (!pointer.starts_with('/') || !pointer.substr(1).starts_with(name)) return std::nullopt;
  const std::string_view rest = pointer.substr(1 + name.size());
  return rest.starts_with('/') ? std::optional(rest.substr(1)) : std::nullopt;
}

/// The number's digits from `text` on, at most longest_number of them; returns their end.
char* write_number(char* text, double value) {
  if (value == 0) return std::ranges::copy(std::string_view("0.0"), text).out;  // -0.0 too
  const std::chars_format format = notation(std::abs(value));
  char* end = std::to_chars(text, text + longest_number - 2, value, format).ptr;
  // A whole number in fixed notation has no point; below 1e15 its double is exact, so the test is too.
  if (format == std::chars_format::fixed && value == std::trunc(value)) {
    *end++ = '.';
    *end++ = '0';
  }
  return end;
}

}  // namespace

double rounded(double value, int digits) {
  if (digits == shortest_digits || !std::isfinite(value)) return value;
  char text[longest_number];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1).ptr;
  double result{};
  // The largest doubles round up to infinity: keep those as they are.
  return std::from_chars(text, end, result).ec == std::errc{} ? result : value;
}

double rounded_up(double bound, int digits) {
  const double nearest = rounded(bound, digits);
  if (nearest >= bound) return nearest;
  char buffer[longest_number];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, bound, std::chars_format::scientific, digits - 1).ptr;
  std::string text(buffer, end);  // to the next decimal: one more in the last digit, with its carry
  std::size_t last = text.find('e') - 1;
  for (; last > 0 && (text[last] == '9' || text[last] == '.'); --last) {
    if (text[last] == '9') text[last] = '0';
  }
  if (text[last] == '9') {
    text.replace(0, 1, "10");
  } else {
    ++text[last];
  }
  double result{};
  const bool fits = std::from_chars(text.data(), text.data() + text.size(), result).ec == std::errc{};
  return fits ? result : std::numeric_limits<double>::infinity();
}

void append_number(std::string& out, double value, int digits) {
  char text[longest_number];
  out.append(text, write_number(text, rounded(require_finite(value), digits)));
}

void append_string(std::string& out, std::string_view text) {
  const bool is_plain = std::ranges::all_of(
      text, [](unsigned char c) { return c >= ' ' && c < 0x7f && c != '"' && c != '\\'; });
  if (is_plain) {
    out += '"';
    out += text;
    out += '"';
    return;
  }
  out += dump_json_replacing(Json(text));
}

void JsonWriter::open(char bracket) {
  separate();
  out_ += bracket;
  has_members_.push_back(false);
}

void JsonWriter::close(char bracket) {
  const bool had_members = has_members_.back();
  has_members_.pop_back();
  if (had_members) new_line();
  out_ += bracket;
}

/// Before a key, and before a value that has none.
void JsonWriter::separate() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (has_members_.empty()) return;
  if (has_members_.back()) out_ += ',';
  has_members_.back() = true;
  new_line();
}

void JsonWriter::new_line() {
  if (layout_ == Layout::compact) return;
  out_ += '\n';
  out_.append(2 * has_members_.size(), ' ');
}

void JsonWriter::key(std::string_view name) {
  if (has_members_.size() == 1) member_ = name;
  separate();
  append_string(out_, name);
  out_ += layout_ == Layout::pretty ? ": " : ":";
  after_key_ = true;
}

void JsonWriter::number(double value, int digits) {
  separate();
  append_number(out_, value, digits);
}

void JsonWriter::number_text(std::string_view digits) {
  separate();
  out_ += digits;
}

void JsonWriter::number_texts(std::span<const std::string> numbers) {
  separate();
  out_ += '[';
  const std::string_view comma = layout_ == Layout::pretty ? ", " : ",";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) out_ += comma;
    out_ += numbers[i];
  }
  out_ += ']';
}

void JsonWriter::string(std::string_view text) {
  separate();
  append_string(out_, text);
}

void JsonWriter::numbers(std::span<const double> values, int digits) {
  separate();
  out_ += '[';
  const std::string_view comma = layout_ == Layout::pretty ? ", " : ",";
  const std::size_t begin = out_.size();
  out_.resize(begin + (longest_number + comma.size()) * values.size());
  char* end = out_.data() + begin;
  for (const double value : values) {
    if (end != out_.data() + begin) end = std::ranges::copy(comma, end).out;
    end = write_number(end, rounded(require_finite(value), digits));
  }
  out_.resize(static_cast<std::size_t>(end - out_.data()));
  out_ += ']';
}

void JsonWriter::columns(std::span<const Column> table, int digits) {
  begin_object();
  for (const Column& column : table) {
    check_interruption();
    if (is_wanted_whole(column.name)) {
      key(column.name);
      numbers(column.values, digits);
    } else {
      wanted_numbers(column, digits);
    }
  }
  end_object();
}

bool JsonWriter::is_wanted_whole(std::string_view column) const {
  if (wanted_ == nullptr || has_members_.size() != 2) return true;
  return std::ranges::any_of(*wanted_, [&](const std::string& wanted) {
    return wanted == member_ || after_name(wanted, member_) == column;
  });
}

void JsonWriter::wanted_numbers(const Column& column, int digits) {
  std::vector<bool> is_wanted(column.values.size());
  bool any = false;
  for (const std::string& wanted : *wanted_) {
    const auto rest = after_name(wanted, member_);
    if (!rest || !rest->starts_with(column.name + "/")) continue;
    any = true;
    const std::string_view place = rest->substr(column.name.size() + 1);
    std::size_t i = is_wanted.size();
    std::from_chars(place.data(), place.data() + place.size(), i);
    if (i < is_wanted.size()) is_wanted[i] = true;
  }
  if (!any) return;
  key(column.name);
  separate();
  for (std::size_t i = 0; i < is_wanted.size(); ++i) {
    out_ += i == 0 ? '[' : ',';
    is_wanted[i] ? append_number(out_, column.values[i], digits) : void(out_ += "null");
  }
  out_ += is_wanted.empty() ? "[]" : "]";
}

void JsonWriter::value(const Json& json, int digits) {
  if (json.is_object()) {
    begin_object();
    for (const auto& [name, element] : json.items()) member(name, element, digits);
    end_object();
  } else if (holds_structures(json)) {
    begin_array();
    for (const Json& element : json) value(element, digits);
    end_array();
  } else {
    separate();
    append_flat(out_, json, layout_ == Layout::pretty ? ", " : ",", digits);
  }
}

bool JsonWriter::wants(std::string_view name) const {
  return wanted_ == nullptr || has_members_.size() != 1 ||
         std::ranges::any_of(*wanted_, [name](const std::string& wanted) {
           return wanted == name || after_name(wanted, name).has_value();
         });
}

void JsonWriter::member(std::string_view name, const Json& json, int digits) {
  if (!wants(name)) return;
  key(name);
  value(json, digits);
}

std::string JsonWriter::finish() && {
  out_ += '\n';
  return std::move(out_);
}

std::string to_text(const Json& json, Layout layout) {
  JsonWriter writer(layout);
  writer.value(json);
  return std::move(writer).finish();
}

std::string to_csv(std::span<const Column> table, int digits) {
  std::string out;
  const std::size_t rows = table.empty() ? 0 : table.front().values.size();
  out.reserve(22 * (rows + 1) * table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i].values.size() != rows) throw std::logic_error("the columns of a table differ in length");
    out += table[i].name;
    out += i + 1 < table.size() ? ',' : '\n';
  }
  for (std::size_t row = 0; row < rows; ++row) {
    if (row % rows_between_looks == 0) check_interruption();
    for (std::size_t i = 0; i < table.size(); ++i) {
      append_number(out, table[i].values[row], digits);
      out += i + 1 < table.size() ? ',' : '\n';
    }
  }
  return out;
}

std::string to_ndjson(std::span<const Column> table, int digits) {
  std::string out;
  const std::size_t rows = table.empty() ? 0 : table[0].values.size();
  std::vector<std::string> keys;
  for (const Column& column : table) {
    keys.emplace_back(keys.empty() ? "{" : ",");
    append_string(keys.back(), column.name);
    keys.back() += ':';
  }
  for (std::size_t row = 0; row < rows; ++row) {
    if (row % rows_between_looks == 0) check_interruption();
    for (std::size_t i = 0; i < table.size(); ++i) {
      out += keys[i];
      append_number(out, table[i].values[row], digits);
    }
    out += "}\n";
  }
  return out;
}

}  // namespace qdot::api
