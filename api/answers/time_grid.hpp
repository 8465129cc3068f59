#pragma once
// The instants of a trajectory, as a request gives them: `samples` (the number of rows, both ends included),
// `dt`, or `times`. An answer has exactly these instants: each is known as it was typed, or as the quotient
// of typed numbers that it is, beside the double nearest to it.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "core/numerics/real.hpp"

namespace qdot::api {

/// In seconds. Of samples, dt and times at most one is given, see OneOf.
struct GridRequest {
  Real t_start{0};
  std::optional<Real> t_end{};
  std::optional<std::int64_t> samples{};  ///< at least 2
  std::optional<double> dt{};             ///< > 0
  Reals times{};
};

struct GridError {
  std::string field;
  std::string code;
  std::string detail;
};

/// Increasing as doubles too, within [t_start, t_end], at most limits::rows of them. With samples, the first
/// is t_start and the last t_end, exactly, and i/(n - 1) of the span lies between, so that 10 s in 101 rows
/// has 0.3 and not 0.30000000000000004. dt has to divide the span (to 1e-9 of it).
[[nodiscard]] std::variant<Reals, GridError> time_grid(const GridRequest& request);

}  // namespace qdot::api
