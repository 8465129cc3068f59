#include "api/contract/one_of.hpp"

#include <algorithm>
#include <vector>

#include "api/json/text.hpp"

namespace qdot::api {

bool another_way_is_given(const FieldSet& set, const std::string& name, const Json& object) {
  const auto has = [](const std::vector<std::string>& way, const std::string& field) {
    return std::ranges::find(way, field) != way.end();
  };
  return std::ranges::any_of(set.one_of, [&](const OneOf& one_of) {
    const bool concerned = std::ranges::any_of(one_of.ways, [&](const auto& way) { return has(way, name); });
    return concerned && std::ranges::any_of(one_of.ways, [&](const auto& way) {
             return !has(way, name) &&
                    std::ranges::any_of(way, [&](const auto& f) { return object.contains(f); });
           });
  });
}

void check_ways(const OneOf& one_of, const Json& object, const Place& place, Errors& errors) {
  std::string first;
  std::vector<std::string> openings;
  bool taken = false;
  for (const std::vector<std::string>& way : one_of.ways) {
    openings.push_back("'" + way.front() + "'");
    taken = taken || object.contains(way.front());
    std::string given;
    for (const std::string& field : way) {
      if (!object.contains(field)) continue;
      if (given.empty()) given = field;
      if (first.empty()) continue;
      report(errors,
             place.below(field).error("exclusive", "'" + first + "' and '" + field +
                                                       "' cannot be given together; give one of them."));
    }
    if (first.empty()) first = given;
  }
  if (one_of.need == Need::required && !taken) {
    report(errors, place.error("missing", "One of " + enumerated(openings) + " is missing."));
  }
}

}  // namespace qdot::api
