#pragma once
// What a sweep collects: a value of each row's answer, by JSON Pointer.

#include <optional>
#include <string>
#include <vector>

#include "api/contract/field_values.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

struct CollectedColumn {
  std::string name{};
  std::string pointer{};
};

/// Columns by name; a pointer without a name is called by its last part that is no index. `taken` are names
/// that columns have already. `answer_schema` is that of the answers: a place that they never have is
/// refused. None after errors were reported.
[[nodiscard]] std::optional<std::vector<CollectedColumn>> read_columns(const Json& collect,
                                                                       const std::vector<std::string>& taken,
                                                                       const Json& answer_schema,
                                                                       const Place& place, Errors& errors);

/// What of an answer `collected` looks at: its members by name, numbers of a trajectory by pointer, and
/// formulas; empty: all of it.
[[nodiscard]] std::vector<std::string> members_read(const std::vector<CollectedColumn>& columns);

/// One value of one answer, or why there is none.
struct CollectedValue {
  Json value{};
  std::string unit{};
  std::string reason{};  ///< why there is none; empty beside a null that the answer has for its value
};

[[nodiscard]] CollectedValue collected(const Json& answer, const CollectedColumn& column);

}  // namespace qdot::api
