#include "api/json/writer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "api/json/shortest_decimal.hpp"
#include "core/base/work.hpp"

namespace qdot::api {
namespace {

constexpr std::size_t rows_between_looks = 256;  // whether the answer is still awaited

// -1.7976931348623157e+308 has 24 characters, -0.0001 with 17 digits 23.
constexpr std::size_t longest_number = 32;

double require_finite(double value) {
  if (!std::isfinite(value)) throw std::logic_error("a number that is not finite was to be written");
  return value;
}

/// Where the notation without exponent is the one that people read.
bool is_written_in_full(double magnitude) { return magnitude >= 1e-4 && magnitude < 1e15; }

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
    out += json.dump();  // null, true, false and integers
  }
}

/// "000102..99"
constexpr std::array<char, 200> pairs_of_digits = [] {
  std::array<char, 200> pairs{};
  for (std::size_t i = 0; i < pairs.size(); ++i)
    pairs[i] = static_cast<char>('0' + (i % 2 == 0 ? i / 20 : i / 2 % 10));
  return pairs;
}();

/// So many digits, from the last one on.
void write_digits(char* text, std::uint64_t digits, int count) {
  for (; count >= 2; digits /= 100) {
    count -= 2;
    std::copy_n(pairs_of_digits.data() + 2 * (digits % 100), 2, text + count);
  }
  if (count == 1) *text = static_cast<char>('0' + digits);
}

constexpr std::array<std::uint64_t, 20> powers_of_ten = [] {
  std::array<std::uint64_t, 20> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = 10 * powers[i - 1];
  return powers;
}();

/// Of a number above zero: by that of its bits, 1233/4096 digits each, or one more.
int count_of_digits(std::uint64_t digits) {
  const int count = std::bit_width(digits) * 1233 >> 12;
  return count + (digits >= powers_of_ten[static_cast<std::size_t>(count)] ? 1 : 0);
}

/// With a point before the digits, behind them, or among them.
char* write_in_full(char* text, const Decimal& decimal, int count) {
  const int before_point = count + decimal.exponent;
  if (before_point <= 0) {
    text = std::ranges::copy(std::string_view("0."), text).out;
    text = std::fill_n(text, -before_point, '0');
    write_digits(text, decimal.digits, count);
    return text + count;
  }
  if (before_point >= count) {
    write_digits(text, decimal.digits, count);
    text = std::fill_n(text + count, before_point - count, '0');
    return std::ranges::copy(std::string_view(".0"), text).out;
  }
  write_digits(text + 1, decimal.digits, count);
  for (int i = 0; i < before_point; ++i) text[i] = text[i + 1];
  text[before_point] = '.';
  return text + count + 1;
}

/// An exponent has a sign and at least two digits.
char* write_with_exponent(char* text, const Decimal& decimal, int count) {
  write_digits(text + 1, decimal.digits, count);
  text[0] = text[1];
  text[1] = '.';
  text += count > 1 ? count + 1 : 1;
  const int exponent = count - 1 + decimal.exponent, size = std::abs(exponent);
  *text++ = 'e';
  *text++ = exponent < 0 ? '-' : '+';
  if (size < 10) *text++ = '0';
  return std::to_chars(text, text + 3, size).ptr;
}

/// The number's digits from `text` on, at most longest_number of them; returns their end.
char* write_number(char* text, double value) {
  if (value == 0) return std::ranges::copy(std::string_view("0.0"), text).out;  // -0.0 too
  if (value < 0) *text++ = '-';
  const double magnitude = std::abs(value);
  const Decimal decimal = shortest_decimal(magnitude);
  const int count = count_of_digits(decimal.digits);
  return is_written_in_full(magnitude) ? write_in_full(text, decimal, count)
                                       : write_with_exponent(text, decimal, count);
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
  out += Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
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
    key(column.name);
    numbers(column.values, digits);
  }
  end_object();
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
         std::ranges::find(*wanted_, name) != wanted_->end();
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
