#pragma once
// The rows of a sweep, answered: each is asked as a client would ask it alone.

#include <string>
#include <vector>

#include "api/answers/sweep/plan.hpp"

namespace qdot::api {

struct SweptRow {
  int status{0};               ///< 0: not asked
  std::string reason{};        ///< why something is missing; empty: the row is whole
  std::vector<Json> values{};  ///< one for each column, null where it is missing
  /// For each column what a number was written with, where doubles have less digits; empty without any.
  std::vector<std::string> digits{};
};

struct SweptRows {
  std::vector<SweptRow> rows{};
  std::vector<std::string> units{};  ///< of the columns, as the first answers have them; "1" where none does
};

/// Asks every row, in the threads that the call's request may use. `find_system` and `models` are those of
/// the service; a scene that the request brings, or an input, is compiled once for all rows. Where the work
/// has no service's bounds and is interrupted, the rows are those before the first that was not asked. Throws
/// AnswerTooLong as soon as the rows show that the answer is.
[[nodiscard]] SweptRows answered_rows(const SweepPlan& plan, const Call& call, const FindSystem& find_system,
                                      Models& models);

}  // namespace qdot::api
