#pragma once
// What a request may say, as data. One FieldSet an endpoint is all there is: the reader validates by it
// (request_reader.hpp), the GET twin flattens by it, and documentation is printed from it, so none of them
// can say something else than the others. request_table.hpp ties a FieldSet to the members of a struct.

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "api/json/json.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

/// A number in `unit`, or a text that carries its own unit, "30deg".
struct NumberKind {
  std::string unit{"1"};
  Domain range{};
};

struct IntegerKind {
  std::int64_t least{};
  std::int64_t most{};
};

struct BooleanKind {};

/// Not empty, without blanks at its ends.
struct TextKind {
  std::size_t most_bytes{};
};

/// One of some words.
struct ChoiceKind {
  std::vector<std::string> options{};
};

/// An array; in a query, its elements with commas between them. A list of choices has each at most once.
struct ListKind {
  std::variant<NumberKind, TextKind, ChoiceKind> element{};
  std::size_t most{};
};

/// The name of a system of the catalogue, or a scene.
struct SystemKind {};

/// What a request says of its system's own symbols. In a body an object, "parameters": {"k": 40}; in a query
/// flattened, k=40.
enum class SymbolRole { parameter, initial, input, equilibrium, position };
struct SymbolsKind {
  SymbolRole role{};
};

/// A number in the unit of the parameter that the text field `parameter` names.
struct ParameterValueKind {
  std::string parameter{};
};

using Kind = std::variant<NumberKind, IntegerKind, BooleanKind, TextKind, ChoiceKind, ListKind, SystemKind,
                          SymbolsKind, ParameterValueKind>;

enum class Need { optional, required };

struct FieldInfo {
  std::string name{};
  Kind kind{};
  std::string description{};
  Json default_value{};  ///< null: none
  Need need{Need::optional};
  std::vector<std::string> aliases{};  ///< other programs' words for it, for "did you mean"
};

/// At most one way of several to say a thing, each way being some fields: {{"samples"}, {"dt"}, {"times"}}.
struct OneOf {
  std::vector<std::vector<std::string>> ways{};
};

struct FieldSet {
  std::vector<FieldInfo> fields{};
  std::vector<OneOf> one_of{};

  [[nodiscard]] const FieldInfo* find(const std::string& name) const;
};

}  // namespace qdot::api
