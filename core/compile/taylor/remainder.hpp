#pragma once
// What a Taylor step may hide: a bound of its defect over the whole step.
//
// The rows of an expansion of order N are polynomials p in s, 0 <= s <= h. Along the polynomials of the state
// each slot of the tape has a true value, and the row of the slot differs from it by no more than a number r:
//
//   product   x y - row = (x - p_x) p_y + p_x (y - p_y) + (x - p_x)(y - p_y) + terms of order >= N,
//   and so on for every instruction (remainder_rules.cpp), each in O(N).
//
// Terms of order >= m of a product are  tail_m(a, b) = sum_i A_i(a) T_{max(m-i,0)}(b)  with A_k = |c_k| h^k
// and T_k = sum_{j>=k} A_j. Roughly, on the disc of radius g = h/rho, rho < 1, by one multiplication: with
// ||a|| = sum_k |a_k| g^k and  T_k <= rho^k/(1-rho) max_j |b_j| g^j  they are at most
// rho^m ||a|| max_j |b_j| g^j / (1-rho).  In the end r of an acceleration is the defect |p'' - a(t, p, p')|.
// Where rows cannot tell (exp(-2500) = 0 and all its coefficients), the interval operation does.
//
// Rounding is left out (rounding.hpp has it), except for what it may hide: a function that has become 0 or
// constant by it, or a row that belongs to another function by it, as 1 - s to sqrt((1 - s)^2 + 1e-16).
// Sources: Makino, Berz, Taylor models and other validated functional inclusion methods, Int. J. Pure Appl.
// Math. 4 (2003) 379; Neher, Jackson, Nedialkov, On Taylor model based integration of ODEs, SIAM J. Numer.
// Anal. 45 (2007) 236.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "core/compile/taylor/kernels.hpp"
#include "core/compile/taylor/range.hpp"

namespace qdot::taylor {

/// Of a polynomial, as a share of its terms: (t/w)^8 is 0 somewhere.
inline constexpr double rounding_of_sums = 8 * std::numeric_limits<double>::epsilon();

class Remainder {
 public:
  /// Keeps pointers into the program, which must outlive it.
  Remainder(const Program& program, const Kernels& kernels);

  /// Bounds over 0 <= s <= h of |p_i'(s) - f_i(t + s, p(s))| for y = (q, v), for the rows of an expansion of
  /// that order; infinite where there is none. Returns the largest of h defect_i / allowed_i.
  double bound(double h, unsigned order, std::span<const double> allowed, std::span<double> defect);
  /// The same bounds, and the closest of them, whatever is allowed.
  void closest(double h, unsigned order, std::span<double> defect);
  /// The closest ranges that there are of what stands in the rows, for bounds of their rounding.
  void find_ranges(double h, unsigned order);

  /// The same where the rows of the state are given: what each lacks of the motion, and how far
  /// then what stands in `row` may be from it; roughly where that leaves no doubt of its sign.
  double distance(const double* row, double h, unsigned order, std::span<const double> missing_of_state);

  /// After distance(): what stands in the rows has no value anywhere in the step, as a root of what is
  /// negative all along.
  [[nodiscard]] bool is_without_value() const;

  /// Of M x = f over the step that was bounded last, x_1 standing in the row `first_unknown`: by how much
  /// every solution may change where f does by `rho`.
  using Index = std::uint32_t;
  void bound_solution_of(Index first_unknown, std::span<const double> rho, std::span<double> error) const;

 private:
  friend class Rounding;

  /// rough: products by norms. quick: by their terms. careful: ranges by interval operations too.
  enum class Effort { rough, quick, careful };

  struct Row : RowSizes {
    unsigned missing{1};  ///< orders that the row lacks: 0 for a state, 2 for a rate
    bool is_factor{};     ///< its size counts, not only r
    double r{};
    double argument_r{};  ///< of what the row is the rate of
    double own_top{};     ///< A_N of a state: what a sum that contains it does not have
    Range of_argument;    ///< of what it is the rate of, as far as that is known
    Range of_row;         ///< of the polynomial
    Range of_value;       ///< of what it stands for
    double t3{};          ///< as t2, where the terms are known
    /// A_k; T_{N-k}, and T_0 once more. Not where norms will do.
    alignas(32) std::array<double, highest_order + 8> a{}, reversed_tails{};
  };
  struct Factor {
    double factor{};
    Index x{}, y{};
  };
  struct Rule {
    Kind kind{};
    const double* constant{};  ///< of the step: abs and sign change it
    Index x{}, y{}, out{}, out2{}, aux{};
    const double* argument{};
    std::vector<Factor> terms{}, products{};
    const Solve* solve{};
    std::vector<Index> matrix{}, right{}, unknowns{};  ///< of a solve
  };

