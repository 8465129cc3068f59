#pragma once
// Reading JSON objects by tables. A table lists the fields of one kind of object, each with the function that
// reads it; read_fields walks an object along its table and reports every mistake with its place:
//
//   const Fields<Spring> spring_fields{required("stiffness", &Spring::stiffness, read_expression), ...};
//
// A reader is any function (const Cursor&, T&) that fills T or reports why it cannot.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "api/json/json.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

/// One value inside a JSON document: the value, where it stands, and where to report mistakes.
class Cursor {
 public:
  Cursor(const Json& value, std::string place, std::vector<Diagnostic>& diagnostics)
      : value_{&value}, place_{std::move(place)}, diagnostics_{&diagnostics} {}

  [[nodiscard]] const Json& value() const { return *value_; }
  /// The field or element below this one; its place is a JSON Pointer (RFC 6901).
  [[nodiscard]] Cursor field(const std::string& name) const;
  [[nodiscard]] Cursor element(std::size_t index) const;

  void report(std::string code, std::string message) const;
  /// "must be ..., not a number"
  void report_type(std::string_view expected) const;

 private:
  const Json* value_;
  std::string place_;
  std::vector<Diagnostic>* diagnostics_;
};

enum class Presence { required, optional };

template <class Target>
struct Field {
  std::string name;
  Presence presence{Presence::optional};
  std::function<void(const Cursor&, Target&)> read;
};

template <class Target>
using Fields = std::vector<Field<Target>>;

template <class Target, class Member, class Reader>
Field<Target> required(std::string name, Member Target::*member, Reader read) {
  return {std::move(name), Presence::required,
          [member, read](const Cursor& cursor, Target& target) { read(cursor, target.*member); }};
}

template <class Target, class Member, class Reader>
Field<Target> optional(std::string name, Member Target::*member, Reader read) {
  Field<Target> field = required(std::move(name), member, read);
  field.presence = Presence::optional;
  return field;
}

/// Reports the fields that `names` does not have, with the nearest name. False when this is no object at all.
bool check_object(const Cursor& cursor, const std::vector<std::string>& names);

template <class Target>
void read_fields(const Cursor& cursor, const Fields<Target>& fields, Target& target) {
  std::vector<std::string> names;
  for (const Field<Target>& field : fields) names.push_back(field.name);
  if (!check_object(cursor, names)) return;
  for (const Field<Target>& field : fields) {
    if (cursor.value().contains(field.name)) {
      field.read(cursor.field(field.name), target);
    } else if (field.presence == Presence::required) {
      cursor.report("missing", "The field '" + field.name + "' is missing.");
    }
  }
}

/// Reader of one object with these fields. The table must outlive it.
template <class Target>
auto object(const Fields<Target>& fields) {
  return [&fields](const Cursor& cursor, Target& target) { read_fields(cursor, fields, target); };
}

/// Reader of an optional member: present when the field is.
template <class Reader>
auto into_optional(Reader read) {
  return [read](const Cursor& cursor, auto& target) { read(cursor, target.emplace()); };
}

/// False, with a report, when this is no array or its length is not in [least, most].
bool check_array(const Cursor& cursor, std::size_t least, std::size_t most);

/// Reader of an array: its elements one by one, in order.
template <class Reader>
auto array(Reader read, std::size_t least, std::size_t most) {
  return [read, least, most](const Cursor& cursor, auto& target) {
    if (!check_array(cursor, least, most)) return;
    for (std::size_t i = 0; i < cursor.value().size(); ++i) read(cursor.element(i), target.emplace_back());
  };
}

}  // namespace qdot::api
