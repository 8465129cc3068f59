#include "api/answers/equations/request.hpp"

namespace qdot::api {
namespace {

Words<Form> words_of_forms() {
  Words<Form> words;
  for (const PrintForm& form : print_forms()) words.emplace_back(form.name, form.form);
  return words;
}

}  // namespace

const RequestTable<EquationsRequest>& equations_table() {
  static const RequestTable<EquationsRequest> table({
      system_field<EquationsRequest>(),
      choice("form", &EquationsRequest::form, words_of_forms(), "notation of the equations",
             {.default_value = "text", .aliases = {"format", "language", "syntax"}}),
  });
  return table;
}

}  // namespace qdot::api
