#include "api/answers/check/submitted_numbers.hpp"

#include <cmath>

#include "api/contract/written_value.hpp"
#include "api/json/text.hpp"
#include "core/numerics/constants.hpp"

namespace qdot::api {
namespace {

constexpr std::size_t most_submitted = 10'000;
constexpr std::size_t longest_list = 200'000;  // bytes

/// Whether a text is a number and nothing else: no unit, no expression.
bool is_bare(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return Number::written(text).has_value();
}

/// "a, b; c" without the brackets around it.
std::vector<std::string> list_of(std::string_view text) {
  text = trimmed(text);
  constexpr std::string_view opening = "([{<", closing = ")]}>";
  const std::size_t kind = text.empty() ? std::string_view::npos : opening.find(text.front());
  const bool has_commas = text.find_first_of(",;") != std::string_view::npos;
  const bool is_bracketed =
      kind != std::string_view::npos && text.size() >= 2 && text.back() == closing[kind];
  if (is_bracketed && (has_commas || kind != 0)) text = text.substr(1, text.size() - 2);
  std::vector<std::string> parts;
  if (trimmed(text).empty()) return parts;
  int depth = 0;
  std::size_t start = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if ((text[i] != ',' && text[i] != ';') || depth != 0) continue;
    parts.emplace_back(trimmed(text.substr(start, i - start)));
    start = i + 1;
  }
  parts.emplace_back(trimmed(text.substr(start)));
  return parts;
}

/// "°" and "²" are as good as "deg" and "^2"; a minus sign is a hyphen.
std::string plain(std::string text) {
  const std::string minus = "\xE2\x88\x92";
  for (std::size_t at = text.find(minus); at != std::string::npos; at = text.find(minus, at)) {
    text.replace(at, minus.size(), "-");
  }
  return text;
}

class NumberReader {
 public:
  explicit NumberReader(UnitRule rule) : rule_(rule) {}

  void read(const Json& submitted, const std::string& unit) {
    if (submitted.is_number()) {
      if (needs_unit(unit)) return fail("Write the unit behind the number.");
      return add(submitted.get<double>());
    }
    if (!submitted.is_string()) return fail("A number is needed here, or a text such as \"55.1deg\".");
    read_text(submitted.get_ref<const std::string&>(), unit);
  }

  void fail(std::string why) { numbers_.unreadable.push_back(std::move(why)); }
  void set_none() { numbers_.is_none = true; }
  [[nodiscard]] SubmittedNumbers take() { return std::move(numbers_); }

 private:
  [[nodiscard]] bool needs_unit(const std::string& unit) const {
    return rule_ == UnitRule::required && unit != "1";
  }

  void add(double value) {
    if (!std::isfinite(value)) return fail("It is beyond double precision.");
    numbers_.values.push_back(value);
  }

  void read_text(const std::string& written, const std::string& unit) {
    if (needs_unit(unit) && is_bare(written)) return fail("Write the unit behind the number.");
    const std::string text = plain(written);
    const bool in_degrees = unit == "deg";
    const double factor = in_degrees && !is_bare(text) ? 180 / pi : 1;
    ParameterScope numbers_only;
    const auto value = written_value(text, in_degrees ? "rad" : unit == "Hz" ? "1/s" : unit, numbers_only);
    if (const auto* error = std::get_if<QuantityError>(&value)) return refuse(*error, written);
    add(std::get<Real>(value).value * factor);
  }

  /// The sentences of a request's reader would say which unit is expected.
  void refuse(const QuantityError& error, const std::string& text) {
    if (error.code == "wrong_dimension") {
      numbers_.wrong_unit = in_quotes(text) + " is another kind of quantity than what is asked for.";
    } else if (error.code == "out_of_range") {
      fail(in_quotes(text) + " is beyond double precision.");
    } else {
      fail(in_quotes(text) + " is not a number with a unit behind it, such as 0.5, \"12 cm\" or \"2*pi/3\".");
    }
  }

  UnitRule rule_;
  SubmittedNumbers numbers_;
};

bool is_none(const Json& submitted) {
  if (submitted.is_null()) return true;
  if (!submitted.is_string()) return false;
  const std::string word = lower_case(trimmed(submitted.get_ref<const std::string&>()));
  return word == "none" || word == "null" || word == "no" || word == "does not exist";
}

/// {"theta": -2, "x": 1} in the order of the names that are expected.
std::optional<Json> in_order(const Json& object, const Pointed& expected, NumberReader& reader) {
  Json list = Json::array();
  for (const PointedValue& value : expected.values) {
    if (!object.contains(value.name)) {
      reader.fail(in_quotes(value.name) + " is missing.");
      return std::nullopt;
    }
    list.push_back(object[value.name]);
  }
  if (object.size() == list.size()) return list;
  reader.fail("There are names that the question does not have.");
  return std::nullopt;
}

std::optional<Json> elements_of(const Json& submitted, const Pointed& expected, NumberReader& reader) {
  if (submitted.is_array()) return submitted;
  if (submitted.is_object()) return in_order(submitted, expected, reader);
  if (submitted.is_number()) return Json::array({submitted});
  if (!submitted.is_string()) return Json::array({submitted});
  const auto& text = submitted.get_ref<const std::string&>();
  if (trimmed(text).empty()) {
    reader.fail("There is no number.");
    return std::nullopt;
  }
  if (text.size() <= longest_list) return Json(list_of(text));
  reader.fail("The list is too long.");
  return std::nullopt;
}

}  // namespace

SubmittedNumbers submitted_numbers(const Json& submitted, const Pointed& expected, UnitRule unit) {
  NumberReader reader(unit);
  if (is_none(submitted)) {
    reader.set_none();
    return reader.take();
  }
  if (!expected.is_list) {
    reader.read(submitted, expected.values.front().unit);
    return reader.take();
  }
  const std::optional<Json> elements = elements_of(submitted, expected, reader);
  if (!elements) return reader.take();
  if (elements->size() > most_submitted) {
    reader.fail("The list has more than 10000 numbers.");
    return reader.take();
  }
  for (std::size_t i = 0; i < elements->size(); ++i) {
    const std::size_t like = std::min(i, expected.values.size() - 1);
    reader.read((*elements)[i], expected.values.empty() ? "1" : expected.values[like].unit);
  }
  return reader.take();
}

}  // namespace qdot::api
