#pragma once
// What the Taylor kernels work on. A slot of the tape becomes a row of coefficients, once in order and once
// reversed, so that the Cauchy product sum_j x_j y_{k-j} is a dot product of two runs of memory.
//
// The kernels are compiled twice, for AVX2 and for plain x86-64 (kernels_*.cpp). Both add in the same
// order, four partial sums that are joined at the end,
// and neither contracts multiply-adds, so their bits agree.

#include <cstddef>
#include <cstdint>

#include "core/numerics/linear_system.hpp"
#include "core/numerics/pairs.hpp"

namespace qdot::taylor {

inline constexpr unsigned highest_order = 32;
inline constexpr unsigned highest_order_of_pairs = 24;
template <class Number>
inline constexpr unsigned highest_order_of = highest_order;
template <>
inline constexpr unsigned highest_order_of<PairOfDoubles> = highest_order_of_pairs;
/// x_k at row[k], and again at row[reversed - k]: near the pointer, so that the kernels' code is short.
inline constexpr int reversed = -1;
inline constexpr unsigned before_row = 36;
inline constexpr unsigned stride = before_row + highest_order + 4;

enum class Kind : std::uint8_t {
  sum,      ///< out = sum of factor x, and of factor x y
  sum_1_0,  ///< the same with so many terms and products
  sum_2_0,
  sum_0_1,
  sum_1_1,
  sum_2_1,
  sum_3_1,
  sum_0_2,
  sum_1_2,
  sum_2_2,
  rate,         ///< coefficient k - 1 of out: k x_k
  rate_of_sum,  ///< coefficient k - 1 of out: sum of factor x_{k-1}, x the rates
  quotient,     ///< x/y; aux: 1/y_0
  power,        ///< x^constant
  root,         ///< x; aux: 1/(2 sqrt(x_0))
  sine_cosine,  ///< sine to out, cosine to out2; x: the argument's rate
  exponential,  ///< x: the argument's rate
  logarithm,    ///< x
  tangent,      ///< x: the argument's rate; aux: 1 + z^2 (or 1 - z^2 for the hyperbolic tangent)
  hyperbolic,   ///< cosh to out and sinh to out2, or the other way round; x: the argument's rate
  absolute,     ///< constant x, on one side of the kink
  sign,         ///< constant
  arc,          ///< asin, acos, atan by z' = sign u'/w; x: the argument's rate, y: w
  solve,        ///< see Solve
  solve_2,      ///< the same with two unknowns
  solve_3,
  still  ///< out keeps its coefficient 0: a quotient or function that has reached its limit
};

template <class Number>
struct BasicTerm {
  Number factor{};
  const Number* x{};
};
template <class Number>
struct BasicProduct {
  Number factor{};
  const Number* x{};
  const Number* y{};
  Number x_0{};  ///< factor x_0
  Number y_0{};  ///< factor y_0
};
/// M_ij = factor m + constant; m null where M_ij is constant in time.
template <class Number>
struct BasicEntry {
  Number factor{};
  const Number* m{};
  Number x_0{};  ///< factor x_0, x the unknown that it belongs to
};

/// M x = f for n unknowns and one right-hand side.
template <class Number>
struct BasicSolve {
  std::uint32_t n{};
  const BasicEntry<Number>* matrix{};  ///< n x n
  const Number* const* right{};        ///< n rows
  Number* const* unknowns{};           ///< n rows
  const Number* inverse{};             ///< of M_0, n x n
  const Number* const* start{};        ///< n x n: the values of M_0
};

template <class Number>
struct BasicStep {
  Kind kind{};
  Kind usual{};  ///< what a step that is still was, and may be again
  std::uint16_t term_count{}, product_count{};
  Number constant{};  ///< exponent; of a sum; sign of an arc or a tangent; of what stands in abs or sign; 1:
                      ///< out is cosh
  const BasicTerm<Number>* terms{};
  const BasicProduct<Number>* products{};
  const Number* x{};
  const Number* y{};
  Number* out{};
  Number* out2{};
  Number* aux{};
  const BasicSolve<Number>* solve{};
  const Number* argument{};  ///< the value u_0, where x is the rate of u
};

/// y' = v for the first half of the state, y' = a for the second.
template <class Number>
struct BasicState {
  std::size_t n{};
  Number* rows{};                        ///< q then v, one after the other
  const Number* const* accelerations{};  ///< n rows
  std::size_t count{};                   ///< of rows: 2n, and more where accelerations are given as well
};

template <class Number>
struct BasicProgram {
  const BasicStep<Number>* steps{};
  std::size_t count{};
  BasicState<Number> state{};
};

using Term = BasicTerm<double>;
using Product = BasicProduct<double>;
using Entry = BasicEntry<double>;
using Solve = BasicSolve<double>;
using Step = BasicStep<double>;
using Program = BasicProgram<double>;
using PairProgram = BasicProgram<PairOfDoubles>;

/// Coefficients 1 .. order of every row; coefficient 0 is there. Rows of the state get one more than the
/// others, rows of rates begin with what they get in the first pass.
using Kernel = void (*)(const Program& program, unsigned order);
using PairKernel = void (*)(const PairProgram& program, unsigned order);

/// How large a row is over 0 <= s <= h, roughly (remainder.hpp): g = h/rho.
struct RowSizes {
  const double* coefficients{};
  unsigned degree{};        ///< the last order that counts; later ones may be no numbers
  double norm{}, peak{};    ///< sum_{k>=1} |c_k| g^k, max_{k>=1} |c_k| g^k / (1 - rho) or the same
  double t0{}, t2{};        ///< bounds of sum_{k>=0} |c_k| h^k and from k = 2 on
  double lower{}, upper{};  ///< of the polynomial
};
struct SizeScales {
  double h{}, h2{};         ///< and its square
  double beyond{}, rho3{};  ///< 1/(1 - rho), rho^3
  double rounding{};        ///< of a sum, as a share of its terms
  const double* powers{};   ///< g^k, with room for four after the last
};
/// So many rows, a multiple of four; one may be there several times.
using Measure = void (*)(RowSizes* const* rows, unsigned count, const SizeScales& scales);

struct Kernels {
  Kernel expand{};
  PairKernel expand_pair{};
  Measure measure{};
};

/// The fastest that the processor has.
[[nodiscard]] Kernels best_kernels();
[[nodiscard]] Kernels plain_kernels();

namespace plain {
void expand(const Program& program, unsigned order);
void expand_pair(const PairProgram& program, unsigned order);
void measure(RowSizes* const* rows, unsigned count, const SizeScales& scales);
}  // namespace plain
namespace avx2 {
void expand(const Program& program, unsigned order);
void expand_pair(const PairProgram& program, unsigned order);
void measure(RowSizes* const* rows, unsigned count, const SizeScales& scales);
}  // namespace avx2

}  // namespace qdot::taylor
