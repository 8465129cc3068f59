#include "api/answers/sweep/answer_bound.hpp"

#include <string>

#include "api/json/limits.hpp"
#include "core/base/work.hpp"

namespace qdot::api {

void AnswerBound::check(std::size_t bytes) const {
  if (!is_bounded_) return;
  check_interruption();
  if (bytes > limits::sweep_answer_bytes) throw AnswerTooLong();
}

Problem answer_too_long() {
  return {.kind = ProblemKind::limit_exceeded,
          .detail = "The answer would be longer than " + std::to_string(limits::sweep_answer_bytes) +
                    " bytes. Ask for fewer rows or columns, in several requests; or use qdot sweep on a "
                    "machine of your own, which has no such limit."};
}

}  // namespace qdot::api
