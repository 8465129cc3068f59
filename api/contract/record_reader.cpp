#include "api/contract/record_reader.hpp"

#include <algorithm>
#include <utility>

#include "api/contract/names.hpp"
#include "api/contract/one_of.hpp"
#include "api/contract/unknown_field.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

bool has_symbols(const FieldSet& set) {
  return std::ranges::any_of(set.fields, [](const FieldInfo& f) { return symbols_kind(f) != nullptr; });
}

/// The elements of a query's list: commas inside parentheses do not part them.
Json split_list(std::string_view text) {
  Json elements = Json::array();
  int depth = 0;
  std::size_t start = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (text[i] == ',' && depth == 0) {
      elements.push_back(trimmed(text.substr(start, i - start)));
      start = i + 1;
    }
  }
  if (!trimmed(text).empty()) elements.push_back(trimmed(text.substr(start)));
  return elements;
}

/// "the fields name, unit and value"
std::string fields_in_words(const FieldSet& set) {
  std::string text = "the fields ";
  for (const FieldInfo& field : set.fields) text += (&field == &set.fields.front() ? "" : ", ") + field.name;
  return text;
}

/// "an array, such as ["energy"]", where "energy" was given.
std::string array_in_words(const ListKind& kind, const Json& value) {
  const auto* record = std::get_if<RecordKind>(kind.element.get());
  const bool is_plain = record == nullptr && !std::holds_alternative<VariantKind>(*kind.element);
  if (is_plain && value.is_string() && is_utf8(value.get_ref<const std::string&>()))
    return "an array, such as [\"" + printable(value.get_ref<const std::string&>()) + "\"]";
  return record == nullptr
             ? "an array"
             : "an array of objects, [{\"" + record->set->fields.front().name + "\": ...}, ...]";
}

class RecordReader {
 public:
  /// `whole` is the outermost object.
  RecordReader(const Json& whole, const Place& place, SystemChoice& choice, Errors& errors)
      : whole_(whole), whole_place_(place), choice_(choice), errors_(errors) {}

  RecordReading read(const FieldSet& set, const Json& object, const Place& place) {
    RecordReading reading;
    refuse_unknown_fields(set, object, place);
    auto& resolved = static_cast<Json::object_t::Container&>(reading.resolved.get_ref<Json::object_t&>());
    resolved.reserve(set.fields.size());
    for (const FieldInfo& field : set.fields) {
      const auto given = object.find(field.name);
      if (given != object.end()) {
        numbers_.clear();
        std::optional<Json> value = read_any(field.kind, field.name, *given, place.below(field.name));
        note_numbers(field, reading);
        if (value) resolved.emplace_back(field.name, std::move(*value));
      } else if (field.need == Need::required && !std::holds_alternative<SystemKind>(field.kind)) {
        refuse(place.of_missing(field.name), "missing",
               "'" + field.name + "' is missing: " + field.description);
      } else if (!field.default_value.is_null() && !another_way_is_given(set, field.name, object)) {
        resolved.emplace_back(field.name, field.default_value);
        reading.defaulted.push_back(field.name);
      }
    }
    for (const OneOf& one_of : set.one_of) check_ways(one_of, object, place, errors_);
    return reading;
  }

  std::optional<Json> read_any(const Kind& kind, const std::string& name, const Json& value,
                               const Place& place) {
    return std::visit([&](const auto& k) { return resolve(k, name, value, place); }, kind);
  }

 private:
  [[nodiscard]] const Scene* scene() const { return choice_.scene.get(); }

  std::nullopt_t refuse(const Place& place, std::string code, std::string detail) {
    report(errors_, place.error(std::move(code), std::move(detail)));
    return std::nullopt;
  }

  std::nullopt_t refuse_type(const std::string& name, const std::string& needed, const Json& value,
                             const Place& place) {
    report(errors_, wrong_type(place, name, needed, value));
    return std::nullopt;
  }

