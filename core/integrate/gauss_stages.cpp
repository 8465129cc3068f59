#include "core/integrate/gauss_stages.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace qdot {
namespace {

constexpr double root_15 = 3.8729833462074168852;
constexpr double r = root_15 / 120;
constexpr std::array<double, gauss_stages> nodes_of_gauss{0.5 - 12 * r, 0.5, 0.5 + 12 * r};
constexpr std::array<double, gauss_stages> eighteen_b{5, 8, 5};
constexpr std::array<std::array<double, gauss_stages>, gauss_stages> m{{{0, -8, -4}, {5, 0, -5}, {4, 8, 0}}};

constexpr unsigned most_iterations = 40;
constexpr unsigned most_newton_iterations = 40;
constexpr unsigned jacobian_lasts = 5;      // iterations of Newton's
constexpr double growth_of_the_lost = 1e3;  // of the changes, over the least of them
// Changes that have stopped falling are round-off where they are below these shares of the component or, for
// components that are round-off themselves, of the largest component.
constexpr double round_off = 1e-8;
constexpr double round_off_of_largest = 1e-13;

double weight(std::size_t i, std::size_t j) { return eighteen_b[j] / 36 + r * m[i][j]; }

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// 1 - h A (x) J.
Eigen::MatrixXd stage_matrix(double h, const RowMajor& jacobian) {
  const Eigen::Index n = jacobian.rows();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(gauss_stages * n, gauss_stages * n);
  for (std::size_t i = 0; i < gauss_stages; ++i) {
    for (std::size_t j = 0; j < gauss_stages; ++j) {
      matrix.block(static_cast<Eigen::Index>(i) * n, static_cast<Eigen::Index>(j) * n, n, n) -=
          h * weight(i, j) * jacobian;
    }
  }
  return matrix;
}

}  // namespace

const std::array<double, gauss_stages>& GaussStages::nodes() { return nodes_of_gauss; }

GaussStages::GaussStages(Evaluator& evaluator, std::size_t dimension, bool has_jacobian)
    : evaluator_(evaluator),
      n_(dimension),
      has_jacobian_(has_jacobian),
      increments_(gauss_stages * dimension),
      attempt_(gauss_stages * dimension),
      stage_(dimension),
      sizes_(dimension),
      components_(dimension) {}

Answer GaussStages::solve(const Beginning& begin, double h, std::span<double> slopes) {
  if (!newton_) {
    const Answer answer = iterate_fixed_point(begin, h, slopes);
    if (answer != answer_retry || !has_jacobian_) return answer;
    newton_ = true;
  }
  return iterate_newton(begin, h, slopes);
}

double GaussStages::rise(double h, std::span<const double> slopes, std::size_t i) const {
  const double sum = 5 * (slopes[i] + slopes[2 * n_ + i]) + 8 * slopes[n_ + i];
  return h * sum / 18;
}

Answer GaussStages::iterate_fixed_point(const Beginning& begin, double h, std::span<double> slopes) {
  set_attempt(h, slopes);
  increments_ = attempt_;
  start_watching();
  while (iterations_ < most_iterations) {
    if (const Answer answer = evaluate(begin, h, slopes); answer != answer_ok) return answer;
    set_attempt(h, slopes);
    const State state = take_attempt(begin);
    if (state == State::settled) return answer_ok;
    if (state == State::lost) break;
  }
  return answer_retry;
}

