#include "core/integrate/taylor_stepper.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "core/base/work.hpp"
#include "core/integrate/bounded_steps.hpp"
#include "core/integrate/evaluator.hpp"
#include "core/integrate/series_at_four.hpp"
#include "core/integrate/series_sums.hpp"
#include "core/integrate/step_length.hpp"
#include "core/integrate/taylor_orders.hpp"

namespace qdot {
namespace {

/// At a start, of the order that is taken: room for a motion that becomes faster.
constexpr double largest_first_coefficient = 1e200;
constexpr unsigned lowest_order_taken = 8;
constexpr int attempts = 60;            ///< at one step, each half as long
constexpr double largest_defect = 1e3;  ///< of an unbounded step, at its end, in units of the tolerance
/// Of the length wanted: most steps of a reference are then found short enough by the first and cheapest
/// bound.
constexpr double share_of_reference = 0.95;

class TaylorStepper final : public Stepper {
 public:
  TaylorStepper(const RightHandSide& system, const RunRequest& request)
      : system_(system),
        request_(request),
        order_(order_for(request)),
        rtol_(relative_tolerance(request)),
        t_previous_(request.t_start),
        t_(request.t_start),
        y_previous_(request.y_start),
        y_(request.y_start),
        attempt_(y_.size()),
        carried_(y_.size()),
        attempt_carried_(y_.size()),
        coefficients_(y_.size() * (order_ + 1)),
        next_(coefficients_.size()),
        bounds_(system, request, y_.size(), order_) {}

  std::optional<Ending> step() override {
    if (t_ != t_previous_) trouble_.reset();
    if (steps_ == 0) {
      if (const auto spent = limit()) return spent;
      if (const auto failed = expand(t_, y_, next_)) return failed;
      if (const auto failed = fit_order()) return failed;
    }
    weigh();
    const double wanted = step_length(next_, order_, weights_);
    const double share = request_.is_reference ? share_of_reference : 1;
    double h = std::min(share * wanted, request_.t_end - t_);
    for (int i = 0; i < attempts; ++i, h /= 2) {
      const BoundedSteps::Bound bound = bounds_.find(t_, h, next_, weights_);
      h = bound.h;
      const double t = h == request_.t_end - t_ ? request_.t_end : t_ + h;
      if (!(t > t_)) break;
      if (const auto spent = limit()) return spent;
      if (try_step(t, bound)) return std::nullopt;
      if (const auto failed = expand(t_, y_, next_)) return failed;  // its rows are wanted again
    }
    return stuck(wanted);
  }

  std::optional<Ending> interpolate(double t, std::span<double> y_out) override {
    if (t == t_) {
      std::ranges::copy(y_, y_out.begin());
    } else {
      sum_all_series<SeriesSum::value>(coefficients_.data(), order_, t - t_previous_, y_out);
      for (std::size_t i = 0; i < y_out.size(); ++i) y_out[i] = y_previous_[i] + y_out[i];
    }
    return std::nullopt;
  }

  std::optional<Ending> sample(std::span<const double> times, std::span<double> rows) override {
    constexpr std::size_t lanes = 4, worth_it = 2;
    const std::size_t n = y_.size();
    std::size_t i = 0;
    for (; i + worth_it <= times.size(); i += lanes) {
      sample_at_four(times.subspan(i, std::min(lanes, times.size() - i)), rows.subspan(i * n));
    }
    return i < times.size() ? interpolate(times[i], rows.subspan(i * n, n)) : std::nullopt;
  }

  std::optional<MotionPiece> polynomials() const override {
    MotionPiece piece{t_previous_, t_ - t_previous_, coefficients_, order_, {}, {}};
    if (last_is_bounded_) piece.defect = bounds_.defect();
    if (last_is_bounded_) piece.rounding = bounds_.rounding();
    return piece;
  }

  double t_previous() const override { return t_previous_; }
  double t() const override { return t_; }
  std::span<const double> y() const override { return y_; }
  std::optional<Ending> trouble() const override { return trouble_; }
  bool bounded() const override { return bounded_; }

