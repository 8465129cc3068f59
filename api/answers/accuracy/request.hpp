#pragma once
// /v1/accuracy: the measured trade of error against work, for one motion. The answer has the `reference`, the
// `points` (a method at a tolerance: error, evaluations, steps, whether it is on the Pareto front) and
// `recommendations`.

#include <cstdint>
#include <optional>
#include <vector>

#include "api/answers/endpoint.hpp"
#include "core/motion/work_precision.hpp"

namespace qdot::api {

struct AccuracyRequest {
  SystemChoice system{};
  double t_start{};
  std::optional<double> t_end{};
  std::optional<std::int64_t> samples{};
  std::optional<double> dt{};
  std::vector<double> times{};
  bool impacts{true};
  std::vector<Method> methods{};
  std::optional<double> max_error{};  ///< none: recommendations for 1e-3, 1e-6, 1e-9 and 1e-12
  bool measure{};
  std::optional<int> digits{};

  Real start{};  ///< t_start as it was typed
  /// The instants to compare at, from the fields above.
  Reals grid{};
};

[[nodiscard]] const RequestTable<AccuracyRequest>& accuracy_table();

[[nodiscard]] Endpoint accuracy_endpoint();

}  // namespace qdot::api
