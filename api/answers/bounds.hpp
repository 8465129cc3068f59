#pragma once
// How much one request may cost, by whose machine computes (core/base/work_bounds.hpp).

#include <cstdint>

#include "core/integrate/run.hpp"

namespace qdot::api {

/// The bounds of one integration. On one's own machine they are too wide to be met.
[[nodiscard]] Limits limits_of_run();

/// Rows of an answer, and numbers in it.
[[nodiscard]] std::int64_t most_rows_of_answer();
[[nodiscard]] std::int64_t most_numbers_of_answer();

}  // namespace qdot::api
