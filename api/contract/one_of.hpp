#pragma once
// Fields of which one says what another would say: t_end, or the rows' times.

#include <string>

#include "api/contract/field.hpp"
#include "api/contract/field_values.hpp"

namespace qdot::api {

/// A default holds only where the object does not say the same thing in another way.
[[nodiscard]] bool another_way_is_given(const FieldSet& set, const std::string& name, const Json& object);

/// Refuses every field that is given beside one of an earlier way, and an object with none of them where one
/// is needed.
void check_ways(const OneOf& one_of, const Json& object, const Place& place, Errors& errors);

}  // namespace qdot::api
