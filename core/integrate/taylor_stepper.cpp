#include "core/integrate/taylor_stepper.hpp"

#include <sleef.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/integrate/evaluator.hpp"

namespace qdot {
namespace {

constexpr unsigned order_loose = 14;  ///< cheaper per step; fewer digits need no more
constexpr unsigned order_tight = 20;
constexpr double loose = 1e-6;
constexpr int attempts = 60;            ///< at one step, each half as long
constexpr double largest_defect = 1e3;  ///< of the equation at the end of a step, in units of the tolerance

/// w / |c|, to the power 1 / k; infinite for c = 0.
double root_of(double w, double c, unsigned k) {
  if (c == 0) return std::numeric_limits<double>::infinity();
  const double exponent = Sleef_cinz_log2d1_u10purec(w) - Sleef_cinz_log2d1_u10purec(std::abs(c));
  return Sleef_cinz_exp2d1_u10purec(exponent / k);
}

unsigned order_for(const RunRequest& request) {
  if (request.taylor_order > 0) return request.taylor_order;
  return request.tolerances.rtol >= loose ? order_loose : order_tight;
}

/// sum_{k=1}^{row-1} c_k s^k of so many rows of coefficients side by side, as each alone would wait for its
/// own sums.
template <std::size_t count>
void sum_series(const double* c, std::size_t row, double s, double* sums) {
  std::array<double, count> sum{};
  for (std::size_t k = row - 1; k >= 1; --k) {
#pragma GCC unroll 4
    for (std::size_t i = 0; i < count; ++i) sum[i] = sum[i] * s + c[i * row + k];
  }
  for (std::size_t i = 0; i < count; ++i) sums[i] = sum[i] * s;
}

class TaylorStepper final : public Stepper {
 public:
  TaylorStepper(const RightHandSide& system, const RunRequest& request)
      : system_(system),
        request_(request),
        order_(order_for(request)),
        t_previous_(request.t_start),
        t_(request.t_start),
        y_previous_(request.y_start),
        y_(request.y_start),
        carried_(y_.size()),
        coefficients_(y_.size() * (order_ + 1)),
        next_(coefficients_.size()) {}

  std::optional<Ending> step() override {
    if (t_ != t_previous_) trouble_.reset();
    if (steps_ == 0) {
      if (const auto spent = limit()) return spent;
      if (const auto failed = expand(t_, y_, next_)) return failed;
    }
    const double wanted = step_size();
    const std::vector<double> carried = carried_;
    double h = std::min(wanted, request_.t_end - t_);
    for (int i = 0; i < attempts; ++i, h /= 2) {
      const double t = h == request_.t_end - t_ ? request_.t_end : t_ + h;
      if (!(t > t_)) break;
      if (const auto spent = limit()) return spent;
      if (try_step(t, carried)) {
        last_step_ = h;
        return std::nullopt;
      }
    }
    return stuck(wanted);
  }

  std::optional<Ending> interpolate(double t, std::span<double> y_out) override {
    if (t == t_) {
      std::ranges::copy(y_, y_out.begin());
    } else {
      increments(coefficients_, t - t_previous_, y_out);
      for (std::size_t i = 0; i < y_out.size(); ++i) y_out[i] = y_previous_[i] + y_out[i];
    }
    return std::nullopt;
  }

  double t_previous() const override { return t_previous_; }
  double t() const override { return t_; }
  std::span<const double> y() const override { return y_; }
  std::optional<Ending> trouble() const override { return trouble_; }
  std::uint64_t steps() const override { return steps_; }
  std::uint64_t evaluations() const override { return evaluations_; }

 private:
  std::optional<Ending> limit() const {
    const Limits& limits = request_.limits;
    if (evaluations_ + order_ > limits.max_evaluations) return Ending::step_limit;
    if (limits.interrupted && steps_ % 4 == 0 && limits.interrupted()) return Ending::interrupted;
    return std::nullopt;
  }

  std::optional<Ending> expand(double t, std::span<const double> y, std::vector<double>& coefficients) {
    if (const auto wrong = unusable(y, request_.limits.max_magnitude)) return trouble_ = wrong;
    evaluations_ += order_;
    switch (system_.expansion(t, y, order_, coefficients)) {
      case Evaluation::ok:
        return std::nullopt;
      case Evaluation::singular_mass:
        return trouble_ = Ending::singular_mass;
      case Evaluation::nonfinite:
        break;
    }
    return trouble_ = Ending::nonfinite;
  }

  /// c_i,k of the expansion at the current state.
  [[nodiscard]] double coefficient(const std::vector<double>& c, std::size_t i, unsigned k) const {
    return c[i * (order_ + 1) + k];
  }

