#pragma once
// What the Taylor recurrences in double-doubles work on. A slot of the tape becomes a row of coefficients,
// their high and their low parts, each once in order and once reversed, so that the Cauchy product
// sum_j x_j y_{n-j} runs through memory in one direction. What is not known yet is 0.
//
// As the kernels for doubles (core/compile/taylor), these are compiled twice, with fused multiply-adds and
// without; both give the same bits.

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/numerics/double_double.hpp"
#include "core/numerics/linear_system.hpp"

namespace qdot::extended {

inline constexpr unsigned highest_order = 40;

/// Four runs of memory: high and low parts of coefficients 0, 1, ..., and the same backwards from `last`.
inline constexpr std::size_t run_length = highest_order + 8;
inline constexpr std::size_t last = run_length - 4;  ///< before it and beyond it four zeros
inline constexpr std::size_t row_length = 4 * run_length;

enum class Kind : std::uint8_t {
  sum,       ///< out = sum of factor x, and of factor x y
  rate,      ///< out = x': coefficient k - 1 is k x_k
  integral,  ///< out' = factor x
  quotient,  ///< x/y; inverse: 1/y_0
  root,      ///< square root of x; inverse: 1/(2 sqrt(x_0))
  solve,     ///< M x = f
  still      ///< out keeps its coefficient 0: a quotient or function that has reached its limit
};

struct Term {
  DoubleDouble factor;
  const double* x{};
};
struct Product {
  DoubleDouble factor;
  const double* x{};
  const double* y{};
};

/// M x = f for n unknowns and one right-hand side.
struct System {
  std::size_t n{};
  const double* const* matrix{};  ///< n x n rows, null where M_ij is constant in time
  const double* const* right{};   ///< n rows
  double* const* unknowns{};      ///< n rows
  const DoubleDouble* inverse{};  ///< of M_0, n x n
};

struct Step {
  Kind kind{};
  Kind usual{};              ///< what a step that is still was, and may be again
  const double* argument{};  ///< of exp and tanh, which reach limits; null of others
  /// 1 for rows of rates, whose coefficient k - 1 is found with the others' coefficient k.
  unsigned lag{};
  std::span<const Term> terms{};
  std::span<const Product> products{};
  DoubleDouble factor;
  const double* x{};
  const double* y{};
  double* out{};
  DoubleDouble inverse;
  const System* system{};
};

/// y' = v for the first half of the state, y' = a for the second.
struct State {
  std::size_t n{};
  double* const* rows{};                 ///< 2n rows, q then v
  const double* const* accelerations{};  ///< n rows
};

struct Program {
  std::span<const Step> steps{};
  State state{};
};

/// Coefficients 1 .. order of every row; coefficient 0 is there.
using Kernel = void (*)(const Program& program, unsigned order);

namespace plain {
void expand(const Program& program, unsigned order);
}
namespace fma {
void expand(const Program& program, unsigned order);
}

}  // namespace qdot::extended
