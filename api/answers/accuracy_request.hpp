#pragma once
// POST and GET /v1/accuracy: for which motion the trade of error against work is wanted.

#include <cstdint>
#include <optional>
#include <vector>

#include "api/contract/request_table.hpp"
#include "api/contract/system_choice.hpp"
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

  /// The instants to compare at, from the fields above.
  std::vector<double> grid{};
};

[[nodiscard]] const RequestTable<AccuracyRequest>& accuracy_table();

}  // namespace qdot::api
