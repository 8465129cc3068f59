#include "api/answers/check/ranges.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <set>

#include "api/json/documents.hpp"
#include "api/json/text.hpp"
#include "core/mechanics/units.hpp"

namespace qdot::api {
namespace {

constexpr std::size_t most_values_of_range = 1000;
constexpr int most_places = 12;
constexpr std::int64_t largest_digits = 1'000'000'000'000;

/// digits * 10^-places
struct PlainDecimal {
  std::int64_t digits{};
  int places{};
};

std::int64_t power_of_ten(int n) { return n <= 0 ? 1 : 10 * power_of_ten(n - 1); }

/// A JSON number as it is written in the shortest way. None for one that is no plain decimal of a dozen
/// digits.
std::optional<PlainDecimal> plain_decimal(const Json& number) {
  if (!number.is_number()) return std::nullopt;
  const std::string text = dump_json(number);
  PlainDecimal result;
  bool is_fraction = false;
  for (const char c : text.substr(text.front() == '-' ? 1 : 0)) {
    if (c == '.' && !is_fraction) {
      is_fraction = true;
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0 && result.digits < largest_digits) {
      result.digits = 10 * result.digits + (c - '0');
      if (is_fraction) ++result.places;
    } else {
      return std::nullopt;
    }
  }
  for (; result.places > 0 && result.digits % 10 == 0; --result.places) result.digits /= 10;
  if (text.front() == '-') result.digits = -result.digits;
  return result.places <= most_places ? std::optional(result) : std::nullopt;
}

/// With `places` digits behind the point, where that is not fewer than it has; beyond 10^18 none.
std::optional<std::int64_t> digits_with(const PlainDecimal& decimal, int places) {
  const std::int64_t factor = power_of_ten(places - decimal.places);
  if (std::abs(decimal.digits) > 1'000'000'000'000'000'000 / factor) return std::nullopt;
  return decimal.digits * factor;
}

std::string decimal_text(std::int64_t digits, int places) {
  std::string text = std::to_string(std::abs(digits));
  if (places > 0) {
    const auto shown = static_cast<std::size_t>(places);
    if (text.size() <= shown) text.insert(0, shown + 1 - text.size(), '0');
    text.insert(text.size() - shown, ".");
  }
  return (digits < 0 ? "-" : "") + text;
}

/// A number as students read it; nothing for what is none.
std::string written_decimal(const Json& number) {
  const auto decimal = plain_decimal(number);
  return decimal ? decimal_text(decimal->digits, decimal->places) : "";
}

/// The largest power of ten that divides from..to into at least 20 steps.
std::optional<PlainDecimal> usual_step(const PlainDecimal& from, const PlainDecimal& to) {
  PlainDecimal step{.digits = 1, .places = std::max(from.places, to.places)};
  const auto first = digits_with(from, step.places), last = digits_with(to, step.places);
  if (!first || !last || *last <= *first) return std::nullopt;
  std::int64_t width = *last - *first;
  while (width / step.digits >= 200) step.digits *= 10;
  for (; width < 20 && step.places < most_places; ++step.places) width *= 10;
  return step;
}

std::optional<std::vector<std::string>> stepped_values(const Json& range) {
  const auto from = plain_decimal(range.value("from", Json()));
  const auto to = plain_decimal(range.value("to", Json()));
  if (!from || !to) return std::nullopt;
  const auto step = range.contains("step") ? plain_decimal(range["step"]) : usual_step(*from, *to);
  if (!step || step->digits <= 0) return std::nullopt;
  const int places = std::max({from->places, to->places, step->places});
  const auto first = digits_with(*from, places), last = digits_with(*to, places),
             width = digits_with(*step, places);
  if (!first || !last || !width || *last < *first) return std::nullopt;
  if ((*last - *first) / *width >= static_cast<std::int64_t>(most_values_of_range)) return std::nullopt;
  std::vector<std::string> values;
  for (std::int64_t digits = *first; digits <= *last; digits += *width)
    values.push_back(decimal_text(digits, places));
  return values;
}

std::optional<std::vector<std::string>> listed_values(const Json& list) {
  if (!list.is_array() || list.empty() || list.size() > most_values_of_range) return std::nullopt;
  std::vector<std::string> values;
  for (const Json& value : list) {
    values.push_back(written_decimal(value));
    if (values.back().empty()) return std::nullopt;
  }
  return values;
}

bool is_range_name(const std::string& text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

std::variant<KeyRange, SheetError> range_of(const std::string& name, const Json& json) {
  const std::string place = "ranges/" + printable(name);
  if (!is_range_name(name)) return SheetError{place + " needs a name of letters, digits and _"};
  if (!json.is_object()) return SheetError{place + " needs an object, such as {\"from\": 0.4, \"to\": 1.2}"};
  const std::vector<std::string> known{"from", "to", "step", "values", "unit", "default"};
  for (const auto& [key, value] : json.items()) {
    if (std::ranges::find(known, key) == known.end())
      return SheetError{place + " has no " + in_quotes(key) + ", only " + enumerated(known)};
  }
  const bool is_list = json.contains("values");
  if (is_list && (json.contains("from") || json.contains("to") || json.contains("step")))
    return SheetError{place + " has either 'values' or 'from' and 'to'"};
  auto values = is_list ? listed_values(json["values"]) : stepped_values(json);
  if (!values) {
    return SheetError{place +
                      (is_list ? "/values needs 1 to 1000 plain decimals"
                               : " needs plain decimals 'from' and 'to', and a positive 'step' that gives "
                                 "1 to 1000 values")};
  }
  KeyRange range{.name = name, .values = std::move(*values)};
  if (json.contains("unit")) {
    if (!json["unit"].is_string() || !parse_unit(json["unit"].get_ref<const std::string&>()))
      return SheetError{place + "/unit needs a unit, such as \"m\" or \"deg\""};
    range.unit = json["unit"].get<std::string>();
  }
  if (json.contains("default")) {
    range.original = written_decimal(json["default"]);
    if (range.original.empty()) return SheetError{place + "/default needs a plain decimal"};
  }
  return range;
}

/// Texts in which $name stands for a value.
class Filling {
 public:
  Filling(const std::vector<KeyRange>& ranges, const Choice& choice) : ranges_(ranges), choice_(choice) {}

  void fill(Json& value) {
    if (value.is_string()) {
      value = filled(value.get<std::string>());
    } else if (value.is_structured()) {
      for (Json& part : value) fill(part);
    }
  }

  /// The first thing that is wrong; empty where nothing is.
  [[nodiscard]] std::string wrong() const {
    if (!wrong_.empty()) return wrong_;
    for (const KeyRange& range : ranges_) {
      if (!used_.contains(range.name)) return "no item has $" + range.name + " in what it expects";
    }
    return "";
  }

 private:
  std::string filled(const std::string& text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
      if (text[at] != '$') {
        result += text[at++];
        continue;
      }
      std::size_t end = at + 1;
      while (end < text.size() &&
             (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_'))
        ++end;
      const bool is_all = at == 0 && end == text.size();
      result += value_of(text.substr(at + 1, end - at - 1), is_all);
      at = end;
    }
    return result;
  }

  std::string value_of(const std::string& name, bool is_all) {
    const auto range = std::ranges::find(ranges_, name, &KeyRange::name);
    if (range == ranges_.end()) {
      complain("there is no range for $" + printable(name));
      return "";
    }
    used_.insert(name);
    const std::string& value = choice_.at(name);
    if (is_all) return with_unit(value, *range);
    if (!range->unit.empty()) complain("$" + name + " has a unit, so it has to stand alone in its text");
    return value.starts_with('-') ? "(" + value + ")" : value;
  }

  void complain(std::string why) {
    if (wrong_.empty()) wrong_ = std::move(why);
  }

  const std::vector<KeyRange>& ranges_;
  const Choice& choice_;
  std::set<std::string> used_;
  std::string wrong_;
};

}  // namespace

std::string with_unit(const std::string& value, const KeyRange& range) {
  return range.unit.empty() ? value : value + " " + range.unit;
}

std::variant<std::vector<KeyRange>, SheetError> ranges_of(const Json& key) {
  std::vector<KeyRange> ranges;
  if (!key.contains("ranges")) return ranges;
  if (!key["ranges"].is_object()) return SheetError{"'ranges' needs an object: a range for each name"};
  for (const auto& [name, json] : key["ranges"].items()) {
    auto range = range_of(name, json);
    if (auto* error = std::get_if<SheetError>(&range)) return std::move(*error);
    ranges.push_back(std::move(std::get<KeyRange>(range)));
  }
  return ranges;
}

std::variant<Json, SheetError> with_values(const Json& key, const std::vector<KeyRange>& ranges,
                                           const Choice& choice) {
  Json filled = key;
  filled.erase("ranges");
  Filling filling(ranges, choice);
  if (filled.contains("items") && filled["items"].is_array()) {
    for (Json& item : filled["items"]) {
      if (item.is_object() && item.contains("expect")) filling.fill(item["expect"]);
    }
  }
  if (const std::string why = filling.wrong(); !why.empty()) return SheetError{why};
  return filled;
}

std::variant<Json, SheetError> original_key(const Json& key) {
  if (!key.contains("ranges")) return key;
  const auto ranges = ranges_of(key);
  if (const auto* error = std::get_if<SheetError>(&ranges)) return *error;
  Choice choice;
  for (const KeyRange& range : std::get<std::vector<KeyRange>>(ranges)) {
    if (range.original.empty()) {
      return SheetError{"the range " + in_quotes(range.name) +
                        " has no default: draw a variant of the key first, qdot variant KEY --seed 1"};
    }
    choice[range.name] = range.original;
  }
  return with_values(key, std::get<std::vector<KeyRange>>(ranges), choice);
}

}  // namespace qdot::api
