#pragma once
// How much one request may cost, by whose machine computes (core/base/work_bounds.hpp).

#include <cstdint>

#include "core/integrate/run.hpp"

namespace qdot::api {

/// Of a run: those of a service, or none worth the name.
[[nodiscard]] Limits limits_of_run();

/// Rows of an answer, and numbers in it.
[[nodiscard]] std::int64_t most_rows_of_answer();
[[nodiscard]] std::int64_t most_numbers_of_answer();

}  // namespace qdot::api
