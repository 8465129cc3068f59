#pragma once
// Numbers and names that people put at their equations: "(1) ... (2) ...", "1. ...", "x: ...", "... = 0 (2)".

#include <vector>

#include "core/grading/student_tokens.hpp"

namespace qdot {

/// The tokens without such labels. Numbers are labels where the lines are counted by them from 1; one before
/// a closing bracket that was not opened always is.
[[nodiscard]] std::vector<StudentToken> without_labels(const std::vector<StudentToken>& tokens);

}  // namespace qdot
