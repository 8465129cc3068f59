#include "api/contract/request_reader.hpp"

#include <algorithm>
#include <utility>

#include "api/json/limits.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

const SymbolsKind* symbols_kind(const FieldInfo& field) { return std::get_if<SymbolsKind>(&field.kind); }

const FieldInfo* field_of(const FieldSet& set, SymbolRole role) {
  const FieldInfo* field = set.find(field_name(role));
  return field != nullptr && symbols_kind(*field) != nullptr ? field : nullptr;
}

/// The names that can be given, for the list in an error.
std::vector<std::string> field_names(const FieldSet& set, const Scene* scene, Road road) {
  std::vector<std::string> names;
  for (const FieldInfo& field : set.fields) {
    if (road == Road::body || symbols_kind(field) == nullptr) {
      names.push_back(field.name);
    } else if (scene != nullptr) {
      for (const Symbol& symbol : symbols(*scene, symbols_kind(field)->role)) names.push_back(symbol.name);
    }
  }
  return names;
}

/// The field that another program calls `name`.
std::string known_by_alias(const FieldSet& set, const std::string& name) {
  for (const FieldInfo& field : set.fields) {
    const std::string lower = lower_case(name);
    if (std::ranges::find(field.aliases, lower) != field.aliases.end()) return field.name;
  }
  return {};
}

FieldError unknown_field(const FieldSet& set, const Scene* scene, const std::string& name,
                         const Place& place) {
  std::string detail = "There is no field " + in_quotes(name) + ".";
  const std::optional<SymbolRole> role = scene == nullptr ? std::nullopt : role_of(*scene, name);
  const FieldInfo* home = role ? field_of(set, *role) : nullptr;
  if (home != nullptr) detail += " " + scene->name + " has it: it belongs in '" + home->name + "'.";
  FieldError error = unknown_name(place, std::move(detail), name, field_names(set, scene, place.road()));
  if (const std::string meant = known_by_alias(set, name); !meant.empty()) error.did_you_mean = meant;
  if (home != nullptr) error.did_you_mean = home->name + "." + name;
  return error;
}

class Reader {
 public:
  Reader(const FieldSet& set, const Submission& submission, const FindSystem& find_system)
      : set_(set), find_system_(find_system), root_(submission.road), fields_(submission.fields) {
    reading_.errors = submission.errors;
  }

  Reading read() {
    find_system();
    if (root_.road() == Road::query) unflatten();
    refuse_unknown_fields();
    for (const FieldInfo& field : set_.fields) read_field(field);
    for (const OneOf& one_of : set_.one_of) check(one_of);
    return std::move(reading_);
  }

 private:
  [[nodiscard]] const Scene* scene() const { return reading_.system.scene.get(); }
  [[nodiscard]] bool is_given(const std::string& name) const { return fields_.contains(name); }
  void report(FieldError error) { reading_.errors.push_back(std::move(error)); }

  /// First of all, because the names that a request may use depend on it.
  void find_system() {
    const auto field = std::ranges::find_if(
        set_.fields, [](const FieldInfo& f) { return std::holds_alternative<SystemKind>(f.kind); });
    if (field == set_.fields.end() || !is_given(field->name)) return;
    reading_.system.scene = find_system_(fields_[field->name], root_.below(field->name), reading_.errors);
  }

  /// k=40 becomes {"parameters": {"k": "40"}}, as in a body.
  void unflatten() {
    Json nested = Json::object();
    for (const auto& [name, value] : fields_.items()) {
      const FieldInfo* field = set_.find(name);
      const auto [role, symbol] = flattened(name);
      if (field != nullptr && symbols_kind(*field) == nullptr) {
        nested[name] = value;
      } else if (role) {
        put(nested, *role, symbol, value);
      } else if (field != nullptr) {
        report(root_.below(name).error("unknown_field",
                                       "In a query the symbols stand alone: " + name + ".k=40 or k=40."));
      } else {
        nested[name] = value;
      }
    }
    fields_ = std::move(nested);
  }

  void put(Json& nested, SymbolRole role, const std::string& symbol, const Json& value) {
    Json& group = nested[field_name(role)];
    if (group.contains(symbol)) {
      report(root_.below(symbol).error("duplicate_field", in_quotes(symbol) + " stands twice in the query."));
    } else {
      group[symbol] = value;
    }
  }

