#include "tests/calibration/quad_reference.hpp"

#include <quadmath.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace qdot::test {
namespace {

constexpr int pieces = 16;  ///< of a step, between which an impact's sign is looked at

class Integration {
 public:
  Integration(const QuadProblem& problem, const QuadMethod& method)
      : problem_(problem), method_(method), n_(problem.y_start.size() / 2), recording_(method.order) {
    for (const auto& [name, value] : problem.parameters) parameters_[name] = value;
    for (const double value : problem.y_start) y_.push_back(value);
    largest_.assign(2 * n_, Quad(0));
    t_ = problem.t_start;
    record();
  }

  QuadMotion run() {
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
    const Series wave =
        wave_sign_ * (exp(Quad(-f.decay) * time_) * cos(Quad(f.phase) + Quad(f.frequency) * time_));
    accelerations_ =
        quad_accelerations(problem_.system)(parameters_, time_, q_, v_, Quad(f.amplitude) * wave);
  }

  void expand() {
    for (unsigned k = 0; k <= method_.order; ++k)
      recording_.coefficients(time_)[k] = k == 0 ? t_ : Quad(k == 1);
    for (unsigned k = 0; k <= method_.order; ++k)
      recording_.coefficients(wave_sign_)[k] = k == 0 ? sign_ : Quad(0);
    for (std::size_t i = 0; i < 2 * n_; ++i) row(i)[0] = y_[i];
    for (unsigned k = 0; k < method_.order; ++k) {
      recording_.advance(k);
      for (std::size_t i = 0; i < n_; ++i) {
        row(i)[k + 1] = row(n_ + i)[k] / Quad(k + 1);
        row(n_ + i)[k + 1] = recording_.coefficients(accelerations_[i])[k] / Quad(k + 1);
      }
    }
  }

  [[nodiscard]] Quad* row(std::size_t i) { return recording_.coefficients(i < n_ ? q_[i] : v_[i - n_]); }

  [[nodiscard]] Quad value(std::size_t i, Quad s) {
    const Quad* c = row(i);
    Quad sum = c[method_.order];
    for (unsigned k = method_.order; k-- > 0;) sum = sum * s + c[k];
    return sum;
  }

  /// The last two terms of every component are as large as the tolerance.
  [[nodiscard]] Quad step_size() {
    Quad h = HUGE_VALQ;
    for (std::size_t i = 0; i < 2 * n_; ++i) {
      largest_[i] = fmaxq(fabsq(y_[i]), last_h_ * fabsq(row(i)[1]));
      for (unsigned k = method_.order - 1; k <= method_.order; ++k) {
        const Quad c = fabsq(row(i)[k]);
        if (c == 0) continue;
        const Quad w = Quad(method_.tolerance) * fmaxq(largest_[i], Quad(1e-300));
        h = fminq(h, expq(logq(w / c) / Quad(k)));
      }
    }
    return h;
  }

  void step() {
    const Quad end = problem_.grid.back();
    const std::optional<Quad> kink = next_kink();
    sign_ = problem_.force.rectified && cosq(argument(kink ? (t_ + *kink) / 2 : t_ + 1)) < 0 ? -1 : 1;
    if (problem_.force.amplitude < 0 && problem_.force.rectified) sign_ = -sign_;
    expand();
    Quad h = fminq(step_size(), end - t_);
    if (kink && *kink - t_ < h) h = *kink - t_;
    const std::optional<Quad> impact = problem_.impacts ? find_impact(h) : std::nullopt;
    if (impact) h = *impact;
    const Quad before = t_;
    t_ = h == end - t_ ? end : (kink && h == *kink - t_ ? *kink : t_ + h);
    for (std::size_t i = 0; i < 2 * n_; ++i) y_[i] = value(i, h);
    sample(before, t_);
    if (impact) apply_impact();
    last_h_ = h;
    ++motion_.steps;
  }

  [[nodiscard]] Quad argument(Quad t) const {
    return Quad(problem_.force.frequency) * t + Quad(problem_.force.phase);
  }

