#pragma once
// A FieldSet tied to a struct: each field is bound to the member that takes its value.
//
//   const Table<Spring> springs("spring", "a linear spring", {
//       value("stiffness", &Spring::stiffness, ExpressionKind{}, "in N/m", required),
//       value("rest_length", &Spring::rest_length, ExpressionKind{}, "in m", {.default_value = "0"}),
//   });

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "api/contract/field.hpp"

namespace qdot::api {

template <class Struct>
struct BoundField {
  FieldInfo info{};
  /// Puts a resolved value into the struct; empty for what has its place already or needs none.
  std::function<void(Struct&, const Json&)> store{};
};

/// The optional parts of a field's description.
struct FieldOptions {
  Json default_value{};
  Need need{Need::optional};
  std::vector<std::string> aliases{};
};

inline const FieldOptions required{.need = Need::required};

template <class Struct>
class Table {
 public:
  Table(std::string name, std::string description, std::vector<BoundField<Struct>> fields,
        std::vector<OneOf> one_of = {})
      : fields_(std::move(fields)),
        set_{.name = std::move(name), .description = std::move(description), .one_of = std::move(one_of)} {
    for (const BoundField<Struct>& field : fields_) set_.fields.push_back(field.info);
  }

  [[nodiscard]] const FieldSet& set() const { return set_; }

  /// Puts what was read by set() into the struct.
  void store(const Json& resolved, Struct& target) const {
    for (const BoundField<Struct>& field : fields_) {
      const auto value = resolved.find(field.info.name);
      if (field.store && value != resolved.end()) field.store(target, *value);
    }
  }

 private:
  std::vector<BoundField<Struct>> fields_;
  FieldSet set_;
};

namespace detail {

template <class T>
struct ValueOf {
  using type = T;
};
template <class T>
struct ValueOf<std::optional<T>> {
  using type = T;
};

inline FieldInfo info(std::string name, Kind kind, std::string description, FieldOptions options) {
  return {.name = std::move(name),
          .kind = std::move(kind),
          .description = std::move(description),
          .default_value = std::move(options.default_value),
          .need = options.need,
          .aliases = std::move(options.aliases)};
}

/// A field whose resolved value is the member's own.
template <class Struct, class Member>
BoundField<Struct> bound(Member Struct::*member, FieldInfo info) {
  return {std::move(info), [member](Struct& target, const Json& value) {
            target.*member = value.get<typename ValueOf<Member>::type>();
          }};
}

template <class Value>
std::vector<std::string> first_of_each(const std::vector<std::pair<std::string, Value>>& pairs) {
  std::vector<std::string> result;
  for (const auto& [first, second] : pairs) result.push_back(first);
  return result;
}

}  // namespace detail

// The fields of a table. Each takes the member that it fills, T or std::optional<T>.

/// Of any kind whose resolved value is the member's own.
template <class Struct, class Member>
BoundField<Struct> value(std::string name, Member Struct::*member, Kind kind, std::string description,
                         FieldOptions options = {}) {
  return detail::bound(
      member, detail::info(std::move(name), std::move(kind), std::move(description), std::move(options)));
}

template <class Struct, class Member>
BoundField<Struct> number(std::string name, Member Struct::*member, NumberKind kind, std::string description,
                          FieldOptions options = {}) {
  return value(std::move(name), member, std::move(kind), std::move(description), std::move(options));
}

template <class Struct, class Member>
BoundField<Struct> integer(std::string name, Member Struct::*member, IntegerKind kind,
                           std::string description, FieldOptions options = {}) {
  return value(std::move(name), member, kind, std::move(description), std::move(options));
}

template <class Struct>
BoundField<Struct> boolean(std::string name, bool Struct::*member, std::string description,
                           FieldOptions options = {}) {
  return value(std::move(name), member, BooleanKind{}, std::move(description), std::move(options));
}

/// `most` elements of a kind: NumberKind for a vector of doubles, TextKind for one of strings.
template <class Struct, class Element, class ElementKind>
BoundField<Struct> list(std::string name, std::vector<Element> Struct::*member, ElementKind kind,
                        std::size_t most, std::string description, FieldOptions options = {}) {
  return value(std::move(name), member, ListKind{std::move(kind), most}, std::move(description),
               std::move(options));
}

/// The words of a choice, each with the value that it stands for: {{"stop", OnInvalid::stop}, ...}.
template <class Value>
using Words = std::vector<std::pair<std::string, Value>>;

/// One of some words.
template <class Struct, class Member, class Value = typename detail::ValueOf<Member>::type>
BoundField<Struct> choice(std::string name, Member Struct::*member, std::type_identity_t<Words<Value>> words,
                          std::string description, FieldOptions options = {}) {
  ChoiceKind kind{.options = detail::first_of_each(words)};
  return {detail::info(std::move(name), std::move(kind), std::move(description), std::move(options)),
          [member, value_of = std::map<std::string, Value>(words.begin(), words.end())](
              Struct& target, const Json& word) { target.*member = value_of.at(word.get<std::string>()); }};
}

/// A set of some words.
template <class Struct, class Value>
BoundField<Struct> choices(std::string name, std::vector<Value> Struct::*member,
                           std::type_identity_t<Words<Value>> words, std::string description,
                           FieldOptions options = {}) {
  ListKind kind{ChoiceKind{.options = detail::first_of_each(words)}, words.size()};
  return {detail::info(std::move(name), std::move(kind), std::move(description), std::move(options)),
          [member, value_of = std::map<std::string, Value>(words.begin(), words.end())](Struct& target,
                                                                                        const Json& chosen) {
            for (const Json& word : chosen) (target.*member).push_back(value_of.at(word.get<std::string>()));
          }};
}

/// An object with a table of its own, which must outlive the field.
template <class Struct, class Record>
BoundField<Struct> record(std::string name, std::optional<Record> Struct::*member, const Table<Record>& table,
                          std::string description) {
  return {detail::info(std::move(name), RecordKind{&table.set()}, std::move(description), {}),
          [member, &table](Struct& target, const Json& value) {
            table.store(value, (target.*member).emplace());
          }};
}

/// `least` to `most` such objects.
template <class Struct, class Record>
BoundField<Struct> records(std::string name, std::vector<Record> Struct::*member, const Table<Record>& table,
                           std::size_t least, std::size_t most, std::string description,
                           FieldOptions options = {}) {
  return {detail::info(std::move(name), ListKind{RecordKind{&table.set()}, most, least},
                       std::move(description), std::move(options)),
          [member, &table](Struct& target, const Json& values) {
            for (const Json& one : values) table.store(one, (target.*member).emplace_back());
          }};
}

}  // namespace qdot::api
