#pragma once
// A sweep that is understood: every field is checked before the first row is asked.

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "api/answers/sweep/collected.hpp"
#include "api/answers/sweep/variables.hpp"

namespace qdot::api {

struct SweepPlan {
  const Endpoint* question{};
  Submission asked{};  ///< the request without what varies
  std::shared_ptr<const Scene> scene{};
  bool is_carried{};  ///< the request brings its scene along
  SweptValues swept{};
  std::vector<CollectedColumn> columns{};
  SweepFormat format{SweepFormat::json};
  Json echo = Json::object();
};

/// Reads `sent`, a body or a query whose fields that are not the sweep's own are those of the question.
[[nodiscard]] std::variant<SweepPlan, Problem> plan_of(const Submission& sent, const FindSystem& find_system,
                                                       std::int64_t most_rows, SweepRequest& request);

/// The request of one row.
[[nodiscard]] Submission row_request(const SweepPlan& plan, std::size_t row);

}  // namespace qdot::api
