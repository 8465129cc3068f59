#pragma once
// Facts: a word that an endpoint answers ("stable"), or whether that is so (yes or no).

#include "api/answers/check/pointed_values.hpp"
#include "api/answers/check/verdict.hpp"

namespace qdot::api {

/// `is` null: the word itself is expected. Else yes or no: whether one of the values is that word or number,
/// or, for a domain such as "> 0", whether all of them lie in it.
[[nodiscard]] Verdict grade_fact(const Pointed& expected, const Json& is, const Json& submitted);

}  // namespace qdot::api