  void end_at(double t) override {
    if (bounds_.unseen().empty() || !bounded_ || t == t_) return;
    if (expand(t_previous_, y_previous_, beyond_)) return;
    bounds_.shorten(t - t_previous_, coefficients_);
  }

  std::span<const double> unseen() const override { return bounds_.unseen(); }
  std::span<const double> accelerations() override {
    if (steps_ == 0) return {};
    const std::size_t n = y_.size() / 2;
    fastest_.resize(n);
    const double* velocities = coefficients_.data() + n * (order_ + 1);
    sum_all_series<SeriesSum::largest_slope>(velocities, order_, t_ - t_previous_, fastest_);
    return fastest_;
  }
  std::uint64_t steps() const override { return steps_; }
  std::uint64_t evaluations() const override { return evaluations_; }

 private:
  /// Where there are less than four, the last one several times.
  void sample_at_four(std::span<const double> times, std::span<double> rows) {
    std::array<double, 4> s{};
    for (std::size_t j = 0; j < s.size(); ++j) s[j] = times[std::min(j, times.size() - 1)] - t_previous_;
    const std::size_t n = y_.size();
    sums_.resize(s.size() * n);
    sum_series_at_four(coefficients_.data(), order_, s.data(), sums_);
    for (std::size_t j = 0; j < times.size(); ++j) {
      double* row = rows.data() + j * n;
      for (std::size_t i = 0; i < n; ++i) row[i] = y_previous_[i] + sums_[i * s.size() + j];
      if (times[j] == t_) std::ranges::copy(y_, row);
    }
  }

  std::optional<Ending> limit() const {
    const Limits& limits = request_.limits;
    if (evaluations_ + order_ > limits.max_evaluations) return Ending::step_limit;
    if (steps_ % 4 == 0) check_interruption();
    return std::nullopt;
  }

  std::optional<Ending> expand(double t, std::span<const double> y, std::vector<double>& coefficients) {
    if (const auto wrong = unusable(y, request_.limits.max_magnitude)) return trouble_ = wrong;
    evaluations_ += order_;
    const auto trouble = trouble_of(system_.expansion(t, y, order_, coefficients));
    if (trouble) trouble_ = trouble;
    return trouble;
  }

  /// Before the first step: of a motion as fast as an electron's, in seconds, coefficients of high order
  /// leave the range of doubles. Series then end before that.
  std::optional<Ending> fit_order() {
    const auto fits = [this](unsigned k) {
      for (std::size_t i = 0; i < y_.size(); ++i) {
        if (!(std::abs(coefficient(next_, i, k)) <= largest_first_coefficient)) return false;
      }
      return true;
    };
    unsigned order = 1;
    while (order < order_ && fits(order + 1)) ++order;
    if (order == order_ || order < lowest_order_taken) return std::nullopt;
    order_ = order;
    bounds_.take_order(order);
    for (std::vector<double>* series : {&coefficients_, &next_, &beyond_})
      series->assign(y_.size() * (order_ + 1), 0.0);
    return expand(t_, y_, next_);
  }

  /// c_i,k of the expansion at the current state.
  [[nodiscard]] double coefficient(const std::vector<double>& c, std::size_t i, unsigned k) const {
    return c[i * (order_ + 1) + k];
  }

  /// weights_: w_i of this step.
  void weigh() {
    for (std::size_t i = 0; i < y_.size(); ++i) {
      const double reach = std::abs(y_[i]) + last_step_ * std::abs(coefficient(next_, i, 1));
      weights_[i] = request_.tolerances.atol + rtol_ * reach;
    }
  }

