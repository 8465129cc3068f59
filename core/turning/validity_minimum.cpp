#include "core/turning/validity_minimum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/numerics/constants.hpp"
#include "core/numerics/linear_system.hpp"

namespace qdot {
namespace {

constexpr int samples = 32;
constexpr double revolution = 2 * std::numbers::pi;
constexpr double finest_phase_step = 5e-4;  ///< of the phase; the value is flat there to round-off

/// The whole state on the way: the ignored velocities follow from their momenta, which are linear in them.
class State {
 public:
  State(const Dynamics& dynamics, const Reduction& reduction, std::span<const double> parameters,
        std::span<const double> momenta, std::span<const double> y0)
      : reduction_(reduction), momenta_(momenta), y_(y0.begin(), y0.end()) {
    if (momenta.empty()) return;
    function_ = dynamics.columns(momentum_columns(dynamics.model(), reduction.ignored));
    workspace_ = function_->bind(parameters);
  }

  /// False where there is none.
  bool move_to(double x, double x_dot) {
    const std::size_t n = y_.size() / 2;
    y_[reduction_.kept[0]] = x;
    y_[n + reduction_.kept[0]] = x_dot;
    return momenta_.empty() || solve_rates();
  }

  [[nodiscard]] std::span<const double> y() const { return y_; }

 private:
  bool solve_rates() {
    const std::size_t n = y_.size() / 2;
    const std::size_t count = momenta_.size();
    const auto set_rates = [&](std::size_t one) {
      for (std::size_t k = 0; k < count; ++k) y_[n + reduction_.ignored[k]] = k == one ? 1 : 0;
    };
    std::vector<double> base(count), column(count), matrix(count * count);
    set_rates(count);
    if (function_->evaluate(0, y_, workspace_, base) != Evaluation::ok) return false;
    for (std::size_t k = 0; k < count; ++k) {
      set_rates(k);
      if (function_->evaluate(0, y_, workspace_, column) != Evaluation::ok) return false;
      for (std::size_t i = 0; i < count; ++i) matrix[i * count + k] = column[i] - base[i];
    }
    for (std::size_t i = 0; i < count; ++i) base[i] = momenta_[i] - base[i];
    if (!solve_linear(count, matrix, base)) return false;
    for (std::size_t k = 0; k < count; ++k) y_[n + reduction_.ignored[k]] = base[k];
    return true;
  }

  const Reduction& reduction_;
  std::span<const double> momenta_;
  std::vector<double> y_;
  std::shared_ptr<const CompiledFunction> function_;
  Workspace workspace_;
};

}  // namespace

std::vector<ValidityMinimum> validity_minima(const Dynamics& dynamics, const Reduction& reduction,
                                             std::span<const double> parameters,
                                             std::span<const double> momenta, std::span<const double> y0,
                                             const PhasePath& path) {
  const std::vector<Column> columns = validity_columns(dynamics.model());
  if (columns.empty()) return {};
  const auto function = dynamics.columns(columns);
  Workspace workspace = function->bind(parameters);
  State state(dynamics, reduction, parameters, momenta, y0);
  std::vector<double> values(columns.size());
  std::vector<ValidityMinimum> result(columns.size());
  const auto evaluate_at = [&](double phase) {
    const auto [x, x_dot] = path(phase);
    if (!state.move_to(x, x_dot) || function->evaluate(0, state.y(), workspace, values) != Evaluation::ok) {
      std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      ValidityMinimum& least = result[i];
      if (std::isnan(values[i])) least.reason = "It has no value somewhere along the motion.";
      if (!least.value || values[i] < *least.value) {
        least.value = values[i];
        least.x = x;
        least.x_dot = x_dot;
      }
    }
  };
  std::vector<double> phases(columns.size());
  for (int k = 0; k < samples; ++k) {
    std::vector<std::optional<double>> before;
    for (const ValidityMinimum& least : result) before.push_back(least.value);
    evaluate_at(revolution * k / samples);
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (result[i].value != before[i]) phases[i] = revolution * k / samples;
    }
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    double centre = phases[i];
    for (double h = revolution / samples; h > finest_phase_step; h /= 4) {  // to the vertex of a parabola
      std::array<double, 3> w;
      for (int k = 0; k < 3; ++k) {
        evaluate_at(centre + (k - 1) * h);
        w[static_cast<std::size_t>(k)] = values[i];
      }
      const double curvature = w[0] - 2 * w[1] + w[2];
      if (!(curvature > 0)) break;
      centre += h * std::clamp((w[0] - w[2]) / (2 * curvature), -1.0, 1.0);
    }
    evaluate_at(centre);
    result[i].condition = i;
    if (!result[i].reason.empty()) result[i].value.reset();
  }
  return result;
}

std::vector<ValidityMinimum> proven_minima(EnclosedMotion& motion, std::size_t conditions) {
  std::vector<ValidityMinimum> minima;
  for (std::size_t i = 0; i < conditions; ++i) {
    const std::optional<LeastValue> least = motion.least(i);
    if (!least) return {};
    const double error = (least->range - Interval(least->value)).magnitude();
    minima.push_back({i, least->value, error, least->x, least->x_dot, ""});
  }
  return minima;
}

}  // namespace qdot
