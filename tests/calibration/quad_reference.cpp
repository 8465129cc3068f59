#include "tests/calibration/quad_reference.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/calibration/precise_functions.hpp"

namespace qdot::test {
namespace {

constexpr int pieces = 16;  ///< of a step, between which an impact's sign is looked at

template <typename Number>
class Integration {
 public:
  Integration(const QuadProblem& problem, const PreciseMethod& method)
      : problem_(problem), method_(method), n_(problem.y_start.size() / 2), recording_(method.order) {
    Number moved = method.moved;
    for (const auto& [name, value] : problem.parameters) {
      parameters_[name] = value + moved * value;
      moved = -moved;
    }
    for (const double value : problem.y_start) y_.push_back(value);
    largest_.assign(2 * n_, Number(0));
    t_ = problem.t_start;
    record();
  }

  PreciseMotion<Number> run() {
    sample(t_, t_);
    while (motion_.rows < problem_.grid.size() && motion_.steps < method_.most_steps) step();
    return std::move(motion_);
  }

 private:
  void record() {
    time_ = recording_.input();
    for (std::size_t i = 0; i < n_; ++i) q_.push_back(recording_.input());
    for (std::size_t i = 0; i < n_; ++i) v_.push_back(recording_.input());
    const Forcing& f = problem_.force;
    wave_sign_ = recording_.input();  // a constant between the kinks of a rectified wave
    const Series<Number> wave =
        wave_sign_ * (exp(Number(-f.decay) * time_) * cos(Number(f.phase) + Number(f.frequency) * time_));
    accelerations_ = precise_accelerations<Number>(problem_.system)(parameters_, time_, q_, v_,
                                                                    Number(f.amplitude) * wave);
  }

  void expand() {
    for (unsigned k = 0; k <= method_.order; ++k)
      recording_.coefficients(time_)[k] = k == 0 ? t_ : Number(k == 1);
    for (unsigned k = 0; k <= method_.order; ++k)
      recording_.coefficients(wave_sign_)[k] = k == 0 ? sign_ : Number(0);
    for (std::size_t i = 0; i < 2 * n_; ++i) row(i)[0] = y_[i];
    for (unsigned k = 0; k < method_.order; ++k) {
      recording_.advance(k);
      for (std::size_t i = 0; i < n_; ++i) {
        row(i)[k + 1] = row(n_ + i)[k] / Number(k + 1);
        row(n_ + i)[k + 1] = recording_.coefficients(accelerations_[i])[k] / Number(k + 1);
      }
    }
  }

  [[nodiscard]] Number* row(std::size_t i) { return recording_.coefficients(i < n_ ? q_[i] : v_[i - n_]); }

  [[nodiscard]] Number value(std::size_t i, Number s) {
    const Number* c = row(i);
    Number sum = c[method_.order];
    for (unsigned k = method_.order; k-- > 0;) sum = sum * s + c[k];
    return sum;
  }

  /// The last two terms of every component are as large as the tolerance.
  [[nodiscard]] Number step_size() {
    Number h = HUGE_VAL;
    for (std::size_t i = 0; i < 2 * n_; ++i) {
      largest_[i] = std::max(size_of(y_[i]), last_h_ * size_of(row(i)[1]));
      for (unsigned k = method_.order - 1; k <= method_.order; ++k) {
        const Number c = size_of(row(i)[k]);
        if (c == 0) continue;
        const Number w = Number(method_.tolerance) * std::max(largest_[i], Number(1e-300));
        h = std::min(h, exponential(logarithm(w / c) / Number(k)));
      }
    }
    return h;
  }

  void step() {
    const Number end = problem_.grid.back();
    const std::optional<Number> kink = next_kink();
    sign_ = problem_.force.rectified && cosine(argument(kink ? (t_ + *kink) / 2 : t_ + 1)) < 0 ? -1 : 1;
    if (problem_.force.amplitude < 0 && problem_.force.rectified) sign_ = -sign_;
    expand();
    Number h = std::min(step_size(), end - t_);
    if (kink && *kink - t_ < h) h = *kink - t_;
    const std::optional<Number> impact = problem_.impacts ? find_impact(h) : std::nullopt;
    if (impact) h = *impact;
    const Number before = t_;
    t_ = h == end - t_ ? end : (kink && h == *kink - t_ ? *kink : t_ + h);
    for (std::size_t i = 0; i < 2 * n_; ++i) y_[i] = value(i, h);
    sample(before, t_);
    if (impact) apply_impact();
    last_h_ = h;
    ++motion_.steps;
  }

  [[nodiscard]] Number argument(Number t) const {
    return Number(problem_.force.frequency) * t + Number(problem_.force.phase);
  }

