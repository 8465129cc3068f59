#pragma once
// /v1/check: submitted answers, graded. An item has a whole request of another endpoint, and where in its
// answer the expected numbers stand; or the system whose equation or expression is expected.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/answers/check/formats.hpp"
#include "api/answers/endpoint.hpp"
#include "core/grading/number_rule.hpp"

namespace qdot::api {

enum class UnitRule { optional, required };

/// How numbers are compared. What is not given has the default of the rule's own system.
struct RuleRequest {
  Comparison kind{Comparison::relabs};
  std::optional<double> rtol{}, atol{};                  ///< relabs
  std::optional<std::int64_t> digits{};                  ///< sigfig, decdig
  std::optional<double> testoptions{};                   ///< stack_*
  std::optional<double> tolerance{};                     ///< webwork, and the two below
  std::optional<std::string> tol_type{};                 ///< "relative", "absolute"
  std::optional<double> zero_level{}, zero_tolerance{};  ///< zeroLevel, zeroLevelTol
  Json modulo{};                                         ///< null, a number or an expression, "2pi"
  bool any_order{};
  bool any_scale{};
  UnitRule unit{UnitRule::optional};
};

/// {"too_long": 5000000} stands for a text of so many bytes that was left out of a request.
inline constexpr const char* too_long = "too_long";

struct CheckItem {
  std::string id{};
  double points{1};
  Json expect{};
  Json submitted = Json::value_t::discarded;  ///< discarded: there is no answer
  std::optional<RuleRequest> rule{};
  Json names{};  ///< {"w": "Omega"}: the submission's words for symbols
};

struct CheckRequest {
  std::vector<CheckItem> items{};
  std::int64_t seed{};
  bool reveal{};
  GradeFormat format{GradeFormat::json};
};

[[nodiscard]] const RequestTable<CheckRequest>& check_table();

[[nodiscard]] Endpoint check_endpoint();

}  // namespace qdot::api
