#pragma once
// What requests and scenes may say, as data. One FieldSet describes one kind of object, and everything else
// follows it: the reader checks by it (record_reader.hpp), a GET is flattened by it, and JSON Schema and
// OpenAPI are printed from it, so that none of them can say something else than the others. table.hpp ties a
// FieldSet to the members of a struct.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
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

/// What an upper end says: what makes sense, or how much work a service does for one request
/// (core/base/work_bounds.hpp).
enum class UpperEnd { of_sense, of_work };

struct IntegerKind {
  std::int64_t least{};
  std::int64_t most{};
  UpperEnd upper_end{UpperEnd::of_sense};
};

struct BooleanKind {};

/// May a text begin or end with blanks?
enum class Ends { without_blanks, as_given };

/// Not empty.
struct TextKind {
  std::size_t most_bytes{};
  Ends ends{Ends::without_blanks};
};

/// One of some words.
struct ChoiceKind {
  std::vector<std::string> options{};
};

/// 1 or -1.
struct SignKind {};

/// The name that a scene gives to a thing (names.hpp), or also such a name with _dot after it.
enum class NameOf { thing, thing_or_velocity };
struct NameKind {
  NameOf of{NameOf::thing};
};

/// A text that core/expr parses later, or a number.
struct ExpressionKind {};

/// Two or three expressions.
struct VectorKind {};

/// The name of a point, or a vector.
struct PositionKind {};

/// Where a number makes sense: "> 0" or ">= 0, < 1" (domain_text.hpp).
struct DomainKind {};

/// Any value, read by whoever asked for it; `schema` says what it understands.
struct AnyKind {
  Json schema = Json::object();
};

struct Kind;

/// An array of `least` to `most` elements of one kind; in a query, they have commas between them. A list of
/// choices has each of them at most once.
struct ListKind {
  template <class ElementKind>
  ListKind(ElementKind element_kind, std::size_t most_elements, std::size_t least_elements = 0)
      : element(std::make_shared<const Kind>(std::move(element_kind))),
        most(most_elements),
        least(least_elements) {}

  std::shared_ptr<const Kind> element;
  std::size_t most{};
  std::size_t least{};
};

struct FieldSet;

/// An object with fields of its own. The set must outlive the kind.
struct RecordKind {
  const FieldSet* set{};
};

/// One of several objects. The field `kind`, which each of them has first, says which: it is the set's name.
struct VariantKind {
  std::vector<const FieldSet*> sets{};
};

/// An object of at most `most` names, each with an expression or with another name for it.
enum class MapTo { expressions, names };
struct MapKind {
  NameOf keys{};
  MapTo values{};
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

/// All kinds of values there are. Who treats them by kind treats every one: a new kind compiles only then.
using KindVariant =
    std::variant<NumberKind, IntegerKind, BooleanKind, TextKind, ChoiceKind, SignKind, NameKind,
                 ExpressionKind, VectorKind, PositionKind, DomainKind, ListKind, RecordKind, VariantKind,
                 MapKind, SystemKind, SymbolsKind, ParameterValueKind, AnyKind>;
struct Kind : KindVariant {
  using KindVariant::KindVariant;
};

enum class Need { optional, required };

struct FieldInfo {
  std::string name{};
  Kind kind{};
  std::string description{};
  Json default_value{};  ///< null: none
  Need need{Need::optional};
  std::vector<std::string> aliases{};  ///< other programs' words for it, for "did you mean"
};

/// What a field says of its system's symbols; nullptr for fields of other kinds.
[[nodiscard]] inline const SymbolsKind* symbols_kind(const FieldInfo& field) {
  return std::get_if<SymbolsKind>(&field.kind);
}

/// One way of several to say a thing, each way being some fields: {{"samples"}, {"dt"}, {"times"}}. Where the
/// thing must be said, a way is taken when the first of its fields is given.
struct OneOf {
  std::vector<std::vector<std::string>> ways{};
  Need need{Need::optional};
};

struct FieldSet {
  std::string name{};         ///< what its schema is called; a request has none
  std::string description{};  ///< of the whole object
  std::vector<FieldInfo> fields{};
  std::vector<OneOf> one_of{};

  [[nodiscard]] const FieldInfo* find(const std::string& name) const;
};

/// "parameters", "initial", "inputs", "equilibrium", "at": the field that holds the symbols of a role.
[[nodiscard]] std::string field_name(SymbolRole role);

/// The field of `set` that holds a role's symbols, or null.
[[nodiscard]] const FieldInfo* field_of(const FieldSet& set, SymbolRole role);

/// The field of `set` that another program calls `name`, capital letters or not, or null.
[[nodiscard]] const FieldInfo* field_by_alias(const FieldSet& set, std::string_view name);

}  // namespace qdot::api
