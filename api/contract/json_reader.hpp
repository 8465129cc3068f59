#pragma once
// The door for JSON. Limits hold while reading, before a document of nodes exists, because a document nested
// 100,000 deep overflows the stack when it is copied. What passes is plain: finite numbers, valid UTF-8,
// every key of an object once.

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "api/http/problem.hpp"
#include "api/json/json.hpp"
#include "api/json/limits.hpp"

namespace qdot::api {

struct JsonLimits {
  std::size_t bytes{limits::body_bytes};
  std::size_t nodes{limits::json_nodes};
  std::size_t depth{limits::json_depth};
};

/// The digits of numbers that a double does not keep, as they were written, by the numbers' pointers: of up
/// to 15 digits the shortest decimal of the double is what was written.
using WrittenNumbers = std::map<std::string, std::string>;

struct JsonDocument {
  Json value{};
  WrittenNumbers numbers{};
  /// Keys that were given again, with their pointers. The value holds the first of each; the request is
  /// wrong, but its other mistakes are worth reporting with this one.
  std::vector<FieldError> duplicates{};
};

/// Reads one JSON text (RFC 8259; a byte order mark before it is skipped). Otherwise a problem: invalid-json
/// with the place (`byte`, counted from 1, `line`, `column`), payload-too-large or limit-exceeded.
[[nodiscard]] std::variant<JsonDocument, Problem> read_json(std::string_view text,
                                                            const JsonLimits& limits = {});

}  // namespace qdot::api
