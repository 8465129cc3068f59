#include "core/integrate/taylor_stepper.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/base/work.hpp"
#include "core/integrate/evaluator.hpp"
#include "core/integrate/series_at_four.hpp"
#include "core/integrate/series_sums.hpp"
#include "core/integrate/taylor_orders.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/rough_powers.hpp"

namespace qdot {
namespace {

constexpr int attempts = 60;            ///< at one step, each half as long
constexpr double largest_defect = 1e3;  ///< of an unbounded step, at its end, in units of the tolerance
/// Of a bounded step, times its length, in units of the tolerance. They are 1 to 100, as it happens: the
/// worst step of a reference has to be better than a lucky one of the run that it measures.
constexpr double allowed_defect = 100, allowed_of_reference = 10;
/// Of the length wanted: most steps are then found short enough by the first and cheapest bound.
constexpr double share_of_reference = 0.95;
constexpr int most_bounds = 120;           ///< tried for one step
constexpr double least_of_wanted = 1e-12;  ///< a step that much shorter is not bounded
constexpr double least_share = 0.5, grown_share = 1.03;
constexpr double visible = 1000;  ///< a defect so many times the last coefficients hides something

/// log2 of (w / |c|)^(1/k); infinite for c = 0. A step need not be known to more than some digits.
double log2_of_root(double w, double c, unsigned k) {
  if (c == 0) return infinity;
  return (rough_log2(w) - rough_log2(std::abs(c))) / k;
}

double powered(double x, unsigned k) {
  double result = 1;
  for (; k > 0; k /= 2, x *= x) {
    if (k % 2 == 1) result *= x;
  }
  return result;
}

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
        carried_(y_.size()),
        coefficients_(y_.size() * (order_ + 1)),
        next_(coefficients_.size()) {}

