#pragma once
// What the Taylor kernels work on. A slot of the tape becomes a row of coefficients, once in order and once
// reversed, so that the Cauchy product sum_j x_j y_{k-j} is a dot product of two runs of memory.
//
// The kernels are compiled twice, for AVX2 and for plain x86-64 (taylor_kernels_*.cpp). Both add in the same
// order, four partial sums that are joined at the end, and neither contracts multiply-adds, so their bits
// agree.

#include <cstddef>
#include <cstdint>

namespace qdot::taylor {

inline constexpr unsigned highest_order = 24;
/// x_k at row[k], and again at row[reversed - k].
inline constexpr unsigned stride = 2 * (highest_order + 1) + 2;
inline constexpr unsigned reversed = stride - 1;

enum class Kind : std::uint8_t {
  sum,          ///< operands: pairs (c, x), then triples (c, x, y); c is constant
  quotient,     ///< x, y
  power,        ///< x, exponent (constant)
  root,         ///< x
  sine_cosine,  ///< u; sine to out, cosine to out2; aux: k u_k
  exponential,  ///< u; aux: k u_k
  logarithm,    ///< u
  tangent,      ///< u; aux: k u_k, aux2: 1 + z^2 (or 1 - z^2 for the hyperbolic tangent)
  hyperbolic,   ///< u; cosh to out and sinh to out2, or the other way round; aux: k u_k
  arc,          ///< asin, acos, atan by z' = sign u'/w; aux: k u_k, aux2: w
  solve         ///< see Solve
};

/// M x = f for n unknowns and one right-hand side.
struct Solve {
  std::uint32_t n;
  const double* const* matrix;  ///< n x n rows of coefficients; null where M_ij is constant in time
  const double* const* right;   ///< n rows
  double* const* unknowns;      ///< n rows
  /// x from f_k - sum_j M_j x_{k-j}, in place.
  void (*substitute)(const void* factors, double* b);
  const void* factors;
};

struct Step {
  Kind kind{};
  std::uint16_t pairs{}, triples{};
  double constant{};  ///< exponent; sign of an arc or a tangent
  const double* const* operands{};
  double* out{};
  double* out2{};
  double* aux{};
  double* aux2{};
  const Solve* solve{};
};

/// y' = v for the first half of the state, y' = a for the second.
struct State {
  std::size_t n;
  double* const* rows;                 ///< 2n rows, q then v
  const double* const* accelerations;  ///< n rows
};

struct Program {
  const Step* steps;
  std::size_t count;
  State state;
};

/// Coefficients 1 .. order of every row; coefficient 0 is there. Rows of the state get one more than the
/// others.
using Kernel = void (*)(const Program& program, unsigned order);

namespace plain {
void expand(const Program& program, unsigned order);
}
namespace avx2 {
void expand(const Program& program, unsigned order);
}

}  // namespace qdot::taylor
