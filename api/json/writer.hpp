#pragma once
// JSON and CSV going out. A trajectory is up to a million numbers, so it is written straight into the text
// and never becomes a document of nodes; everything small is a Json value.
//
// Numbers: the shortest digits that read back as the same double, always recognisable as a floating-point
// number
// ("1.0"), without exponent from 1e-4 to 1e15; -0.0 is written as 0.0. There is no JSON for infinity and NaN:
// to write one is our own mistake and throws std::logic_error.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/json/json.hpp"
#include "api/json/layout.hpp"

namespace qdot::api {

/// Significant digits of a number: 1 to 17, or all that it takes.
inline constexpr int shortest_digits = 0;

/// `value` to so many significant decimal digits, as a double.
[[nodiscard]] double rounded(double value, int digits);
/// The least number of so many digits that is no less than `bound`, which is not negative.
[[nodiscard]] double rounded_up(double bound, int digits);

void append_number(std::string& out, double value, int digits = shortest_digits);

/// "text" with quotes and escapes; what is not UTF-8 in it is replaced.
void append_string(std::string& out, std::string_view text);

/// One column of a table: the caller keeps the numbers.
struct Column {
  std::string name;
  std::span<const double> values;
};

/// Writes one document in order, opening and closing as told. Pretty layout puts each member of an object and
/// each object of an array on its own line; an array of numbers stays on one.
class JsonWriter {
 public:
  /// With `wanted`, which has to live as long, of the document's own members only those are written; and of a
  /// table that is one of them, where `wanted` has "/trajectory/theta/100" in its place, that number alone,
  /// with null before and after it.
  explicit JsonWriter(Layout layout, const std::vector<std::string>* wanted = nullptr)
      : layout_(layout), wanted_(wanted) {}

  void begin_object() { open('{'); }
  void end_object() { close('}'); }
  void begin_array() { open('['); }
  void end_array() { close(']'); }
  void key(std::string_view name);

  void number(double value, int digits = shortest_digits);
  /// Numbers that are text already, with more digits than doubles have.
  void number_text(std::string_view digits);
  void number_texts(std::span<const std::string> numbers);
  void string(std::string_view text);
  void numbers(std::span<const double> values, int digits = shortest_digits);
  /// {"t": [...], "theta": [...]}; those that are wanted.
  void columns(std::span<const Column> table, int digits = shortest_digits);
  /// Any value; `digits` holds for every floating-point number in it.
  void value(const Json& json, int digits = shortest_digits);

  /// Whether a member that would come next is written.
  [[nodiscard]] bool wants(std::string_view name) const;

  /// Key and value in one, if it is wanted.
  void member(std::string_view name, const Json& json, int digits = shortest_digits);

  /// Bytes written so far.
  [[nodiscard]] std::size_t size() const { return out_.size(); }

  /// The document, ended by a newline.
  [[nodiscard]] std::string finish() &&;

 private:
  void open(char bracket);
  void close(char bracket);
  void separate();
  void new_line();
  [[nodiscard]] bool is_wanted_whole(std::string_view column) const;
  void wanted_numbers(const Column& column, int digits);

  Layout layout_;
  const std::vector<std::string>* wanted_;
  std::string member_;  ///< of the document's own, the last one
  std::string out_;
  std::vector<bool> has_members_;  ///< for each open bracket
  bool after_key_{false};
};

[[nodiscard]] std::string to_text(const Json& json, Layout layout = Layout::compact);

/// RFC 4180 with LF: a header row of names, then one row for each index. All columns are of one length.
[[nodiscard]] std::string to_csv(std::span<const Column> table, int digits = shortest_digits);

/// One object a row: {"t":0.0,"theta":0.3}
[[nodiscard]] std::string to_ndjson(std::span<const Column> table, int digits = shortest_digits);

}  // namespace qdot::api
