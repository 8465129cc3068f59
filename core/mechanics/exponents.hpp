#pragma once
// Parameters as exponents: x^n, n a parameter. Read as exp(n log x) it has a value for positive x only, and
// x^2 has one everywhere. So where n is known, and is a fraction that a power may have, it is put in.

#include <map>
#include <set>
#include <span>
#include <string>

#include "core/expr/expression.hpp"

namespace qdot {

/// By the parameter's name.
using ExponentValues = std::map<std::string, Number>;

/// e with the exponents that consist of `values` put in. `parameters`: those that an exponent may consist of;
/// the names of those that one does are added to `found`.
[[nodiscard]] Expression with_exponents(const Expression& e, std::span<const Expression> parameters,
                                        const ExponentValues& values, std::set<std::string>& found);

}  // namespace qdot