  [[nodiscard]] double weight(std::size_t i) const {
    const double reach = std::abs(y_[i]) + last_step_ * std::abs(coefficient(next_, i, 1));
    return request_.tolerances.atol + request_.tolerances.rtol * reach;
  }

  /// By the last two coefficients that are finite in all components.
  [[nodiscard]] double step_size() const {
    unsigned last = order_;
    const auto is_finite = [&](unsigned k) {
      for (std::size_t i = 0; i < y_.size(); ++i) {
        if (!std::isfinite(coefficient(next_, i, k))) return false;
      }
      return true;
    };
    while (last > 1 && !is_finite(last)) --last;
    const double h = step_by(last);
    return last > 2 ? std::min(h, step_by(last - 1)) : h;
  }

  /// The least over the components of (w / |c_k|)^(1/k). One root, of the largest |c_k| / w, where that is a
  /// number.
  [[nodiscard]] double step_by(unsigned k) const {
    double largest = 0;
    for (std::size_t i = 0; i < y_.size(); ++i) {
      largest = std::max(largest, std::abs(coefficient(next_, i, k)) / weight(i));
    }
    if (std::isfinite(largest)) return root_of(1, largest, k);
    double h = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < y_.size(); ++i) {
      h = std::min(h, root_of(weight(i), coefficient(next_, i, k), k));
    }
    return h;
  }

  /// sum_{k>=1} c_k s^k of every component.
  void increments(const std::vector<double>& c, double s, std::span<double> sum) const {
    const std::size_t n = sum.size(), row = order_ + 1;
    std::size_t i = 0;
    for (; i + 4 <= n; i += 4) sum_series<4>(c.data() + i * row, row, s, sum.data() + i);
    for (; i + 2 <= n; i += 2) sum_series<2>(c.data() + i * row, row, s, sum.data() + i);
    for (; i < n; ++i) sum_series<1>(c.data() + i * row, row, s, sum.data() + i);
  }

  /// sum_{k>=1} k c_k s^(k-1).
  void slopes(const std::vector<double>& c, double s, std::span<double> sum) const {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = order_ * coefficient(c, i, order_);
    for (unsigned k = order_ - 1; k >= 1; --k) {
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = sum[i] * s + k * coefficient(c, i, k);
    }
  }

  /// To time t, if the polynomial holds until there.
  bool try_step(double t, const std::vector<double>& carried) {
    const double h = t - t_;
    std::vector<double>& y = attempt_;
    y.resize(y_.size());
    attempt_carried_ = carried;
    increments(next_, h, rise_);
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double rise = rise_[i] + carried[i];
      y[i] = y_[i] + rise;
      const double taken = y[i] - y_[i];
      attempt_carried_[i] = (y_[i] - (y[i] - taken)) + (rise - taken);
    }
    if (expand(t, y, beyond_)) return false;
    slopes(next_, h, slope_);
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double rate = coefficient(beyond_, i, 1);
      const double defect = slope_[i] - rate;
      const double round_off = 1e-12 * (std::abs(slope_[i]) + std::abs(rate));
      if (!(h * std::abs(defect) <= largest_defect * weight(i) + h * round_off)) return false;
    }
    accept(t);
    return true;
  }

  void accept(double t) {
    t_previous_ = t_;
    t_ = t;
    y_previous_.swap(y_);
    y_.swap(attempt_);
    carried_.swap(attempt_carried_);
    coefficients_.swap(next_);
    next_.swap(beyond_);
    ++steps_;
  }

  /// No step was accepted, or none can be taken.
  Ending stuck(double wanted) const {
    if (trouble_) return *trouble_;
    return std::isfinite(wanted) ? Ending::blow_up : Ending::nonfinite;
  }

  const RightHandSide& system_;
  const RunRequest& request_;
  unsigned order_;
  double t_previous_, t_;
  double last_step_{};
  std::vector<double> y_previous_, y_, attempt_;
  std::vector<double> carried_, attempt_carried_;  ///< what the sums of the state have rounded away
  std::vector<double> coefficients_;               ///< at t_previous_: the dense output
  std::vector<double> next_;                       ///< at t_
  std::vector<double> beyond_ = std::vector<double>(coefficients_.size());
  std::vector<double> rise_ = std::vector<double>(y_.size()), slope_ = rise_;
  std::uint64_t steps_{}, evaluations_{};
  std::optional<Ending> trouble_;
};

}  // namespace

std::unique_ptr<Stepper> make_taylor_stepper(const RightHandSide& system, const RunRequest& request) {
  return std::make_unique<TaylorStepper>(system, request);
}

}  // namespace qdot