// From Z_i = z: the first iterate is then the solution of the linearized motion.
Answer GaussStages::iterate_newton(const Beginning& begin, double h, std::span<double> slopes) {
  const auto n = static_cast<Eigen::Index>(n_);
  std::ranges::fill(increments_, 0.0);
  start_watching();
  RowMajor jacobian(n, n);
  Eigen::PartialPivLU<Eigen::MatrixXd> factors;
  const Eigen::Map<const Eigen::VectorXd> increments(increments_.data(), gauss_stages * n);
  Eigen::Map<Eigen::VectorXd> attempt(attempt_.data(), gauss_stages * n);
  while (iterations_ < most_newton_iterations) {
    if (iterations_ % jacobian_lasts == 0) {
      set_stage(begin, 1);
      const Answer answer = evaluator_.jacobian(begin.t + h / 2, stage_, {jacobian.data(), n_ * n_});
      if (answer != answer_ok) return answer;
      factors.compute(stage_matrix(h, jacobian));
    }
    if (const Answer answer = evaluate(begin, h, slopes); answer != answer_ok) return answer;
    set_attempt(h, slopes);
    attempt = (increments + factors.solve(attempt - increments)).eval();
    if (take_attempt(begin) == State::settled) return answer_ok;
  }
  return answer_retry;
}

void GaussStages::set_stage(const Beginning& begin, std::size_t j) {
  for (std::size_t i = 0; i < n_; ++i) {
    stage_[i] = begin.z[i] + (increments_[j * n_ + i] + begin.carried[i]);
  }
}

Answer GaussStages::evaluate(const Beginning& begin, double h, std::span<double> slopes) {
  for (std::size_t j = 0; j < gauss_stages; ++j) {
    set_stage(begin, j);
    const double t = begin.t + nodes_of_gauss[j] * h;
    const Answer answer = evaluator_.derivative(t, stage_, slopes.subspan(j * n_, n_));
    if (answer != answer_ok) return answer;
  }
  return answer_ok;
}

void GaussStages::set_attempt(double h, std::span<const double> slopes) {
  for (std::size_t k = 0; k < n_; ++k) {
    const double half = rise(h, slopes, k) / 2;
    for (std::size_t i = 0; i < gauss_stages; ++i) {
      double rest = 0;
      for (std::size_t j = 0; j < gauss_stages; ++j) rest += m[i][j] * slopes[j * n_ + k];
      attempt_[i * n_ + k] = half + h * r * rest;
    }
  }
}

void GaussStages::start_watching() {
  iterations_ = 0;
  least_change_ = std::numeric_limits<double>::infinity();
  std::ranges::fill(components_, Component{.last = {least_change_, least_change_}});
}

GaussStages::State GaussStages::take_attempt(const Beginning& begin) {
  std::ranges::fill(stage_, 0.0);  // largest changes
  std::ranges::fill(sizes_, 0.0);
  for (std::size_t k = 0; k < attempt_.size(); ++k) {
    const std::size_t i = k % n_;
    if (!std::isfinite(attempt_[k])) return State::lost;
    stage_[i] = std::max(stage_[i], std::abs(attempt_[k] - increments_[k]));
    sizes_[i] = std::max(sizes_[i], std::abs(begin.z[i]) + std::abs(attempt_[k]));
  }
  increments_.swap(attempt_);
  ++iterations_;
  const double largest_size = std::ranges::max(sizes_);
  double change = 0;
  for (std::size_t i = 0; i < n_; ++i) change = std::max(change, watch(i, stage_[i], largest_size));
  if (change > growth_of_the_lost * least_change_) return State::lost;
  if (change > 0) least_change_ = std::min(least_change_, change);
  const bool settled =
      std::ranges::all_of(components_, [](const Component& c) { return c.ended[0] && c.ended[1]; });
  return settled ? State::settled : State::going;
}

// In q' = p/m, p' = -dV/dq the errors of q and p pass into each other: each component shows two sequences of
// changes in turn, and both have to end.
double GaussStages::watch(std::size_t i, double change, double largest_size) {
  Component& component = components_[i];
  const bool small = change <= std::max(round_off * sizes_[i], round_off_of_largest * largest_size);
  const std::size_t sequence = iterations_ % 2;
  if (!small) component.ended = {};
  if (small && (change == 0 || change >= component.last[sequence])) component.ended[sequence] = true;
  component.last[sequence] = change;
  return small ? 0 : change / sizes_[i];
}

}  // namespace qdot
