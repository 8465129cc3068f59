#include "api/answers/bounds.hpp"

#include "api/json/limits.hpp"
#include "core/base/work_bounds.hpp"

namespace qdot::api {
namespace {

constexpr std::uint64_t more_than_anyone_waits_for = std::uint64_t{1} << 60U;
constexpr std::int64_t more_than_memory_holds = 100'000'000;

bool is_unbounded() { return work_bounds() == WorkBounds::none; }

}  // namespace

Limits limits_of_run() {
  Limits run;
  if (is_unbounded()) run.max_steps = run.max_evaluations = more_than_anyone_waits_for;
  return run;
}

std::int64_t most_rows_of_answer() { return is_unbounded() ? more_than_memory_holds : limits::rows; }

std::int64_t most_numbers_of_answer() { return is_unbounded() ? more_than_memory_holds : limits::numbers; }

}  // namespace qdot::api
