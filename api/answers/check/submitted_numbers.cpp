#include "api/answers/check/submitted_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "api/answers/check/number_lists.hpp"
#include "api/contract/written_value.hpp"
#include "api/json/text.hpp"
#include "api/json/writer.hpp"
#include "core/base/error.hpp"
#include "core/mechanics/units.hpp"
#include "core/numerics/constants.hpp"

namespace qdot::api {
namespace {

constexpr std::size_t longest_list = 200'000;  // bytes

/// Whether a text is a number and nothing else: no unit, no expression.
bool is_bare(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return Number::written(text).has_value();
}

/// "sqrt(9.81/0.8) rad/s" as a number with that unit; the text itself where nothing is to be evaluated.
std::string with_value_for_expression(const std::string& text) {
  const std::size_t unit = unit_behind(text);
  if (unit == std::string::npos) return text;
  std::string_view head = trimmed(std::string_view(text).substr(0, unit));
  if (head.ends_with('*')) head.remove_suffix(1);
  ParameterScope numbers_only;
  const auto value = written_value(trimmed(head), "1", numbers_only);
  const auto* real = std::get_if<Real>(&value);
  if (real == nullptr || is_bare(head)) return text;
  std::string number;
  append_number(number, real->value);
  return number + " " + text.substr(unit);
}

/// "0.5, 30 deg": whether the unit behind the last number alone is of another scale than the rest.
bool has_unit_at_last_only(const std::vector<WrittenNumber>& numbers) {
  const auto is_number = [](const WrittenNumber& n) { return is_bare(n.text); };
  if (numbers.size() < 2 || is_number(numbers.back())) return false;
  if (!std::all_of(numbers.begin(), numbers.end() - 1, is_number)) return false;
  const auto is_zero = [](const WrittenNumber& n) {
    return n.text.find_first_of("123456789") == std::string::npos;
  };
  if (std::all_of(numbers.begin(), numbers.end() - 1, is_zero)) return false;
  const std::string& last = numbers.back().text;
  const std::size_t begin = unit_behind(last);
  const auto unit =
      begin == std::string::npos ? std::nullopt : parse_unit(std::string_view(last).substr(begin));
  return unit && !unit->is_coherent();
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
    try {
      const std::string plain = number_without_latex(submitted.get_ref<const std::string&>());
      read(written_number(plain, Commas::are_decimal), unit);
    } catch (const Error& error) {
      fail("It cannot be read: " + std::string(error.what()) + ".");
    }
  }

  void read(const WrittenNumber& written, const std::string& unit) {
    written.refused.empty() ? read_text(written.text, unit) : fail(written.refused);
  }

  void fail(std::string why) {
    constexpr std::size_t most = 5;
    if (numbers_.unreadable.size() < most) numbers_.unreadable.push_back(std::move(why));
  }
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
    const bool in_degrees = unit == "deg";
    const double factor = in_degrees && !is_bare(written) ? 180 / pi : 1;
    const std::string expected = in_degrees ? "rad" : unit == "Hz" ? "1/s" : unit;
    ParameterScope numbers_only;
    auto value = written_value(written, expected, numbers_only);
    if (std::holds_alternative<QuantityError>(value))
      value = written_value(with_value_for_expression(written), expected, numbers_only);
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
  return Json::array({submitted});
}

const std::string& unit_at(const Pointed& expected, std::size_t i) {
  static const std::string none = "1";
  return expected.values.empty() ? none : expected.values[std::min(i, expected.values.size() - 1)].unit;
}

/// The numbers in the order of the names that are expected, where each says which it is.
void put_in_order(std::vector<WrittenNumber>& numbers, const Pointed& expected) {
  std::vector<WrittenNumber> ordered;
  for (const PointedValue& value : expected.values) {
    const auto is_it = [&](const WrittenNumber& n) { return n.name == value.name; };
    if (std::ranges::count_if(numbers, is_it) != 1) return;
    ordered.push_back(*std::ranges::find_if(numbers, is_it));
  }
  if (ordered.size() == numbers.size()) numbers = std::move(ordered);
}

void read_list(const std::string& text, const Pointed& expected, NumberReader& reader) {
  if (trimmed(text).empty()) return reader.fail("There is no number.");
  if (text.size() > longest_list) return reader.fail("The list is too long.");
  try {
    std::vector<WrittenNumber> numbers = written_numbers(text, expected.values.size());
    const bool is_bracketed = text.find_first_of("([{<") != std::string::npos;
    if (numbers.empty() && !is_bracketed) return reader.fail("There is no number.");
    if (has_unit_at_last_only(numbers)) return reader.fail("Write the unit behind every number.");
    put_in_order(numbers, expected);
    for (std::size_t i = 0; i < numbers.size(); ++i) reader.read(numbers[i], unit_at(expected, i));
  } catch (const Error& error) {
    reader.fail("It cannot be read: " + std::string(error.what()) + ".");
  }
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
  if (submitted.is_string()) {
    read_list(submitted.get_ref<const std::string&>(), expected, reader);
    return reader.take();
  }
  const std::optional<Json> elements = elements_of(submitted, expected, reader);
  if (!elements) return reader.take();
  if (elements->size() > most_submitted) {
    reader.fail("The list has more than 10000 numbers.");
    return reader.take();
  }
  for (std::size_t i = 0; i < elements->size(); ++i) reader.read((*elements)[i], unit_at(expected, i));
  return reader.take();
}

}  // namespace qdot::api