  /// The next zero of a rectified wave.
  [[nodiscard]] std::optional<Number> next_kink() const {
    const Forcing& f = problem_.force;
    if (!f.rectified || f.frequency == 0) return std::nullopt;
    const Number direction = f.frequency > 0 ? 1 : -1;
    Number k = rounded_up(direction * (argument(t_) / pi_ - Number(0.5)));
    for (;; k += 1) {
      const Number t = ((direction * k + Number(0.5)) * pi_ - Number(f.phase)) / Number(f.frequency);
      if (t > t_ + size_of(t_) * Number(1e-30) + Number(1e-30) / size_of(Number(f.frequency))) return t;
    }
  }

  /// Rows in (before, now], and the start itself.
  void sample(Number before, Number now) {
    for (; motion_.rows < problem_.grid.size() && Number(problem_.grid[motion_.rows]) <= now;
         ++motion_.rows) {
      const Number t = problem_.grid[motion_.rows];
      for (std::size_t i = 0; i < 2 * n_; ++i)
        motion_.state.push_back(t == now ? y_[i] : value(i, t - before));
    }
  }

  [[nodiscard]] Number foot(Number s) { return value(1, s) - 2 * value(0, s); }

  /// phi - 2 theta rising through 0 with theta < 0; the zero at the start of a stride does not count.
  [[nodiscard]] std::optional<Number> find_impact(Number h) {
    Number from = 0;
    bool below = !at_stride_start_ && foot(0) < 0;
    for (int i = 1; i <= pieces; ++i) {
      const Number to = h * i / pieces;
      const bool now_below = foot(to) < 0;
      if (below && !now_below) {
        const Number zero = zero_between(from, to);
        if (value(0, zero) < 0) return zero;
      }
      below = now_below;
      from = to;
    }
    at_stride_start_ = false;
    return std::nullopt;
  }

  [[nodiscard]] Number zero_between(Number low, Number high) {
    for (int i = 0; i < 120; ++i) {
      const Number middle = (low + high) / 2;
      (foot(middle) < 0 ? low : high) = middle;
    }
    return high;
  }

  /// Angular momentum is kept about the new contact and, for the new swing leg, about the hip.
  void apply_impact() {
    motion_.impacts.push_back(static_cast<double>(t_));
    const Number mu = parameters_.at("m") / parameters_.at("M");
    const Number theta = y_[0], c = cosine(2 * theta), s = sine(2 * theta);
    const Number rate = c * y_[2] / (1 + mu * s * s);
    y_ = {-theta, -2 * theta, rate, (1 - c) * rate};
    at_stride_start_ = true;
  }

  const QuadProblem& problem_;
  const PreciseMethod& method_;
  std::size_t n_;
  Recording<Number> recording_;
  PreciseValues<Number> parameters_;
  Series<Number> time_, wave_sign_;
  std::vector<Series<Number>> q_, v_, accelerations_;
  std::vector<Number> y_, largest_;
  Number t_{}, last_h_{}, sign_{1}, pi_{arc_cosine(Number(-1))};
  bool at_stride_start_{};
  PreciseMotion<Number> motion_;
};

template <typename Number>
Reference<Number> reference_by(const QuadProblem& problem, const PreciseMethod& method,
                               const PreciseMethod& other) {
  Reference<Number> reference{precise_motion<Number>(problem, method), {}};
  const PreciseMotion<Number> check = precise_motion<Number>(problem, other);
  reference.motion.rows = std::min(reference.motion.rows, check.rows);
  const std::size_t numbers = reference.motion.rows * problem.y_start.size();
  for (std::size_t i = 0; i < numbers; ++i) {
    reference.doubt.push_back(static_cast<double>(size_of(reference.motion.state[i] - check.state[i])));
  }
  return reference;
}

}  // namespace

template <typename Number>
PreciseMotion<Number> precise_motion(const QuadProblem& problem, const PreciseMethod& method) {
  return Integration<Number>(problem, method).run();
}
template PreciseMotion<Quad> precise_motion(const QuadProblem& problem, const PreciseMethod& method);
template PreciseMotion<Long> precise_motion(const QuadProblem& problem, const PreciseMethod& method);

Reference<Quad> quad_reference(const QuadProblem& problem, std::uint64_t most_steps) {
  return reference_by<Quad>(problem, {38, 1e-30, most_steps}, {32, 1e-28, 2 * most_steps});
}

Reference<Long> quick_reference(const QuadProblem& problem, std::uint64_t most_steps) {
  constexpr double last_bit = 0x1p-63;
  return reference_by<Long>(problem, {24, 1e-20, most_steps}, {20, 1e-20, 2 * most_steps, last_bit});
}

}  // namespace qdot::test
