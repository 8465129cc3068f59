#include "api/contract/field_values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "api/contract/domain_text.hpp"
#include "api/contract/meant_option.hpp"
#include "api/contract/names.hpp"
#include "api/json/limits.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"
#include "api/json/writer.hpp"
#include "core/base/work_bounds.hpp"
#include "core/expr/number.hpp"

namespace qdot::api {
namespace {

std::nullopt_t refuse(const Place& place, Errors& errors, std::string code, std::string detail) {
  report(errors, place.error(std::move(code), std::move(detail)));
  return std::nullopt;
}

std::nullopt_t refuse_type(const Place& place, Errors& errors, const std::string& name,
                           const std::string& needed, const Json& value) {
  report(errors, wrong_type(place, name, needed, value));
  return std::nullopt;
}

/// The text, or null after it has reported that this is none of 1 to `most` bytes.
const std::string* text_of(std::size_t most, const std::string& needed, const std::string& name,
                           const Json& value, const Place& place, Errors& errors) {
  if (!value.is_string()) {
    refuse_type(place, errors, name, needed, value);
    return nullptr;
  }
  const auto& text = value.get_ref<const std::string&>();
  if (text.size() > most) {
    refuse(place, errors, "too_long",
           "'" + name + "' has " + std::to_string(text.size()) + " bytes; at most " + std::to_string(most) +
               " are read.");
    return nullptr;
  }
  if (!text.empty()) return &text;
  refuse(place, errors, "empty", "'" + name + "' is empty.");
  return nullptr;
}

std::string number_text(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

/// A decimal that JSON has, as "-1.5e3".
Real real_of(std::string_view decimal) {
  const bool negative = decimal.starts_with('-');
  const Number size = Number::written(decimal.substr(negative ? 1 : 0)).value_or(Number(0));
  return (negative ? -size : size).rounded();
}

constexpr double all_whole = 9007199254740992;  // 2^53: beyond it doubles leave integers out

std::optional<std::int64_t> whole_number(double number) {
  if (!(std::abs(number) <= all_whole) || number != std::trunc(number)) return std::nullopt;
  return static_cast<std::int64_t>(number);
}

/// The number that all of a text is.
template <class Number>
std::optional<Number> only_number(std::string_view text) {
  text = trimmed(text);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

std::optional<std::int64_t> whole_number(const Json& value, Road road) {
  if (value.is_number_unsigned()) {
    const auto number = value.get<std::uint64_t>();
    constexpr std::uint64_t most = std::numeric_limits<std::int64_t>::max();
    return number <= most ? std::optional(static_cast<std::int64_t>(number)) : std::nullopt;
  }
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number_float()) return whole_number(value.get<double>());
  if (road != Road::query) return std::nullopt;
  const auto& text = value.get_ref<const std::string&>();
  if (const auto number = only_number<std::int64_t>(text)) return number;
  const auto decimal = only_number<double>(text);  // "1e3"
  return decimal ? whole_number(*decimal) : std::nullopt;
}

/// A number with more digits than any field takes, 1e30; whole, as every double is that is so large.
std::optional<double> huge_number(const Json& value) {
  const auto number = value.is_string() ? only_number<double>(value.get_ref<const std::string&>())
                                        : std::optional(value.get<double>());
  return number && std::isfinite(*number) && std::abs(*number) > all_whole ? number : std::nullopt;
}

}  // namespace

void report(Errors& errors, FieldError error) {
  if (!is_full(errors)) errors.push_back(std::move(error));
}

bool is_full(const Errors& errors) { return errors.size() > limits::listed_errors; }

FieldError unknown_name(const Place& place, std::string detail, const std::string& name,
                        std::vector<std::string> allowed) {
  FieldError error = place.error("unknown_field", std::move(detail));
  error.did_you_mean = closest(name, allowed);
  error.allowed = std::move(allowed);
  return error;
}

FieldError wrong_type(const Place& place, const std::string& name, const std::string& needed,
                      const Json& value) {
  std::string given = value.is_null() ? "null" : "a " + std::string(value.type_name());
  if (value.is_object() || value.is_array()) given = "an " + std::string(value.type_name());
  const std::string advice = value.is_null() ? "; leave out what has no value" : "";
  return place.error("wrong_type", "'" + name + "' needs " + needed + ", not " + given + advice + ".");
}

std::optional<Json> read_value(const AnyKind&, const std::string&, const Json& value, const Place&, Errors&) {
  return value;
}

FieldError bad_name(const Place& place, std::string_view name, NameOf of) {
  const std::string end =
      of == NameOf::thing ? "no _dot or _ddot at the end" : "at the end _dot for a velocity but no _ddot";
  return place.error("bad_name",
                     in_quotes(name) +
                         " cannot be a name: use at most 64 ASCII letters, digits and underscores after a "
                         "letter, " +
                         end + ", and neither t, pi nor a function's name.");
}

std::optional<Real> read_number(const NumberKind& kind, const std::string& name, const Json& value,
                                const Place& place, ParameterScope& scope, Errors& errors) {
  Real number;
  if (value.is_number()) {
    number = real_of(place.written(value));
  } else if (value.is_string()) {
    const auto quantity = written_value(value.get_ref<const std::string&>(), kind.unit, scope);
    if (const auto* wrong = std::get_if<QuantityError>(&quantity)) {
      FieldError error = place.error(wrong->code, "'" + name + "': " + wrong->detail);
      error.allowed = wrong->allowed;
      error.did_you_mean = wrong->did_you_mean;
      report(errors, std::move(error));
      return std::nullopt;
    }
    number = std::get<Real>(quantity);
  } else {
    const std::string needed =
        kind.unit == "1" ? "a number"
                         : "a number of " + kind.unit + " or a text such as \"1 " + kind.unit + "\"";
    return refuse_type(place, errors, name, needed, value);
  }
  if (!kind.range.contains(number.value)) {
    const std::string unit = kind.unit == "1" ? "" : " " + kind.unit;
    return refuse(place, errors, "out_of_range",
                  "'" + name + "' must be " + to_text(kind.range) + unit + "; it is " +
                      number_text(number.value) + ".");
  }
  return number;
}

std::optional<Json> read_value(const NumberKind& kind, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  ParameterScope numbers_only;
  const std::optional<Real> number = read_number(kind, name, value, place, numbers_only, errors);
  return number ? std::optional<Json>(number->value) : std::nullopt;
}

std::optional<Json> read_value(const IntegerKind& kind, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  if (!value.is_number() && !(value.is_string() && place.road() == Road::query)) {
    return refuse_type(place, errors, name, "a whole number", value);
  }
  const auto out_of_range = [&](const std::string& given) {
    return refuse(place, errors, "out_of_range",
                  "'" + name + "' must be from " + std::to_string(kind.least) + " to " +
                      std::to_string(kind.most) + "; it is " + given + ".");
  };
  const std::optional<std::int64_t> number = whole_number(value, place.road());
  if (!number) {
    if (const auto huge = huge_number(value)) return out_of_range(number_text(*huge));
    return refuse(place, errors, "wrong_type", "'" + name + "' needs a whole number.");
  }
  const bool is_bounded = kind.upper_end == UpperEnd::of_sense || work_bounds() != WorkBounds::none;
  if (*number < kind.least || (is_bounded && *number > kind.most))
    return out_of_range(std::to_string(*number));
  return *number;
}

std::optional<Json> read_value(const BooleanKind&, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  if (value.is_boolean()) return value;
  if (place.road() != Road::query) return refuse_type(place, errors, name, "true or false", value);
  const std::string word = lower_case(value.get_ref<const std::string&>());  // Python says "True"
  if (word == "true" || word == "false") return word == "true";
  return refuse(place, errors, "wrong_type",
                "'" + name + "' needs true or false, not " + in_quotes(word) + ".");
}

std::optional<Json> read_value(const TextKind& kind, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  const std::string* text = text_of(kind.most_bytes, "a string", name, value, place, errors);
  if (text == nullptr) return std::nullopt;
  if (kind.ends == Ends::without_blanks && trimmed(*text).size() != text->size()) {
    // "theta=0+" typed into a URL arrives as "theta=0 ", another event.
    return refuse(place, errors, "syntax",
                  "'" + name + "' begins or ends with a blank" +
                      (place.road() == Road::query ? "; in a URL, + is written %2B." : "."));
  }
  return *text;
}

namespace {

/// The number in a choice's place, "accuracy": 1e-9.
std::optional<double> number_in(const Json& value) {
  if (value.is_number()) return value.get<double>();
  const auto number = value.is_string() ? Number::written(trimmed(value.get_ref<const std::string&>()))
                                        : std::optional<Number>();
  return number ? std::optional(number->value()) : std::optional<double>();
}

/// The field that a number belongs in which stands in the place of `accuracy` or `precision`; empty: none.
std::string field_of_number(const std::string& choice, double number) {
  if (choice != "accuracy" && choice != "precision") return {};
  return number > 0 && number <= 1 ? "max_error" : number > 1 && number <= 31 ? "digits" : "";
}

/// A number in the place of a word; false where that says nothing.
bool refuse_number(const ChoiceKind& kind, const std::string& name, const Json& value, const Place& place,
                   Errors& errors) {
  const auto number = number_in(value);
  const std::string field = number ? field_of_number(name, *number) : "";
  if (field.empty()) return false;
  const std::string digits =
      value.is_string() ? printable(trimmed(value.get_ref<const std::string&>())) : place.written(value);
  FieldError error = place.error(
      "not_allowed", "'" + name + "' is a word. " +
                         (field == "digits" ? "How many digits are written is 'digits'."
                                            : "The error that you accept, as a number, is 'max_error'."));
  error.did_you_mean = place.road() == Road::query ? field + "=" + digits : field;
  error.allowed = kind.options;
  report(errors, std::move(error));
  return true;
}

}  // namespace

std::optional<Json> read_value(const ChoiceKind& kind, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  const auto is_value = [&](const std::string& option) {
    return value.is_string() && value.get_ref<const std::string&>() == option;
  };
  if (std::ranges::any_of(kind.options, is_value)) return value;
  if (refuse_number(kind, name, value, place, errors)) return std::nullopt;
  if (!value.is_string()) return refuse_type(place, errors, name, enumerated(kind.options), value);
  const auto& word = value.get_ref<const std::string&>();
  FieldError error = place.error("not_allowed", "'" + name + "' cannot be " + in_quotes(word) + ".");
  error.did_you_mean = meant_option(word, kind.options);
  if (const std::string list = with_commas(word, kind.options); !list.empty()) {
    error.detail += " Between the words of a list stand commas.";
    error.did_you_mean = list;
  }
  error.allowed = kind.options;
  errors.push_back(std::move(error));
  return std::nullopt;
}

std::optional<Json> read_value(const SignKind&, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  if (!value.is_number()) return refuse_type(place, errors, name, "1 or -1", value);
  const auto sign = value.get<double>();
  if (sign != 1 && sign != -1) return refuse(place, errors, "not_allowed", "'" + name + "' must be 1 or -1.");
  return static_cast<int>(sign);
}

std::optional<Json> read_value(const NameKind& kind, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  if (!value.is_string()) {
    return refuse_type(place, errors, name, "a name in text, such as \"theta\"", value);
  }
  const auto& text = value.get_ref<const std::string&>();
  if (is_name(text, kind.of)) return value;
  report(errors, bad_name(place, text, kind.of));
  return std::nullopt;
}

std::optional<Json> read_value(const ExpressionKind&, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  if (value.is_number()) return place.written(value);
  const std::string* text = text_of(limits::expression_bytes, "an expression, such as \"-l*cos(theta)\"",
                                    name, value, place, errors);
  return text == nullptr ? std::nullopt : std::optional<Json>(*text);
}

std::optional<Json> read_value(const DomainKind&, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  if (!value.is_string()) {
    return refuse_type(place, errors, name, "a domain in text, such as \"> 0\"", value);
  }
  const auto& text = value.get_ref<const std::string&>();
  if (parse_domain(text)) return value;
  return refuse(place, errors, "domain",
                "The domain " + in_quotes(text) +
                    " names no interval; write a bound or two, such as '> 0' or '>= 0, < 1'.");
}

}  // namespace qdot::api
