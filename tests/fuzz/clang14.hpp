#pragma once
// Included before all else in the programs of libFuzzer: clang 14 does not deduce the arguments of an
// aggregate template by itself (P1816), as GCC and later clangs do.

#include "core/expr/expression.hpp"

namespace qdot {

template <class... Cases>
overloaded(Cases...) -> overloaded<Cases...>;

}  // namespace qdot
