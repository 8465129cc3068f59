#pragma once
// The table that a request is read by (field.hpp), as JSON Schema 2020-12 and as OpenAPI's query parameters.
// What a schema cannot say stands in its description; nothing that the reader accepts is refused by a schema.

#include "api/contract/field.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

/// {"exclusiveMinimum": 0}: "minimum", "maximum" and their exclusive kin, where there is a bound.
[[nodiscard]] Json domain_json(const Domain& domain);

/// The body of a POST. Units stand under "x-unit", other programs' words for a field under "x-aliases".
[[nodiscard]] Json body_schema(const FieldSet& set);

/// The query of the GET twin. The system's own symbols are flattened: they are the properties of an object
/// in OpenAPI's style "form", exploded.
[[nodiscard]] Json query_parameters(const FieldSet& set);

/// The request as an answer echoes it: resolved, SI units.
[[nodiscard]] Json echo_schema(const FieldSet& set);

/// What the schemas above refer to in "#/components/schemas": Quantity and TimeFunction.
[[nodiscard]] Json shared_schemas();

/// {"$ref": "#/components/schemas/<name>"}
[[nodiscard]] Json reference(const std::string& name);

}  // namespace qdot::api