  /// To time t, if the polynomial holds until there.
  bool try_step(double t, const BoundedSteps::Bound& bound) {
    const double h = t - t_;
    std::vector<double>& y = attempt_;
    sum_all_series<SeriesSum::value>(next_.data(), order_, h, rise_);
    if (system_.project && !add_projection(t)) return false;
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double rise = rise_[i] + carried_[i];
      y[i] = y_[i] + rise;
      const double taken = y[i] - y_[i];
      attempt_carried_[i] = (y_[i] - (y[i] - taken)) + (rise - taken);
    }
    if (expand(t, y, beyond_)) return false;
    if (!bound.found && !holds_until(h)) return false;
    if (bound.found && request_.is_reference) bounds_.add_unseen(h, next_);
    last_is_bounded_ = bound.found;
    bounded_ = bounded_ && bound.found;
    last_step_ = h;
    accept(t);
    return true;
  }

  /// Back to what all states obey. The polynomials of the step stay as they are: they end off it by the error
  /// that this takes away.
  bool add_projection(double t) {
    for (std::size_t i = 0; i < y_.size(); ++i) attempt_[i] = y_[i] + (rise_[i] + carried_[i]);
    std::vector<double>& before = slope_;
    std::ranges::copy(attempt_, before.begin());
    if (!system_.project(t, attempt_)) return false;
    for (std::size_t i = 0; i < y_.size(); ++i) rise_[i] += attempt_[i] - before[i];
    return true;
  }

  /// Whether the polynomial obeys the equation at the end of the step.
  bool holds_until(double h) {
    sum_all_series<SeriesSum::slope>(next_.data(), order_, h, slope_);
    for (std::size_t i = 0; i < y_.size(); ++i) {
      const double rate = coefficient(beyond_, i, 1);
      const double defect = slope_[i] - rate;
      const double round_off = 1e-12 * (std::abs(slope_[i]) + std::abs(rate));
      if (!(h * std::abs(defect) <= largest_defect * weights_[i] + h * round_off)) return false;
    }
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
    const bool overflows =
        !std::ranges::all_of(next_, [](double coefficient) { return std::isfinite(coefficient); });
    if (overflows && trouble_ != Ending::nonfinite && is_still()) return Ending::step_limit;
    if (trouble_) return *trouble_;
    return std::isfinite(wanted) ? Ending::blow_up : Ending::nonfinite;
  }

  /// Whether the velocities change by less than rounding in the shortest time there is: so they do beside a
  /// pulse that is too narrow for series of this order, and not at a singularity.
  bool is_still() const {
    const double shortest = std::nextafter(t_, request_.t_end) - t_;
    double largest = 0, change = 0;
    for (std::size_t i = 0; i < y_.size(); ++i) {
      largest = std::max(largest, std::abs(y_[i]));
      if (i < y_.size() / 2) continue;
      double sum = 0;
      for (unsigned k = order_; k > 0; --k) {
        const double c = std::abs(coefficient(next_, i, k));
        sum = (sum + (std::isfinite(c) ? c : 0)) * shortest;
      }
      change = std::max(change, sum);
    }
    return change <= std::numeric_limits<double>::epsilon() * largest;
  }

  const RightHandSide& system_;
  const RunRequest& request_;
  unsigned order_;
  double rtol_;
  double t_previous_, t_;
  double last_step_{};
  std::vector<double> y_previous_, y_, attempt_;
  std::vector<double> carried_, attempt_carried_;  ///< what the sums of the state have rounded away
  std::vector<double> coefficients_;               ///< at t_previous_: the dense output
  std::vector<double> next_;                       ///< at t_
  std::vector<double> beyond_ = std::vector<double>(coefficients_.size());
  std::vector<double> rise_ = std::vector<double>(y_.size()), slope_ = rise_;
  std::vector<double> weights_ = rise_;
  std::vector<double> sums_;  ///< of four samples
  BoundedSteps bounds_;
  std::vector<double> fastest_;  ///< accelerations in the last step
  bool bounded_{true}, last_is_bounded_{false};
  std::uint64_t steps_{}, evaluations_{};
  std::optional<Ending> trouble_;
};

}  // namespace

std::unique_ptr<Stepper> make_taylor_stepper(const RightHandSide& system, const RunRequest& request) {
  if (!system.expansion) throw std::invalid_argument("taylor needs an expansion");
  return std::make_unique<TaylorStepper>(system, request);
}

}  // namespace qdot
