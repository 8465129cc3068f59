#include "core/grading/proven_root.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/expr/calculus.hpp"
#include "core/grading/ball_system.hpp"

namespace qdot {
namespace {

constexpr std::uint64_t work_on_roots = 100'000;
constexpr int states_of_search = 6;
constexpr int starts_at_a_state = 8;
constexpr int most_steps = 30;
constexpr double box_size = 1e-9;  // of the root

double size_of(const std::vector<double>& x) {
  double size = 1;
  for (const double component : x) size = std::max(size, std::abs(component));
  return size;
}

std::vector<Ball> as_balls(const std::vector<double>& x, double radius) {
  std::vector<Ball> balls;
  for (const double component : x) balls.emplace_back(DoubleDouble(component), radius);
  return balls;
}

class RootSearch {
 public:
  RootSearch(const ExpectedSystem& system, RightMotion& right, std::span<const Expression> residuals,
             std::uint64_t seed)
      : unknowns_(system.symbols().coordinates.second_rate),
        right_(right),
        random_(seed),
        residuals_(residuals.begin(), residuals.end()),
        roots_(with_slopes()),
        values_(roots_) {}

  /// Whether another root than the right one is proven at the state.
  bool finds_another(const State& state) {
    for (std::size_t k = 0; k < state.size(); ++k) values_.set(right_.symbols()[k].symbol, state[k]);
    if (!right_.at(state)) return false;
    std::vector<double> known;
    for (const Ball& a : right_.accelerations()) known.push_back(a.value());
    for (int start = 0; start < starts_at_a_state; ++start) {
      std::vector<double> x = known;
      for (double& component : x) component = start == 0 ? -component : away(component, size_of(known));
      if (approach(x) && is_another_root(x)) return true;
    }
    return false;
  }

 private:
  std::vector<Expression> with_slopes() {
    std::vector<Expression> all = residuals_;
    for (const Expression& r : residuals_) {
      for (const Expression& a : unknowns_) all.push_back(differentiate(r, a));
    }
    return all;
  }

  double away(double component, double size) { return component + size * 6 * (random_.fraction() - 0.5); }

  void evaluate_at(const std::vector<Ball>& x) {
    for (std::size_t i = 0; i < x.size(); ++i) values_.set(unknowns_[i], x[i]);
    values_.evaluate();
  }
  [[nodiscard]] std::vector<Ball> seen_residuals() const {
    std::vector<Ball> r;
    for (const Expression& residual : residuals_) r.push_back(values_.of(residual));
    return r;
  }
  [[nodiscard]] BallMatrix seen_slopes() const {
    BallMatrix rows(residuals_.size());
    for (std::size_t k = residuals_.size(); k < roots_.size(); ++k)
      rows[k / unknowns_.size() - 1].push_back(values_.of(roots_[k]));
    return rows;
  }

  /// Newton's method, from x and into x.
  bool approach(std::vector<double>& x) {
    for (int step = 0; step < most_steps; ++step) {
      evaluate_at(as_balls(x, 0));
      const auto way = solved(seen_slopes(), seen_residuals());
      if (!way) return false;
      double length = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] -= (*way)[i].value();
        length = std::max(length, std::abs((*way)[i].value()));
      }
      if (!std::isfinite(size_of(x))) return false;
      if (length < 1e-14 * size_of(x)) return true;
    }
    return false;
  }

  /// The columns of dr/dx at x, inverted; none where that is singular.
  [[nodiscard]] std::optional<BallMatrix> inverse_of_slopes() const {
    const BallMatrix slopes = seen_slopes();
    BallMatrix columns;
    for (std::size_t j = 0; j < slopes.size(); ++j) {
      std::vector<Ball> unit(slopes.size(), Ball(0.0));
      unit[j] = Ball(1.0);
      const auto column = solved(slopes, unit);
      if (!column) return std::nullopt;
      columns.push_back(*column);
    }
    return transposed(columns);
  }

  /// Krawczyk's test on the box about x, when that does not hold the right accelerations.
  bool is_another_root(const std::vector<double>& x) {
    const double radius = box_size * size_of(x);
    bool is_apart = false;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Ball gap = right_.accelerations()[i] - Ball(x[i]);
      is_apart = is_apart || std::abs(gap.value()) > gap.radius + 2 * radius;
    }
    if (!is_apart) return false;
    evaluate_at(as_balls(x, 0));
    const auto inverse = inverse_of_slopes();
    if (!inverse) return false;
    const std::vector<Ball> residuals = seen_residuals();
    evaluate_at(as_balls(x, radius));
    const BallMatrix slopes = seen_slopes();
    for (std::size_t i = 0; i < x.size(); ++i) {
      Ball image(0.0);  // K - x
      for (std::size_t j = 0; j < x.size(); ++j) {
        Ball rest(i == j ? 1.0 : 0.0);
        for (std::size_t k = 0; k < x.size(); ++k) rest = rest - (*inverse)[i][k] * slopes[k][j];
        image = image - (*inverse)[i][j] * residuals[j] + rest * Ball(DoubleDouble(0.0), radius);
      }
      if (!image.is_finite() || !(image.magnitude() < radius)) return false;
    }
    return true;
  }

  std::vector<Expression> unknowns_;
  RightMotion& right_;
  RandomBits random_;
  std::vector<Expression> residuals_, roots_;  ///< roots: residuals, then their slopes by rows
  BallValues values_;
};

}  // namespace

OtherSolutionsAnswer proven_other_root(const ExpectedSystem& system, RightMotion& right,
                                       std::span<const Expression> residuals, std::uint64_t seed) {
  try {
    const WorkScope scope(work_on_roots);
    RootSearch search(system, right, residuals, seed);
    SampledStates states(right.symbols(), seed + 1);
    for (int i = 0; i < states_of_search; ++i) {
      const State state = states.next();
      if (search.finds_another(state)) return {OtherSolutions::some, state};
    }
    return {};
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return {};
  }
}

}  // namespace qdot
