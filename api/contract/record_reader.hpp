#pragma once
// An object read by its FieldSet, and all that is inside it. Every mistake is reported, not only the first,
// and what is read is resolved: defaults filled in, units gone, fields in the order of the set.

#include <optional>
#include <string>
#include <vector>

#include "api/contract/field.hpp"
#include "api/contract/field_values.hpp"
#include "api/contract/system_choice.hpp"

namespace qdot::api {

struct RecordReading {
  Json resolved = Json::object();
  std::vector<std::string> defaulted{};  ///< fields that were left out and have a default
  ExactNumbers exact{};
};

/// The fields of a request. `choice` has its system, if that could be found, and takes what the request says
/// of the system's symbols.
[[nodiscard]] RecordReading read_record(const FieldSet& set, const Json& fields, const Place& place,
                                        SystemChoice& choice, Errors& errors);

/// A record of a document, which speaks of no system. None where the value is no object.
[[nodiscard]] std::optional<Json> read_value(const RecordKind& kind, const std::string& name,
                                             const Json& value, const Place& place, Errors& errors);

}  // namespace qdot::api
