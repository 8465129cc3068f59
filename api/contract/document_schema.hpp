#pragma once
// JSON Schema 2020-12 of what a FieldSet describes in a document.

#include "api/contract/field.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

/// The schema of a document that is one object, at the address `id`. Each kind of object in it, and each kind
/// of text that has rules, is described once, under "$defs".
[[nodiscard]] Json document_schema(const FieldSet& set, const std::string& id);

/// The schema of one value, with everything in it described in its place.
[[nodiscard]] Json value_schema(const Kind& kind);

/// The exclusions and needs between fields are put into the schema of their object.
void append_rules(const FieldSet& set, Json& schema);

}  // namespace qdot::api