  void refuse_unknown_fields(const FieldSet& set, const Json& object, const Place& place) {
    // Without its system, the names in a query cannot be told apart: the mistake is the system. Only what is
    // nearly a field is reported, "System".
    const bool any_may_be_a_symbol = place.road() == Road::query && scene() == nullptr && has_symbols(set);
    for (const auto& [name, value] : object.items()) {
      if (is_full(errors_)) return;
      if (set.find(name) != nullptr) continue;
      if (any_may_be_a_symbol && same_letters(name, field_names(set, nullptr, Road::query)).empty() &&
          field_by_alias(set, name) == nullptr)
        continue;
      report(errors_, unknown_field(set, scene(), name, value, place));
    }
  }

  void refuse_count(const std::string& name, std::size_t count, std::size_t least, std::size_t most,
                    const Place& place) {
    const std::string entries = std::to_string(count) + (count == 1 ? " entry" : " entries");
    if (count > most) {
      refuse(place, "too_many",
             "'" + name + "' has " + entries + "; at most " + std::to_string(most) + " are read.");
    } else {
      refuse(place, count == 0 ? "empty" : "too_few",
             "'" + name + "' has " + entries + "; at least " + std::to_string(least) + " must be given.");
    }
  }

  void note_numbers(const FieldInfo& field, RecordReading& reading) {
    const auto* list = std::get_if<ListKind>(&field.kind);
    const Kind& kind = list == nullptr ? field.kind : *list->element;
    if (!std::holds_alternative<NumberKind>(kind)) return;
    if (!std::ranges::all_of(numbers_, &Real::is_exact)) reading.exact[field.name] = std::move(numbers_);
  }

  std::optional<Json> resolve(const NumberKind& kind, const std::string& name, const Json& value,
                              const Place& place) {
    ParameterScope numbers_only;
    const std::optional<Real> number = read_number(kind, name, value, place, numbers_only, errors_);
    if (!number) return std::nullopt;
    numbers_.push_back(*number);
    return number->value;
  }

  template <class PlainKind>
  std::optional<Json> resolve(const PlainKind& kind, const std::string& name, const Json& value,
                              const Place& place) {
    return read_value(kind, name, value, place, errors_);
  }

  std::optional<Json> resolve(const VectorKind&, const std::string& name, const Json& value,
                              const Place& place) {
    static const ListKind expressions{ExpressionKind{}, 3, 2};
    if (!value.is_array())
      return refuse_type(name, "an array of 2 or 3 expressions, such as [\"0\", \"-g\"]", value, place);
    return resolve(expressions, name, value, place);
  }

  std::optional<Json> resolve(const PositionKind&, const std::string& name, const Json& value,
                              const Place& place) {
    if (value.is_string()) return read_value(NameKind{}, name, value, place, errors_);
    if (value.is_array()) return resolve(VectorKind{}, name, value, place);
    return refuse_type(name, "the name of a point or an array of 2 or 3 expressions", value, place);
  }

