#pragma once
// Parameters as exponents: x^n, n a parameter. Read as exp(n log x) it has a value for positive x only, and
// x^2 has one everywhere. So where n is known, and is a fraction that a power may have, it is put in, unless
// x is positive anyway: formulas keep their n then.

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

/// By the parameter's name.
using ExponentValues = std::map<std::string, Number>;

/// What a scene's symbols are to its exponents.
struct ExponentSymbols {
  std::vector<Expression> parameters;  ///< an exponent may consist of
  std::set<std::string> positive;      ///< all symbols that are, by their domains
};

struct Scene;
struct Symbols;

/// Those of a scene; velocities have any sign.
[[nodiscard]] ExponentSymbols exponent_symbols_of(const Scene& scene, const Symbols& symbols);

struct FoundExponents {
  std::set<std::string> names;  ///< parameters that are exponents of what may be negative
  ExponentValues put_in;        ///< those of them that are put in
};

/// e with the exponents that consist of `values` put in; what was met is added to `found`.
[[nodiscard]] Expression with_exponents(const Expression& e, const ExponentSymbols& symbols,
                                        const ExponentValues& values, FoundExponents& found);

}  // namespace qdot
