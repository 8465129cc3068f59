#pragma once
// The ranges of a key: numbers that differ from student to student.
//
//   "ranges": {"l": {"from": 0.4, "to": 1.2, "step": 0.05, "unit": "m", "default": 0.5},
//              "angle": {"values": [20, 25, 30], "unit": "deg"}}
//
// In an item's `expect`, a text "$l" becomes "0.45 m"; in a longer one, such as "$ratio*m*g/l", only the
// number is put in, which must have no unit then. Values are decimals as they are written, so that a student
// reads 0.45 and not 0.45000000000000001. Without `step` the step is a power of ten that gives 20 to 200
// values.

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "api/answers/check/sheet_error.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

struct KeyRange {
  std::string name{};
  std::vector<std::string> values{};  ///< decimals, at least one
  std::string unit{};                 ///< empty: a number without one
  std::string original{};             ///< the value of the key as it is; empty: it has none
};

/// Those of a key, in its order; none where it has no `ranges`.
[[nodiscard]] std::variant<std::vector<KeyRange>, SheetError> ranges_of(const Json& key);

/// A chosen value of each range, by name.
using Choice = std::map<std::string, std::string>;

/// The key with the values put in, and without `ranges`: a request of check without what was
/// submitted.
[[nodiscard]] std::variant<Json, SheetError> with_values(const Json& key, const std::vector<KeyRange>& ranges,
                                                         const Choice& choice);

/// The key with the originals put in. A key without ranges is left as it is.
[[nodiscard]] std::variant<Json, SheetError> original_key(const Json& key);

/// "0.45 m"
[[nodiscard]] std::string with_unit(const std::string& value, const KeyRange& range);

}  // namespace qdot::api
