#include "api/answers/exact_json.hpp"

namespace qdot::api {

Json formula_json(const ClosedForm& form) { return {{"text", form.text}, {"latex", form.latex}}; }

Json exact_json(const ClosedForm& form) {
  Json json = formula_json(form);
  json["assumes"] = form.assumes;
  return json;
}

}  // namespace qdot::api