  [[nodiscard]] Index index_of(const double* row);
  [[nodiscard]] Rule rule_for(const Step& step);
  void mark_factors(const Rule& rule);
  void collect_factors();
  void begin(double h, unsigned order);
  void put_missing(std::span<const double> missing_of_state);
  /// rho: by the last and the first coefficients of the velocities.
  [[nodiscard]] double decay() const;
  void take_norms();
  void take_degrees();
  /// Careful looks need those of all rows, quick ones of factors.
  void take_tails(std::span<RowSizes* const> rows);
  void take_sizes(Row& row);
  void sum_tails(RowSizes* const* four);
  void take_range(Row& row);
  void look(Effort effort);
  void look_carefully();
  [[nodiscard]] bool operations_may_tell_more() const;
  /// |c_k| h^k
  [[nodiscard]] double size(const Row& row, unsigned k) const {
    if (k + row.missing > order_) return 0;  // what stands there is of another expansion
    return std::abs(row.coefficients[k]) * powers_[k];
  }
  /// Of two rows of the state side by side: sum_k |c_k| h^k, and sum_k k |c_k| h^k.
  [[nodiscard]] std::array<double, 2> sums_of_sizes(Index first, Index second) const;
  [[nodiscard]] std::array<double, 2> sums_of_slopes(Index first, Index second) const;
  void put_defect(std::span<double> defect) const;
  double excess(std::span<const double> allowed, std::span<double> defect) const;

  void apply(const Rule& rule);
  void apply_sum(const Rule& rule);
  void apply_rate(const Rule& rule);
  void apply_quotient(const Rule& rule);
  void apply_power(const Rule& rule);
  void apply_root(const Rule& rule);
  void apply_sine_cosine(const Rule& rule);
  void apply_exponential(const Rule& rule);
  void apply_logarithm(const Rule& rule);
  void apply_tangent(const Rule& rule);
  void apply_hyperbolic(const Rule& rule);
  void apply_arc(const Rule& rule);
  void apply_kink(const Rule& rule);
  void apply_solve(const Rule& rule);
  /// By how much each unknown changes where the right-hand sides do by rho.
  void bound_solution_of(const Rule& rule, std::span<const double> rho, std::span<double> error) const;
  bool bound_pair(const Rule& rule, std::span<const double> rho, std::span<double> error) const;
  bool bound_triple(const Rule& rule, std::span<const double> rho, std::span<double> error) const;
  void bound_unknowns(const Rule& rule, std::span<const double> rho, std::span<double> error) const;

  /// sum_{i+j >= N} |a_i b_j| h^(i+j), and the same from N - 1 on.
  [[nodiscard]] double tail(const Row& a, const Row& b) const;
  [[nodiscard]] static double product_norm(const Row& a, const Row& b);
  [[nodiscard]] double tail_of_rate(const Row& rate, const Row& b) const;
  [[nodiscard]] double hidden_by_rounding(const Row& divisor, double factor) const;
  /// By how much x is on the other side of zero than at s = 0.
  [[nodiscard]] double beyond_kink(const Row& x, double side) const;
  /// How far an argument moves from its value at s = 0, by its rate.
  [[nodiscard]] Range variation(const Row& rate) const;
  /// How far what a row stands for is from its first three terms, or four.
  [[nodiscard]] double beyond_second(const Row& row) const;
  [[nodiscard]] double beyond_third(const Row& row) const;
  [[nodiscard]] Range argument(const Rule& rule) const;
  void conclude(Row& row, double r) const;
  void meet(Row& row, const Range& by_operation) const;

  std::map<const double*, Index> indices_;
  std::vector<Row> rows_;
  std::vector<Rule> rules_;
  std::size_t n_{};           ///< degrees of freedom
  std::vector<Index> state_;  ///< q, then v, then accelerations that are given
  std::vector<Index> accelerations_;
  using Powers = std::array<double, highest_order + 5>;
  Powers powers_{};  ///< h^k
  Powers radii_{};   ///< g^k
  Measure measure_{};
  std::vector<RowSizes*> factors_, others_;  ///< Rows; the last of them again up to a multiple of four
  double beyond_{};                          ///< 1/(1 - rho)
  double rho_{}, rho3_{}, rho_of_rate_{}, rho_of_value_{};  ///< rho, and its powers 3, N - 1 and N
  double h_{};
  unsigned order_{}, order_of_degrees_{};  ///< 0: degrees are not taken
  Effort effort_{Effort::quick};
};

}  // namespace qdot::taylor
