#pragma once
// What became of one submission: correct, wrong, unreadable or undecided, and what the student is told.

#include <optional>
#include <string>
#include <vector>

#include "api/json/json.hpp"

namespace qdot::api {

struct Verdict {
  std::optional<bool> correct{};  ///< none: it could not be read, or could not be decided
  std::string decided_by{};       ///< "rule", "identity", "values", "counterexample", ...
  Json understood{};              ///< the submission as it was read
  std::vector<std::string> feedback{};
  std::vector<std::string> format_errors{};  ///< why it could not be read
  Json diagnosis{};
  Json counterexample{};
  Json expected{};  ///< leaves only where the request asks for it (reveal)
};

[[nodiscard]] inline Verdict unreadable(std::string why) { return {.format_errors = {std::move(why)}}; }

/// It was read, and no verdict can be given.
[[nodiscard]] inline Verdict undecided(std::string why) { return {.feedback = {std::move(why)}}; }

}  // namespace qdot::api
