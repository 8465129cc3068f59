#pragma once
// How long the answer of a sweep may be. A service holds it in memory, so it refuses one that would be too
// long, and does so while rows are made, as soon as what they have is too long. Whether it is depends on the
// request alone, not on the order in which threads make rows.

#include <cstddef>

#include "api/http/messages.hpp"
#include "api/http/problem.hpp"

namespace qdot::api {

/// Thrown for an answer that is longer than a service sends.
struct AnswerTooLong {};

class AnswerBound {
 public:
  explicit AnswerBound(Work work) : is_bounded_(work == Work::bounded) {}

  /// `bytes` are those of the answer as far as it is known. Throws AnswerTooLong, and Interrupted if nobody
  /// waits any more. Neither on someone's own machine, where who ends a sweep wants the rows that there are.
  void check(std::size_t bytes) const;

 private:
  bool is_bounded_;
};

[[nodiscard]] Problem answer_too_long();

}  // namespace qdot::api