  std::optional<Json> resolve(const ListKind& kind, const std::string& name, const Json& value,
                              const Place& place) {
    const bool from_query = place.road() == Road::query && value.is_string();
    if (!from_query && !value.is_array()) return refuse_type(name, array_in_words(kind, value), value, place);
    const Json parted = from_query ? split_list(value.get_ref<const std::string&>()) : Json();
    const Json& elements = from_query ? parted : value;
    if (elements.size() > kind.most || elements.size() < kind.least) {
      refuse_count(name, elements.size(), kind.least, kind.most, place);
      return std::nullopt;
    }
    const bool is_set = std::holds_alternative<ChoiceKind>(*kind.element);
    Json result = Json::array();
    bool complete = true;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const Place here = place.below(i);
      is_element_ = true;
      std::optional<Json> element = read_any(*kind.element, name, elements[i], here);
      is_element_ = false;
      if (element && is_set && std::ranges::find(result, *element) != result.end()) {
        element = refuse(here, "duplicate_item", "'" + name + "' has " + element->dump() + " twice.");
      }
      complete = complete && element;
      if (element) result.push_back(std::move(*element));
    }
    return complete ? std::optional(std::move(result)) : std::nullopt;
  }

  std::optional<Json> resolve(const RecordKind& kind, const std::string& name, const Json& value,
                              const Place& place) {
    if (!value.is_object()) {
      const std::string needed = "an object with " + fields_in_words(*kind.set);
      return refuse_type(name, is_element_ ? "in each place " + needed : needed, value, place);
    }
    is_element_ = false;
    return read(*kind.set, value, place).resolved;
  }

  std::optional<Json> resolve(const VariantKind& kind, const std::string& name, const Json& value,
                              const Place& place) {
    ChoiceKind kinds;
    for (const FieldSet* set : kind.sets) kinds.options.push_back(set->name);
    if (!value.is_object()) return refuse_type(name, "an object with a 'kind'", value, place);
    const auto given = value.find("kind");
    if (given == value.end()) {
      return refuse(place.of_missing("kind"), "missing",
                    "'kind' is missing: " + enumerated(kinds.options) + ".");
    }
    const auto chosen = read_value(kinds, "kind", *given, place.below("kind"), errors_);
    if (!chosen) return std::nullopt;
    const auto is_chosen = [&](const FieldSet* set) {
      return set->name == chosen->get_ref<const std::string&>();
    };
    return resolve(RecordKind{*std::ranges::find_if(kind.sets, is_chosen)}, name, value, place);
  }

  std::optional<Json> resolve(const MapKind& kind, const std::string& name, const Json& value,
                              const Place& place) {
    if (!value.is_object()) return refuse_type(name, "an object", value, place);
    if (value.size() > kind.most) {
      refuse_count(name, value.size(), 0, kind.most, place);
      return std::nullopt;
    }
    Json result = Json::object();
    for (const auto& [key, given] : value.items()) {
      if (!is_name(key, kind.keys)) {
        report(errors_, bad_name(place, key, kind.keys));
        continue;
      }
      const Place here = place.below(key);
      std::optional<Json> read = kind.values == MapTo::names
                                     ? read_value(NameKind{}, key, given, here, errors_)
                                     : read_value(ExpressionKind{}, key, given, here, errors_);
      if (read) result[key] = std::move(*read);
    }
    return result;
  }

  std::optional<Json> resolve(const SystemKind&, const std::string&, const Json& value, const Place&) {
    return scene() == nullptr ? std::nullopt : std::optional(value);
  }

  /// Without a system there is nothing to read by, and the missing system is reported already.
  std::optional<Json> resolve(const SymbolsKind& kind, const std::string&, const Json& value,
                              const Place& place) {
    if (scene() == nullptr) return std::nullopt;
    static const Json none = Json::object();
    const std::string parameters = field_name(SymbolRole::parameter);
    const auto given = whole_.find(parameters);
    const Place here = whole_place_.below(parameters);
    ParameterScope scope(*scene(), given == whole_.end() ? none : *given, here);
    return read_symbols(kind.role, value, place, scope, choice_, errors_);
  }

  std::optional<Json> resolve(const ParameterValueKind& kind, const std::string& name, const Json& value,
                              const Place& place) {
    if (scene() == nullptr || !whole_.contains(kind.parameter)) return std::nullopt;  // reported already
    for (const Symbol& symbol : symbols(*scene(), SymbolRole::parameter)) {
      if (whole_[kind.parameter] != symbol.name) continue;
      return read_value(NumberKind{symbol.unit, symbol.domain}, name, value, place, errors_);
    }
    return std::nullopt;
  }

  const Json& whole_;
  const Place& whole_place_;
  SystemChoice& choice_;
  Errors& errors_;
  std::vector<Real> numbers_;  ///< of the field that is read
  bool is_element_{};          ///< what is read next stands in an array
};

}  // namespace

RecordReading read_record(const FieldSet& set, const Json& fields, const Place& place, SystemChoice& choice,
                          Errors& errors) {
  return RecordReader(fields, place, choice, errors).read(set, fields, place);
}

std::optional<Json> read_value(const RecordKind& kind, const std::string& name, const Json& value,
                               const Place& place, Errors& errors) {
  SystemChoice none;
  return RecordReader(value, place, none, errors).read_any(kind, name, value, place);
}

}  // namespace qdot::api
