#pragma once
// The answer of a sweep in its forms: JSON with a column each, CSV and NDJSON with a line for each row.

#include "api/answers/sweep/rows.hpp"

namespace qdot::api {

/// In the plan's form. Throws AnswerTooLong, and Interrupted, as AnswerBound::check does.
[[nodiscard]] Response sweep_answer(const SweepPlan& plan, SweptRows swept, const Call& call);

inline constexpr const char* sweep_csv = "text/csv";
inline constexpr const char* sweep_ndjson = "application/x-ndjson";

}  // namespace qdot::api
