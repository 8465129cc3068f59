#include "api/contract/field_values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "api/contract/units.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

std::nullopt_t refuse(const Place& place, Errors& errors, std::string code, std::string detail) {
  errors.push_back(place.error(std::move(code), std::move(detail)));
  return std::nullopt;
}

/// "'samples' needs a whole number, not a string."
std::nullopt_t refuse_type(const Place& place, Errors& errors, const std::string& name,
                           const std::string& needed, const Json& value) {
  std::string given = value.is_null() ? "null" : "a " + std::string(value.type_name());
  if (value.is_object() || value.is_array()) given = "an " + std::string(value.type_name());
  return refuse(place, errors, "wrong_type", "'" + name + "' needs " + needed + ", not " + given + ".");
}

std::string number_text(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::optional<std::int64_t> whole_number(const Json& value, Road road) {
  constexpr double exact = 9007199254740992;  // 2^53: beyond it doubles leave integers out
  if (value.is_number_unsigned()) {
    const auto number = value.get<std::uint64_t>();
    return static_cast<std::int64_t>(
        std::min<std::uint64_t>(number, std::numeric_limits<std::int64_t>::max()));
  }
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number_float()) {
    const auto number = value.get<double>();
    if (std::abs(number) > exact || number != std::trunc(number)) return std::nullopt;
    return static_cast<std::int64_t>(number);
  }
  if (road != Road::query) return std::nullopt;
  const std::string_view text = trimmed(value.get_ref<const std::string&>());
  std::int64_t number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// The elements of a query's list: commas inside parentheses do not part them.
Json split_list(std::string_view text) {
  Json elements = Json::array();
  int depth = 0;
  std::size_t start = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (text[i] == ',' && depth == 0) {
      elements.push_back(trimmed(text.substr(start, i - start)));
      start = i + 1;
    }
  }
  if (!trimmed(text).empty()) elements.push_back(trimmed(text.substr(start)));
  return elements;
}

}  // namespace

std::optional<Json> read_value(const NumberKind& kind, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  double number{};
  if (value.is_number()) {
    number = value.get<double>();
  } else if (value.is_string()) {
    const auto quantity = parse_quantity(value.get_ref<const std::string&>(), kind.unit);
    if (const auto* error = std::get_if<QuantityError>(&quantity)) {
      return refuse(place, errors, error->code, "'" + name + "': " + error->detail);
    }
    number = std::get<double>(quantity);
  } else {
    const std::string needed = kind.unit == "1" ? "a number" : "a number of " + kind.unit;
    return refuse_type(place, errors, name, needed, value);
  }
  if (!kind.range.contains(number)) {
    const std::string unit = kind.unit == "1" ? "" : " " + kind.unit;
    return refuse(
        place, errors, "out_of_range",
        "'" + name + "' must be " + to_text(kind.range) + unit + "; it is " + number_text(number) + ".");
  }
  return number + 0.0;  // -0.0 means 0
}

std::optional<Json> read_value(const IntegerKind& kind, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  if (!value.is_number() && !(value.is_string() && place.road() == Road::query)) {
    return refuse_type(place, errors, name, "a whole number", value);
  }
  const std::optional<std::int64_t> number = whole_number(value, place.road());
  if (!number) return refuse(place, errors, "wrong_type", "'" + name + "' needs a whole number.");
  if (*number < kind.least || *number > kind.most) {
    return refuse(place, errors, "out_of_range",
                  "'" + name + "' must be from " + std::to_string(kind.least) + " to " +
                      std::to_string(kind.most) + "; it is " + std::to_string(*number) + ".");
  }
  return *number;
}

std::optional<Json> read_value(const BooleanKind&, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  if (value.is_boolean()) return value;
  if (place.road() == Road::query && (value == "true" || value == "false")) return value == "true";
  return refuse_type(place, errors, name, "true or false", value);
}

std::optional<Json> read_value(const TextKind& kind, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  if (!value.is_string()) return refuse_type(place, errors, name, "a string", value);
  const auto& text = value.get_ref<const std::string&>();
  if (text.size() > kind.most_bytes) {
    return refuse(place, errors, "too_long",
                  "'" + name + "' has " + std::to_string(text.size()) + " bytes; at most " +
                      std::to_string(kind.most_bytes) + " are read.");
  }
  if (text.empty()) return refuse(place, errors, "syntax", "'" + name + "' is empty.");
  if (trimmed(text).size() != text.size()) {
    // "theta=0+" typed into a URL arrives as "theta=0 ", another event.
    return refuse(place, errors, "syntax",
                  "'" + name + "' begins or ends with a blank" +
                      (place.road() == Road::query ? "; in a URL, + is written %2B." : "."));
  }
  return value;
}

std::optional<Json> read_value(const ChoiceKind& kind, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  if (!value.is_string()) return refuse_type(place, errors, name, enumerated(kind.options), value);
  const auto& word = value.get_ref<const std::string&>();
  if (std::ranges::find(kind.options, word) != kind.options.end()) return value;
  FieldError error = place.error("not_allowed", "'" + name + "' cannot be " + in_quotes(word) + ".");
  error.did_you_mean = closest(word, kind.options);
  error.allowed = kind.options;
  errors.push_back(std::move(error));
  return std::nullopt;
}

std::optional<Json> read_value(const ListKind& kind, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  const bool from_query = place.road() == Road::query && value.is_string();
  if (!from_query && !value.is_array()) return refuse_type(place, errors, name, "an array", value);
  const Json elements = from_query ? split_list(value.get_ref<const std::string&>()) : value;
  if (elements.size() > kind.most) {
    return refuse(place, errors, "too_many",
                  "'" + name + "' has " + std::to_string(elements.size()) + " entries; at most " +
                      std::to_string(kind.most) + " are read.");
  }
  const bool is_set = std::holds_alternative<ChoiceKind>(kind.element);
  Json result = Json::array();
  bool complete = true;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Place here = place.below(i);
    std::optional<Json> element = std::visit(
        [&](const auto& k) { return read_value(k, name, elements[i], here, errors); }, kind.element);
    if (element && is_set && std::ranges::find(result, *element) != result.end()) {
      element = refuse(here, errors, "duplicate_item", "'" + name + "' has " + element->dump() + " twice.");
    }
    complete = complete && element;
    if (element) result.push_back(std::move(*element));
  }
  return complete ? std::optional(std::move(result)) : std::nullopt;
}

std::string to_text(const Domain& domain) {
  std::string text;
  if (std::isfinite(domain.lower)) text += (domain.lower_open ? "> " : ">= ") + number_text(domain.lower);
  if (std::isfinite(domain.upper)) {
    text += (text.empty() ? "" : " and ") + std::string(domain.upper_open ? "< " : "<= ") +
            number_text(domain.upper);
  }
  return text;
}

std::string enumerated(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

}  // namespace qdot::api
