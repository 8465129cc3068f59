#include "api/contract/field.hpp"

#include <algorithm>

#include "api/json/suggest.hpp"
#include "api/json/text.hpp"

namespace qdot::api {

const FieldInfo* FieldSet::find(const std::string& name) const {
  const auto found = std::ranges::find(fields, name, &FieldInfo::name);
  return found == fields.end() ? nullptr : &*found;
}

std::string field_name(SymbolRole role) {
  switch (role) {
    case SymbolRole::parameter:
      return "parameters";
    case SymbolRole::initial:
      return "initial";
    case SymbolRole::input:
      return "inputs";
    case SymbolRole::equilibrium:
      return "equilibrium";
    case SymbolRole::position:
      return "at";
  }
  return {};
}

const FieldInfo* field_of(const FieldSet& set, SymbolRole role) {
  const FieldInfo* field = set.find(field_name(role));
  return field != nullptr && symbols_kind(*field) != nullptr ? field : nullptr;
}

const FieldInfo* field_by_alias(const FieldSet& set, std::string_view name) {
  const std::string letters = lower_case(letters_of(name));
  const auto is_meant = [&](const std::string& alias) { return letters_of(alias) == letters; };
  for (const FieldInfo& field : set.fields) {
    if (std::ranges::any_of(field.aliases, is_meant)) return &field;
  }
  return nullptr;
}

}  // namespace qdot::api
