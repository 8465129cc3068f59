#pragma once
// What is said of a field that a request or a document has and its FieldSet has not: the names that can be
// given, the one that was probably meant, and where the thing belongs that it speaks of.

#include <string>
#include <vector>

#include "api/contract/field.hpp"
#include "api/contract/submission.hpp"

namespace qdot::api {

/// The names that can be given, for the list in an error. A query has a system's symbols among the fields;
/// `scene` is null where there is no system, or none is known.
[[nodiscard]] std::vector<std::string> field_names(const FieldSet& set, const Scene* scene, Road road);

/// The error unknown_field of `name`, which `object` has with `value`.
[[nodiscard]] FieldError unknown_field(const FieldSet& set, const Scene* scene, const std::string& name,
                                       const Json& value, const Place& object);

}  // namespace qdot::api
