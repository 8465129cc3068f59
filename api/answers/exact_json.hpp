#pragma once
// Formulas beside numbers, as answers have them: {"text", "latex", "assumes"}.

#include "api/json/json.hpp"
#include "core/closed/closed_form.hpp"

namespace qdot::api {

/// {"text", "latex"}
[[nodiscard]] Json formula_json(const ClosedForm& form);

/// With "assumes", a list of conditions such as "l > 0" and "k = 2*m*g/l".
[[nodiscard]] Json exact_json(const ClosedForm& form);

}  // namespace qdot::api