  /// The next zero of a rectified wave.
  [[nodiscard]] std::optional<Quad> next_kink() const {
    const Forcing& f = problem_.force;
    if (!f.rectified || f.frequency == 0) return std::nullopt;
    const Quad direction = f.frequency > 0 ? 1 : -1;
    Quad k = ceilq(direction * (argument(t_) / pi_ - Quad(0.5)));
    for (;; k += 1) {
      const Quad t = ((direction * k + Quad(0.5)) * pi_ - Quad(f.phase)) / Quad(f.frequency);
      if (t > t_ + fabsq(t_) * Quad(1e-30) + Quad(1e-30) / fabsq(Quad(f.frequency))) return t;
    }
  }

  /// Rows in (before, now], and the start itself.
  void sample(Quad before, Quad now) {
    for (; motion_.rows < problem_.grid.size() && Quad(problem_.grid[motion_.rows]) <= now; ++motion_.rows) {
      const Quad t = problem_.grid[motion_.rows];
      for (std::size_t i = 0; i < 2 * n_; ++i)
        motion_.state.push_back(t == now ? y_[i] : value(i, t - before));
    }
  }

  [[nodiscard]] Quad foot(Quad s) { return value(1, s) - 2 * value(0, s); }

  /// phi - 2 theta rising through 0 with theta < 0; the zero at the start of a stride does not count.
  [[nodiscard]] std::optional<Quad> find_impact(Quad h) {
    Quad from = 0;
    bool below = !at_stride_start_ && foot(0) < 0;
    for (int i = 1; i <= pieces; ++i) {
      const Quad to = h * i / pieces;
      const bool now_below = foot(to) < 0;
      if (below && !now_below) {
        const Quad zero = zero_between(from, to);
        if (value(0, zero) < 0) return zero;
      }
      below = now_below;
      from = to;
    }
    at_stride_start_ = false;
    return std::nullopt;
  }

  [[nodiscard]] Quad zero_between(Quad low, Quad high) {
    for (int i = 0; i < 120; ++i) {
      const Quad middle = (low + high) / 2;
      (foot(middle) < 0 ? low : high) = middle;
    }
    return high;
  }

  /// Angular momentum is kept about the new contact and, for the new swing leg, about the hip.
  void apply_impact() {
    motion_.impacts.push_back(static_cast<double>(t_));
    const Quad mu = parameters_.at("m") / parameters_.at("M");
    const Quad theta = y_[0], c = cosq(2 * theta), s = sinq(2 * theta);
    const Quad rate = c * y_[2] / (1 + mu * s * s);
    y_ = {-theta, -2 * theta, rate, (1 - c) * rate};
    at_stride_start_ = true;
  }

  const QuadProblem& problem_;
  const QuadMethod& method_;
  std::size_t n_;
  Recording recording_;
  QuadValues parameters_;
  Series time_, wave_sign_;
  std::vector<Series> q_, v_, accelerations_;
  std::vector<Quad> y_, largest_;
  Quad t_{}, last_h_{}, sign_{1}, pi_{acosq(-1)};
  bool at_stride_start_{};
  QuadMotion motion_;
};

}  // namespace

QuadMotion quad_motion(const QuadProblem& problem, const QuadMethod& method) {
  return Integration(problem, method).run();
}

QuadReference quad_reference(const QuadProblem& problem, std::uint64_t most_steps) {
  QuadReference reference{quad_motion(problem, {38, 1e-30, most_steps}), {}};
  const QuadMotion check = quad_motion(problem, {32, 1e-28, 2 * most_steps});
  reference.motion.rows = std::min(reference.motion.rows, check.rows);
  const std::size_t numbers = reference.motion.rows * problem.y_start.size();
  for (std::size_t i = 0; i < numbers; ++i) {
    reference.doubt.push_back(static_cast<double>(fabsq(reference.motion.state[i] - check.state[i])));
  }
  return reference;
}

}  // namespace qdot::test
