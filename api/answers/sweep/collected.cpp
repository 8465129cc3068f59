#include "api/answers/sweep/collected.hpp"

#include <algorithm>

#include "api/answers/check/pointed_values.hpp"
#include "api/answers/sweep/schema_place.hpp"
#include "api/contract/names.hpp"
#include "api/json/limits.hpp"
#include "api/json/pointer.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

constexpr std::size_t longest_pointer = 200;

/// "/modes/0/omega" is called omega.
std::string name_of_pointer(std::string_view pointer) {
  while (!pointer.empty()) {
    const std::size_t slash = pointer.rfind('/');
    const std::string_view last = pointer.substr(slash == std::string_view::npos ? 0 : slash + 1);
    if (!is_made_of_digits(last) || slash == std::string_view::npos) return std::string(last);
    pointer = pointer.substr(0, slash);
  }
  return {};
}

class ColumnReader {
 public:
  ColumnReader(std::vector<std::string> taken, const Json& schema, Errors& errors)
      : taken_(std::move(taken)), schema_(schema), errors_(errors) {}

  void read(std::string name, const Json& pointer, const Place& place) {
    if (!pointer.is_string() || pointer.get_ref<const std::string&>().size() > longest_pointer) {
      report(errors_, wrong_type(place, "collect", "a pointer such as \"/modes/0/omega\"", pointer));
      return;
    }
    const auto& text = pointer.get_ref<const std::string&>();
    if (name.empty()) name = name_of_pointer(text);
    if (!is_name(name, NameOf::thing_or_velocity)) {
      report(errors_, bad_name(place, name));
    } else if (std::ranges::find(taken_, name) != taken_.end()) {
      report(errors_, place.error("duplicate_name", "Another column is called " + in_quotes(name) +
                                                        "; give this one a name, {\"name\": \"/pointer\"}."));
    } else if (auto problem = place_in_schema(schema_, text, place)) {
      report(errors_, std::move(*problem));
    }
    taken_.push_back(name);
    columns_.push_back({std::move(name), text});
  }

  [[nodiscard]] std::vector<CollectedColumn> take() { return std::move(columns_); }

 private:
  std::vector<std::string> taken_;
  const Json& schema_;
  Errors& errors_;
  std::vector<CollectedColumn> columns_;
};

/// "/a, /b" in a query.
std::vector<std::string> parted(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.emplace_back(trimmed(std::string_view(text).substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

/// Why an object says that its member is null or missing; empty where it does not.
std::string reason_in(const Json& object, const std::string& member) {
  const auto reason = object.find("reason");
  if (reason == object.end()) return "";
  if (reason->is_string()) return reason->get<std::string>();
  const bool is_told = reason->is_object() && reason->contains(member) && (*reason)[member].is_string();
  return is_told ? (*reason)[member].get<std::string>() : "";
}

/// The nearest reason above a place.
std::string reason_above(const Json& answer, const std::string& pointer) {
  std::string nearest;
  const Json* here = &answer;
  for (const std::string& step : steps_of(pointer).value_or(std::vector<std::string>())) {
    if (here->is_object())
      if (std::string reason = reason_in(*here, step); !reason.empty()) nearest = std::move(reason);
    here = child_at(*here, step);
    if (here == nullptr) break;
  }
  return nearest;
}

}  // namespace

std::optional<std::vector<CollectedColumn>> read_columns(const Json& collect,
                                                         const std::vector<std::string>& taken,
                                                         const Json& answer_schema, const Place& place,
                                                         Errors& errors) {
  const std::size_t before = errors.size();
  ColumnReader reader(taken, answer_schema, errors);
  const std::size_t count = collect.is_structured() ? collect.size() : 1;
  if (count == 0 || count > limits::sweep_columns) {
    report(errors,
           place.error(count == 0 ? "empty" : "too_many",
                       "1 to " + std::to_string(limits::sweep_columns) + " values are collected of a row."));
  } else if (collect.is_object()) {
    for (const auto& [name, pointer] : collect.items()) reader.read(name, pointer, place.below(name));
  } else if (collect.is_array()) {
    for (std::size_t i = 0; i < count; ++i) reader.read("", collect[i], place.below(i));
  } else if (collect.is_string()) {
    for (const std::string& pointer : parted(collect.get<std::string>())) reader.read("", pointer, place);
  } else {
    report(errors, wrong_type(place, "collect", "an object of pointers", collect));
  }
  return errors.size() == before ? std::optional(reader.take()) : std::nullopt;
}

std::vector<std::string> members_read(const std::vector<CollectedColumn>& columns) {
  std::vector<std::string> members{"units", "reason"};
  for (const CollectedColumn& column : columns) {
    const std::string first = column.pointer.substr(1, column.pointer.find('/', 1) - 1);
    // Escaped; or what an answer says about its other members.
    if (first.find('~') != std::string::npos || first == "units" || first == "reason") return {};
    // Of a trajectory, which is long, the numbers themselves; * is every element of an array.
    const bool is_part = first == "trajectory" && column.pointer.size() > first.size() + 1 &&
                         column.pointer.find('*') == std::string::npos;
    members.push_back(is_part ? column.pointer : first);
    if (column.pointer.find("/exact") != std::string::npos) members.emplace_back("exact");
  }
  return members;
}

CollectedValue collected(const Json& answer, const CollectedColumn& column) {
  Errors errors;
  const auto found = pointed(answer, column.pointer, Place(Road::body), errors);
  if (!found) {
    std::string reason = reason_above(answer, column.pointer);
    if (reason.empty()) reason = "The answer has nothing at " + in_quotes(column.pointer) + ".";
    return {.reason = std::move(reason)};
  }
  if (found->is_list || found->values.size() != 1)
    return {.reason = "There is more than one value at " + in_quotes(column.pointer) + "."};
  const PointedValue& value = found->values.front();
  if (value.value.is_null()) return {.reason = reason_above(answer, column.pointer)};
  return {.value = value.value, .unit = value.unit};
}

}  // namespace qdot::api
