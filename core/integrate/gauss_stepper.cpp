#include "core/integrate/gauss_stepper.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/integrate/evaluator.hpp"
#include "core/integrate/gauss_stages.hpp"

namespace qdot {
namespace {

constexpr double same_step = 1e-9;  // a last step longer or shorter by this share of h is no step of its own

RightHandSide in_stepped_variables(const RightHandSide& system) {
  if (!system.canonical) return system;
  RightHandSide stepped;
  stepped.dimension = system.dimension;
  stepped.derivative = system.canonical->derivative;
  stepped.jacobian = system.canonical->jacobian;
  return stepped;
}

/// The cubic that takes values and slopes at both ends of a step, and its derivative.
struct Hermite {
  double h, z0, z1, f0, f1;
  double value(double x) const {
    const double bend = (1 - 2 * x) * (z1 - z0) + h * ((x - 1) * f0 + x * f1);
    return (1 - x) * z0 + x * z1 + x * (x - 1) * bend;
  }
  double slope(double x) const {
    const double rise = (z1 - z0) / h;
    return (1 - x) * f0 + x * f1 + 3 * x * (1 - x) * (2 * rise - f0 - f1);
  }
};

class GaussStepper final : public Stepper {
 public:
  GaussStepper(const RightHandSide& system, const RunRequest& request)
      : system_(system),
        request_(request),
        stepped_(in_stepped_variables(system)),
        evaluator_(stepped_, request.limits),
        stages_(evaluator_, system.dimension, static_cast<bool>(stepped_.jacobian)),
        now_{request.t_start, request.y_start, {}, request.y_start, {}},
        guess_(gauss_stages * system.dimension) {
    for (auto* values : {&now_.carried, &now_.slope, &attempt_.z, &attempt_.carried, &attempt_.slope}) {
      values->resize(system.dimension);
    }
    attempt_.y.resize(system.dimension);
    before_ = now_;
    slopes_ = guess_;
  }

  std::optional<Ending> step() override {
    if (steps_ > 0) evaluator_.forget_trouble();
    if (steps_ == 0) {
      if (const auto failed = start()) return failed;
    }
    const double t = next_time();
    set_guess(t - now_.t, now_.t);
    if (const auto failed = move(now_, t, attempt_)) return failed;
    std::swap(before_, now_);
    std::swap(now_, attempt_);
    slopes_.swap(guess_);
    ++steps_;
    return std::nullopt;
  }

  std::optional<Ending> interpolate(double t, std::span<double> y_out) override {
    if (t == now_.t || t == before_.t) {
      std::ranges::copy(t == now_.t ? now_.y : before_.y, y_out.begin());
      return std::nullopt;
    }
    set_guess(t - before_.t, before_.t);
    if (const auto failed = move(before_, t, attempt_)) return failed;
    std::ranges::copy(attempt_.y, y_out.begin());
    return std::nullopt;
  }

  std::optional<Ending> sketch(double t, std::span<double> y_out) override {
    const double h = now_.t - before_.t;
    const double x = (t - before_.t) / h;
    const std::size_t n = y_out.size() / 2;
    for (std::size_t i = 0; i < y_out.size(); ++i) {
      const Hermite cubic{h, before_.z[i], now_.z[i], before_.slope[i], now_.slope[i]};
      if (!system_.canonical || i < n) y_out[i] = cubic.value(x);
      if (system_.canonical && i < n) y_out[n + i] = cubic.slope(x);
    }
    return std::nullopt;
  }

  double t_previous() const override { return before_.t; }
  double t() const override { return now_.t; }
  std::span<const double> y() const override { return now_.y; }
  std::optional<Ending> trouble() const override { return evaluator_.trouble(); }
  std::uint64_t steps() const override { return steps_; }
  std::uint64_t evaluations() const override { return evaluator_.evaluations(); }

 private:
  /// A place of the motion; `slope` is z' there.
  struct Place {
    double t{};
    std::vector<double> z, carried, y, slope;
  };

