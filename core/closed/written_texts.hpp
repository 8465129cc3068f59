#pragma once
// The numbers of a request as they were typed, from which formulas are made: "1/3" and "sqrt(2)" stay exact,
// where the numbers that motions are computed with are rounded.

#include <map>
#include <string>

namespace qdot {

/// What was written for a symbol, parameter or state: a decimal or an expression in SI. What is missing has
/// the scene's default.
using WrittenTexts = std::map<std::string, std::string>;

}  // namespace qdot
