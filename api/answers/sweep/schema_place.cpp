#include "api/answers/sweep/schema_place.hpp"

#include <regex.h>

#include <stdexcept>
#include <string_view>
#include <vector>

#include "api/contract/field_values.hpp"
#include "api/json/pointer.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

bool has_type(const Json& schema, std::string_view type) {
  const auto types = schema.find("type");
  if (types == schema.end()) return true;
  if (types->is_string()) return *types == type;
  for (const Json& one : *types)
    if (one == type) return true;
  return false;
}

/// Whether an extended regular expression of POSIX is found in `text`: the standard library's are templates,
/// of three seconds of compiling.
bool is_found(const std::string& pattern, const std::string& text) {
  if (text.find('\0') != std::string::npos) return false;  // for POSIX the text would end there
  regex_t compiled;
  if (::regcomp(&compiled, pattern.c_str(), REG_EXTENDED | REG_NOSUB) != 0)
    throw std::logic_error("a schema's pattern is no regular expression: " + pattern);
  const bool is_match = ::regexec(&compiled, text.c_str(), 0, nullptr, 0) == 0;
  ::regfree(&compiled);
  return is_match;
}

/// What a schema and its branches say of the members of an object.
struct KnownMembers {
  std::vector<std::pair<std::string, Json>> by_name;
  std::vector<std::pair<std::string, Json>> by_pattern;
  bool are_open{false};  ///< others may be there

  void add(const Json& schema) {
    if (!schema.is_object() || schema.contains("$ref")) are_open = true;
    if (!schema.is_object()) return;
    add_members(schema, "properties", by_name);
    add_members(schema, "patternProperties", by_pattern);
    const auto others = schema.find("additionalProperties");
    are_open = are_open || (others != schema.end() && *others != false);
    for (const char* branches : {"oneOf", "anyOf", "allOf"}) {
      if (!schema.contains(branches)) continue;
      for (const Json& branch : schema[branches]) add(branch);
    }
    for (const char* branch : {"then", "else"})
      if (schema.contains(branch)) add(schema[branch]);
  }

  static void add_members(const Json& schema, const char* key,
                          std::vector<std::pair<std::string, Json>>& members) {
    if (!schema.contains(key)) return;
    for (const auto& [name, part] : schema[key].items()) members.emplace_back(name, part);
  }

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& [name, schema] : by_name) result.push_back(name);
    return result;
  }
};

class Follower {
 public:
  Follower(const std::string& pointer, const Place& place) : pointer_(pointer), place_(place) {}

  std::optional<FieldError> follow(const Json& schema, const std::vector<std::string>& steps,
                                   std::size_t next) const {
    if (!schema.is_object() || schema.contains("$ref")) return std::nullopt;
    if (next == steps.size()) return end_at(schema);
    if (schema.contains("items") && has_type(schema, "array")) {
      if (is_made_of_digits(steps[next])) return follow(schema["items"], steps, next + 1);
      return nothing({"0", "1"}, "");
    }
    return follow_member(schema, steps, next);
  }

 private:
  std::optional<FieldError> end_at(const Json& schema) const {
    const bool is_list =
        schema.contains("type") && (is_text(schema["type"], "object") || is_text(schema["type"], "array"));
    if (!is_list) return std::nullopt;
    return place_.error("wrong_place", "At " + in_quotes(pointer_) +
                                           " answers have an object or an array; point to one value in it.");
  }

  std::optional<FieldError> follow_member(const Json& schema, const std::vector<std::string>& steps,
                                          std::size_t next) const {
    KnownMembers members;
    members.add(schema);
    if (!has_type(schema, "object")) return nothing({}, "");
    if (members.by_name.empty() && members.by_pattern.empty()) return std::nullopt;
    std::optional<FieldError> problem;
    bool is_known = false;
    const auto try_member = [&](const Json& member) {
      auto found = follow(member, steps, next + 1);
      if (!is_known || !found) problem = std::move(found);
      is_known = true;
    };
    for (const auto& [name, member] : members.by_name)
      if (name == steps[next]) try_member(member);
    for (const auto& [pattern, member] : members.by_pattern)
      if (is_found(pattern, steps[next])) try_member(member);
    if (is_known || members.are_open) return problem;
    return nothing(members.names(), steps[next]);
  }

  FieldError nothing(std::vector<std::string> allowed, const std::string& step) const {
    FieldError error = unknown_name(place_, "Answers have nothing at " + in_quotes(pointer_) + ".", step,
                                    std::move(allowed));
    error.code = "unknown_place";
    return error;
  }

  const std::string& pointer_;
  const Place& place_;
};

}  // namespace

std::optional<FieldError> place_in_schema(const Json& schema, const std::string& pointer,
                                          const Place& place) {
  const auto steps = steps_of(pointer);
  if (!steps) return place.error("syntax", "A pointer looks like '/theta_max' or '/modes/0/omega'.");
  for (const std::string& step : *steps) {
    if (step == "*") return place.error("syntax", "A sweep collects one value of a row: no '*' here.");
    // No member of an answer is called by a number.
    if (is_made_of_digits(step) && !index_of(step))
      return place.error("unknown_place", "Answers have nothing at " + in_quotes(pointer) +
                                              ": no list has an index " + in_quotes(step) +
                                              "; they count 0, 1, 2 and so on.");
  }
  return Follower(pointer, place).follow(schema, *steps, 0);
}

}  // namespace qdot::api
