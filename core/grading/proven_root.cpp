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
      : unknowns_(system.unknowns()),
        right_(right),
        random_(seed),
        residuals_(residuals.begin(), residuals.end()),
        roots_(with_slopes()),
        values_(roots_) {}

  /// Whether another root than the right one is proven at the state.
  bool finds_another(State& state) {
    if (!right_.set(state, values_)) return false;
    std::vector<double> known;
    for (const Ball& a : right_.solution()) known.push_back(a.value());
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

  /// Krawczyk's test on the box about x, when that does not hold the right accelerations.
  bool is_another_root(const std::vector<double>& x) {
    const double radius = box_size * size_of(x);
    bool is_apart = false;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Ball gap = right_.solution()[i] - Ball(x[i]);
      is_apart = is_apart || std::abs(gap.value()) > gap.radius + 2 * radius;
    }
    if (!is_apart) return false;
    evaluate_at(as_balls(x, 0));
    const auto inverse = inverted(seen_slopes());
    if (!inverse) return false;
    const std::vector<Ball> residuals = seen_residuals();
    evaluate_at(as_balls(x, radius));
    return krawczyk_image(*inverse, residuals, seen_slopes(), radius).has_value();
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
      State state = states.next();
      if (search.finds_another(state)) return {OtherSolutions::some, state};
    }
    return {};
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return {};
  }
}

}  // namespace qdot