  /// The role and name of a symbol in a query: "parameters.k", or "k" of a system that has it.
  std::pair<std::optional<SymbolRole>, std::string> flattened(const std::string& name) const {
    for (const FieldInfo& field : set_.fields) {
      const SymbolsKind* kind = symbols_kind(field);
      if (kind != nullptr && name.starts_with(field.name + "."))
        return {kind->role, name.substr(field.name.size() + 1)};
    }
    const std::optional<SymbolRole> role = scene() == nullptr ? std::nullopt : role_of(*scene(), name);
    return {role && field_of(set_, *role) != nullptr ? role : std::nullopt, name};
  }

  void refuse_unknown_fields() {
    // Without its system, the names in a query cannot be told apart: the mistake is the system.
    const bool undecided = root_.road() == Road::query && scene() == nullptr;
    for (const auto& [name, value] : fields_.items()) {
      if (reading_.errors.size() > limits::listed_errors) return;
      if (set_.find(name) == nullptr && !(undecided && has_symbols())) {
        report(unknown_field(set_, scene(), name, root_.below(name)));
      }
    }
  }

  [[nodiscard]] bool has_symbols() const {
    return std::ranges::any_of(set_.fields, [](const FieldInfo& f) { return symbols_kind(f) != nullptr; });
  }

  void read_field(const FieldInfo& field) {
    if (is_given(field.name)) {
      const Place place = root_.below(field.name);
      std::optional<Json> value = std::visit(
          [&](const auto& kind) { return resolve(kind, field, fields_[field.name], place); }, field.kind);
      if (value) reading_.resolved[field.name] = std::move(*value);
    } else if (field.need == Need::required) {
      report(
          root_.below(field.name).error("missing", "'" + field.name + "' is missing: " + field.description));
    } else if (!field.default_value.is_null() && !another_way_is_given(field.name)) {
      reading_.resolved[field.name] = field.default_value;
      reading_.defaulted.push_back(field.name);
    }
  }

  template <class PlainKind>
  std::optional<Json> resolve(const PlainKind& kind, const FieldInfo& field, const Json& value,
                              const Place& place) {
    return read_value(kind, field.name, value, place, reading_.errors);
  }

  std::optional<Json> resolve(const SystemKind&, const FieldInfo&, const Json& value, const Place&) {
    return scene() == nullptr ? std::nullopt : std::optional(value);
  }

  /// Without a system there is nothing to read by, and the missing system is reported already.
  std::optional<Json> resolve(const SymbolsKind& kind, const FieldInfo&, const Json& value,
                              const Place& place) {
    if (scene() == nullptr) return std::nullopt;
    return read_symbols(kind.role, value, place, reading_.system, reading_.errors);
  }

  std::optional<Json> resolve(const ParameterValueKind& kind, const FieldInfo& field, const Json& value,
                              const Place& place) {
    if (scene() == nullptr || !is_given(kind.parameter)) return std::nullopt;  // reported already
    for (const Symbol& symbol : symbols(*scene(), SymbolRole::parameter)) {
      if (fields_[kind.parameter] != symbol.name) continue;
      return read_value(NumberKind{symbol.unit, symbol.domain}, field.name, value, place, reading_.errors);
    }
    return std::nullopt;
  }

  /// A default holds only where the request does not say the same thing in another way.
  [[nodiscard]] bool another_way_is_given(const std::string& name) const {
    const auto has = [](const std::vector<std::string>& way, const std::string& field) {
      return std::ranges::find(way, field) != way.end();
    };
    return std::ranges::any_of(set_.one_of, [&](const OneOf& one_of) {
      const bool concerned =
          std::ranges::any_of(one_of.ways, [&](const auto& way) { return has(way, name); });
      return concerned && std::ranges::any_of(one_of.ways, [&](const auto& way) {
               return !has(way, name) && std::ranges::any_of(way, [&](const auto& f) { return is_given(f); });
             });
    });
  }

  void check(const OneOf& one_of) {
    std::string first;
    for (const std::vector<std::string>& way : one_of.ways) {
      const auto given = std::ranges::find_if(way, [&](const std::string& field) { return is_given(field); });
      if (given == way.end()) continue;
      if (first.empty()) {
        first = *given;
      } else {
        report(root_.below(*given).error(
            "exclusive", "'" + first + "' and '" + *given + "' cannot stand together; give one of them."));
      }
    }
  }

  const FieldSet& set_;
  const FindSystem& find_system_;
  Place root_;
  Json fields_;
  Reading reading_;
};

}  // namespace

const FieldInfo* FieldSet::find(const std::string& name) const {
  const auto found = std::ranges::find(fields, name, &FieldInfo::name);
  return found == fields.end() ? nullptr : &*found;
}

Reading read_request(const FieldSet& set, const Submission& submission, const FindSystem& find_system) {
  return Reader(set, submission, find_system).read();
}

}  // namespace qdot::api