  std::optional<Ending> step() override {
    if (t_ != t_previous_) trouble_.reset();
    if (steps_ == 0) {
      if (const auto spent = limit()) return spent;
      if (const auto failed = expand(t_, y_, next_)) return failed;
    }
    weigh();
    const double wanted = step_size();
    const double share = request_.is_reference ? share_of_reference : 1;
    double h = std::min(share * wanted, request_.t_end - t_);
    for (int i = 0; i < attempts; ++i, h /= 2) {
      const Bound bound = bounded(h);
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
    if (last_is_bounded_) piece.defect = defect_;
    if (last_is_bounded_) piece.rounding = rounding_;
    return piece;
  }

  double t_previous() const override { return t_previous_; }
  double t() const override { return t_; }
  std::span<const double> y() const override { return y_; }
  std::optional<Ending> trouble() const override { return trouble_; }
  bool bounded() const override { return bounded_; }

  /// The bound of a whole step may be ten thousand times that of a part. Its rows are expanded again.
  void end_at(double t) override {
    if (unseen_.empty() || !bounded_ || t == t_) return;
    if (expand(t_previous_, y_previous_, beyond_)) return;
    const double h = t - t_previous_;
    bound_closely(h);
    if (!std::ranges::all_of(defect_, [](double d) { return std::isfinite(d); })) return;
    next_ = coefficients_;
    off_so_far_ = off_before_;
    hidden_so_far_ = hidden_before_;
    hides_ = find_hidden(h);
    note_unseen(h);
  }

  std::span<const double> unseen() const override { return unseen_; }
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

  /// weights_: w_i of this step.
  void weigh() {
    for (std::size_t i = 0; i < y_.size(); ++i) {
      const double reach = std::abs(y_[i]) + last_step_ * std::abs(coefficient(next_, i, 1));
      weights_[i] = request_.tolerances.atol + rtol_ * reach;
    }
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
    double exponent = log2_of_step_by(last);
    if (last > 2) exponent = std::min(exponent, log2_of_step_by(last - 1));
    return std::isfinite(exponent) ? rough_exp2(exponent) : exponent;
  }

  /// log2 of the least over the components of (w / |c_k|)^(1/k). One root, of the largest |c_k| / w, where
  /// that is a number.
  [[nodiscard]] double log2_of_step_by(unsigned k) const {
    double largest = 0;
    for (std::size_t i = 0; i < y_.size(); ++i) {
      largest = std::max(largest, std::abs(coefficient(next_, i, k)) / weights_[i]);
    }
    if (std::isfinite(largest)) return largest > 0 ? -rough_log2(largest) / k : infinity;
    double least = infinity;
    for (std::size_t i = 0; i < y_.size(); ++i) {
      least = std::min(least, log2_of_root(weights_[i], coefficient(next_, i, k), k));
    }
    return least;
  }

  struct Bound {
    double h{};
    bool found{};
  };

  /// A step up to h whose defect is bounded by what is allowed; h itself where there is none. Where the last
  /// one had to be a little shorter than wanted, this one is tried so.
  Bound bounded(double h) {
    if (!system_.defect) return {h, false};
    const double allowed = request_.is_reference ? allowed_of_reference : allowed_defect;
    for (std::size_t i = 0; i < y_.size(); ++i) allowed_[i] = allowed * weights_[i];
    const auto excess = [&](double length) { return system_.defect(length, allowed_, defect_); };
    double good = h * share_, bad = infinity;
    share_ = std::min(1.0, grown_share * share_);
    for (int i = 0; i < most_bounds; ++i) {
      const double ratio = excess(good);
      if (ratio <= 1) break;
      bad = good;
      good = std::max(good / 2, 0.93 * good * rough_exp2(-rough_log2(std::min(ratio, 1e300)) / order_));
      if (good < least_of_wanted * h || t_ + good == t_) return {h, false};
      share_ = std::max(least_share, good / h);
    }
    if (bad <= 4 * h && good <= h / 4) good = lengthened(good, bad);
    if (request_.is_reference) look_closely(good);
    if (request_.originals != nullptr && system_.rounding) {
      rounding_.resize(y_.size() / 2);
      system_.rounding(rounding_);
    }
    return {good, true};
  }

  /// Where the bound tells of something hidden it may be a rough one: then the closest is taken.
  void look_closely(double h) {
    hides_ = find_hidden(h);
    if (hides_) bound_closely(h);
  }

  void bound_closely(double h) { (void)system_.defect(h, {}, defect_); }

  /// After much shortening: between a length that does and one that does not.
  double lengthened(double good, double bad) {
    for (int i = 0; i < 2; ++i) {
      const double middle = (good + bad) / 2;
      (system_.defect(middle, allowed_, defect_) <= 1 ? good : bad) = middle;
    }
    (void)system_.defect(good, allowed_, defect_);
    return good;
  }

  /// What the step of a reference may hide: what its last coefficients do not show. It moves on with the
  /// velocities. What it may be off by anyway is much less, and only summed.
  void note_unseen(double h) {
    const std::size_t n = y_.size() / 2;
    off_before_ = off_so_far_;
    hidden_before_ = hidden_so_far_;
    const bool hides = hides_ && find_hidden(h);  // by the closest bound
    if (hides) hidden_so_far_.resize(y_.size());
    for (std::size_t i = 0; i < hidden_so_far_.size(); ++i) hidden_so_far_[i] += hidden_[i];
    for (std::size_t i = 0; i < n && !hidden_so_far_.empty(); ++i) {
      hidden_so_far_[i] += h * hidden_so_far_[n + i];
    }
    unseen_.resize(y_.size());
    for (std::size_t i = 0; i < unseen_.size(); ++i) {
      off_so_far_[i] += h * defect_[i];
      unseen_[i] = off_so_far_[i] + (hidden_so_far_.empty() ? 0 : hidden_so_far_[i]);
    }
  }

  /// hidden_: what of the bound of each component its last coefficients do not show. Whether there is any.
  bool find_hidden(double h) {
    const double power = powered(h, order_ - 2);
    bool hides = false;
    for (std::size_t i = 0; i < y_.size(); ++i) {
      const auto size = [&](unsigned k) { return std::abs(coefficient(next_, i, k)); };
      const double last = power * std::max({size(order_ - 2), h * size(order_ - 1), h * h * size(order_)});
      hidden_[i] = h * defect_[i] > visible * last ? h * defect_[i] : 0;
      hides = hides || hidden_[i] > 0;
    }
    return hides;
  }

  /// To time t, if the polynomial holds until there.
  bool try_step(double t, const Bound& bound) {
    const double h = t - t_;
    std::vector<double>& y = attempt_;
    y.resize(y_.size());
    attempt_carried_.resize(y.size());
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
    if (bound.found && request_.is_reference) note_unseen(h);
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
    if (trouble_) return *trouble_;
    return std::isfinite(wanted) ? Ending::blow_up : Ending::nonfinite;
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
  std::vector<double> allowed_ = rise_, defect_ = rise_, hidden_ = rise_;
  std::vector<double> rounding_;  ///< of accelerations
  std::vector<double> hidden_so_far_, off_so_far_ = rise_, unseen_;
  std::vector<double> hidden_before_, off_before_;  ///< the last step
  std::vector<double> fastest_;                     ///< accelerations in the last step
  bool bounded_{true}, last_is_bounded_{false};
  bool hides_{false};  ///< the step that was just bounded
  double share_{1};    ///< of the length wanted, to begin with
  std::uint64_t steps_{}, evaluations_{};
  std::optional<Ending> trouble_;
};

}  // namespace

std::unique_ptr<Stepper> make_taylor_stepper(const RightHandSide& system, const RunRequest& request) {
  if (!system.expansion) throw std::invalid_argument("taylor needs an expansion");
  return std::make_unique<TaylorStepper>(system, request);
}

}  // namespace qdot
