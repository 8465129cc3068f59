#pragma once
// An answer for people: names, numbers and units aligned, lists as tables. What is not a row of a trajectory
// begins with # then, so that gnuplot and numpy.loadtxt read the columns as they are.

#include <string>

#include "api/json/json.hpp"

namespace qdot::server {

enum class Colours { none, ansi };

/// Ends in a newline. Everything in the answer is in it but the versions, `units` and the request's defaults.
[[nodiscard]] std::string answer_as_text(const api::Json& answer, Colours colours);

/// A problem (RFC 9457): what is wrong, where, and what to write instead.
[[nodiscard]] std::string problem_as_text(const api::Json& problem, Colours colours);

}  // namespace qdot::server
