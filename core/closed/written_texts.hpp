#pragma once

#include <map>
#include <string>

namespace qdot {

/// What was written for a symbol, parameter or state: a decimal or an expression in SI. What is missing has
/// the scene's default.
using WrittenTexts = std::map<std::string, std::string>;

}  // namespace qdot
