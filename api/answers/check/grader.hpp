#pragma once
// What judges one submission, and what its makers work with.

#include <cstdint>
#include <functional>

#include "api/answers/asking.hpp"
#include "api/answers/check/request.hpp"
#include "api/answers/check/verdict.hpp"

namespace qdot::api {

using Grader = std::function<Verdict(const Json& submitted)>;

/// What a reader of expectations works with.
struct ExpectationScope {
  const Asking& asking;
  AskedOnce& once;
  const FindSystem& find_system;
  Models& models;
  std::uint64_t seed{};
  bool reveal{};
};

}  // namespace qdot::api