  std::optional<Ending> start() {
    if (system_.canonical) {
      switch (system_.canonical->variables(now_.t, request_.y_start, now_.z)) {
        case Evaluation::ok:
          break;
        case Evaluation::nonfinite:
          return Ending::nonfinite;
        case Evaluation::singular_mass:
          return Ending::singular_mass;
      }
    }
    const auto failed = evaluate_slope(now_);
    now_.y = request_.y_start;
    return failed;
  }

  double next_time() const {
    const double t = std::fma(static_cast<double>(steps_ + 1), request_.h, request_.t_start);
    return request_.t_end - t < same_step * request_.h ? request_.t_end : t;
  }

  /// The slopes at the nodes of a step of length h from `begin`, by the polynomial through those of the last
  /// step and the one at its end.
  void set_guess(double h, double begin) {
    const double length = now_.t - before_.t;
    const std::size_t n = now_.z.size();
    for (std::size_t j = 0; j < gauss_stages; ++j) {
      const double x = length > 0 ? (begin - before_.t + GaussStages::nodes()[j] * h) / length : 1.0;
      const std::array<double, gauss_stages + 1> weight = weights(x);
      for (std::size_t i = 0; i < n; ++i) {
        double slope = weight[gauss_stages] * now_.slope[i];
        for (std::size_t k = 0; k < gauss_stages; ++k) slope += weight[k] * slopes_[k * n + i];
        guess_[j * n + i] = slope;
      }
    }
  }

  /// Lagrange's polynomials of the nodes and of 1, at x.
  static std::array<double, gauss_stages + 1> weights(double x) {
    std::array<double, gauss_stages + 1> place{}, weight{};
    std::ranges::copy(GaussStages::nodes(), place.begin());
    place[gauss_stages] = 1;
    for (std::size_t k = 0; k <= gauss_stages; ++k) {
      weight[k] = 1;
      for (std::size_t l = 0; l <= gauss_stages; ++l) {
        if (l != k) weight[k] *= (x - place[l]) / (place[k] - place[l]);
      }
    }
    return weight;
  }

  /// A step of the method from one place to time t, from the slopes in guess_, which it leaves solved for.
  std::optional<Ending> move(const Place& from, double t, Place& to) {
    const double h = t - from.t;
    const Answer answer = stages_.solve({from.t, from.z, from.carried}, h, guess_);
    evaluator_.rethrow();
    if (answer == answer_stop) return evaluator_.trouble();
    if (answer == answer_retry) return Ending::no_convergence;
    to.t = t;
    for (std::size_t i = 0; i < from.z.size(); ++i) {
      const double rise = stages_.rise(h, guess_, i) + from.carried[i];
      to.z[i] = from.z[i] + rise;
      const double taken = to.z[i] - from.z[i];
      to.carried[i] = (from.z[i] - (to.z[i] - taken)) + (rise - taken);
    }
    return evaluate_slope(to);
  }

  /// z' at a place, and y, of which z' has the velocities.
  std::optional<Ending> evaluate_slope(Place& place) {
    const Answer answer = evaluator_.derivative(place.t, place.z, place.slope);
    evaluator_.rethrow();
    if (answer != answer_ok) return evaluator_.trouble();
    place.y = place.z;
    const auto n = static_cast<std::ptrdiff_t>(place.y.size() / 2);
    if (system_.canonical) std::copy_n(place.slope.begin(), n, place.y.begin() + n);
    return std::nullopt;
  }

  const RightHandSide& system_;
  const RunRequest& request_;
  RightHandSide stepped_;
  Evaluator evaluator_;
  GaussStages stages_;
  Place now_, before_, attempt_;
  std::vector<double> slopes_;  ///< F of the last step
  std::vector<double> guess_;
  std::uint64_t steps_{};
};

}  // namespace

std::unique_ptr<Stepper> make_gauss_stepper(const RightHandSide& system, const RunRequest& request) {
  if (!(request.h > 0)) throw std::invalid_argument("gauss needs a step");
  return std::make_unique<GaussStepper>(system, request);
}

}  // namespace qdot
