#pragma once
// The result of a check as the files that graders read:
//
//   gradescope    results.json: a test an item, each with its score
//   prairielearn  results.json of an external grader: gradable, score from 0 to 1, tests
//   coderunner    what a combinator template grader prints: fraction, and a table of results in HTML
//
// Sources: Gradescope, Autograder specifications; PrairieLearn, External grading; CodeRunner,
// Combinator-template grading.

#include "api/json/json.hpp"

namespace qdot::api {

enum class GradeFormat { json, gradescope, prairielearn, coderunner };

/// `grades` is the answer in JSON of our own.
[[nodiscard]] Json in_format(const Json& grades, GradeFormat format);

}  // namespace qdot::api
