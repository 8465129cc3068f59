#include "api/contract/request_reader.hpp"

#include <algorithm>
#include <utility>

#include "api/contract/record_reader.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

class RequestReader {
 public:
  RequestReader(const FieldSet& set, const Submission& submission, const FindSystem& find_system)
      : set_(set), find_system_(find_system), root_(submission), fields_(submission.fields) {
    reading_.errors = submission.errors;
    for (FieldError& error : reading_.errors) advise_on_twice(error);
  }

  Reading read() {
    find_system();
    if (root_.road() == Road::query) unflatten();
    RecordReading record = read_record(set_, fields_, root_, reading_.system, reading_.errors);
    reading_.resolved = std::move(record.resolved);
    reading_.defaulted = std::move(record.defaulted);
    reading_.exact = std::move(record.exact);
    return std::move(reading_);
  }

 private:
  [[nodiscard]] const Scene* scene() const { return reading_.system.scene.get(); }

  /// What is given twice in a query may be meant as a list.
  void advise_on_twice(FieldError& error) const {
    const FieldInfo* field = error.code == "duplicate_field" ? set_.find(error.parameter) : nullptr;
    if (field == nullptr) return;
    if (std::holds_alternative<ListKind>(field->kind)) {
      error.detail += " A list stands in one field, with commas.";
    } else if (std::holds_alternative<SystemKind>(field->kind)) {
      error.detail +=
          " A question is about one system: ask again for another, or POST a line for each to /v1/batch.";
    } else {
      error.detail += " Give it once.";
    }
  }

  void refuse(const std::string& name, std::string code, std::string detail) {
    report(reading_.errors, root_.below(name).error(std::move(code), std::move(detail)));
  }

  /// First of all, because the names that a request may use depend on it.
  void find_system() {
    const auto field = std::ranges::find_if(
        set_.fields, [](const FieldInfo& f) { return std::holds_alternative<SystemKind>(f.kind); });
    if (field == set_.fields.end()) return;
    const auto given = fields_.find(field->name);
    if (given != fields_.end()) {
      reading_.system.scene = find_system_(*given, root_.below(field->name), reading_.errors);
      reading_.system.is_carried = given->is_object();
    } else {
      refuse_without_system(*field);
    }
  }

  void refuse_without_system(const FieldInfo& field) {
    FieldError error = root_.below(field.name)
                           .error("missing", "'" + field.name + "' is missing: " + field.description + ".");
    Errors of_nothing;
    find_system_(Json(), root_, of_nothing);  // it knows which systems there are
    if (!of_nothing.empty()) error.allowed = of_nothing.front().allowed;
    error.did_you_mean = system_without_its_field(field.name);
    report(reading_.errors, std::move(error));
  }

  /// "system=cart_pendulum" where the query says only "cart_pendulum".
  [[nodiscard]] std::string system_without_its_field(const std::string& field) const {
    for (const auto& [name, value] : fields_.items()) {
      Errors ignored;
      if (root_.road() == Road::query && is_text(value, "") && find_system_(Json(name), root_, ignored))
        return field + "=" + name;
    }
    return {};
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
        refuse(name, "unknown_field",
               "In a query each symbol is given by itself" + example_of_symbol(*field) + ".");
      } else {
        nested[name] = value;
      }
    }
    fields_ = std::move(nested);
  }

  /// ": theta=value or initial.theta=value"
  [[nodiscard]] std::string example_of_symbol(const FieldInfo& field) const {
    if (scene() == nullptr) return "";
    const std::vector<Symbol> known = symbols(*scene(), symbols_kind(field)->role);
    if (known.empty()) return "";
    return ": " + known.back().name + "=value or " + field.name + "." + known.back().name + "=value";
  }

  void put(Json& nested, SymbolRole role, const std::string& symbol, const Json& value) {
    Json& group = nested[field_name(role)];
    if (group.contains(symbol)) {
      refuse(symbol, "duplicate_field", in_quotes(symbol) + " is given twice in the query.");
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

  const FieldSet& set_;
  const FindSystem& find_system_;
  Place root_;
  Json fields_;
  Reading reading_;
};

}  // namespace

Reading read_request(const FieldSet& set, const Submission& submission, const FindSystem& find_system) {
  return RequestReader(set, submission, find_system).read();
}

}  // namespace qdot::api
