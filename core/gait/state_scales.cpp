#include "core/gait/state_scales.hpp"

#include <array>
#include <cmath>

#include "core/mechanics/units.hpp"
#include "core/numerics/function.hpp"

namespace qdot {

using Eigen::Index;
using Eigen::VectorXd;

/// kg^a m^b s^c in the scene's scales.
StateScales::StateScales(const Model& model, std::span<const double> parameters) {
  std::array<double, 3> scale{1, 1, 1};
  if (const auto& scales = model.parsed.scales) {
    std::vector<Assignment> values;
    for (std::size_t i = 0; i < parameters.size(); ++i)
      values.emplace_back(model.parsed.symbols.parameters[i], parameters[i]);
    scale = {evaluate(scales->mass, values), evaluate(scales->length, values),
             evaluate(scales->time, values)};
  }
  for (double& s : scale)
    if (!(std::isfinite(s) && s > 0)) s = 1;
  time_unit_ = scale[2];
  const std::size_t n = model.degrees_of_freedom();
  units_ = VectorXd::Ones(static_cast<Index>(2 * n));
  for (std::size_t i = 0; i < n; ++i) {
    const auto parsed = parse_unit(model.scene.coordinates[i].unit);
    for (std::size_t k = 0; parsed && k < scale.size(); ++k) {
      const Exponent& e = parsed->dimension.exponents[k];
      units_[static_cast<Index>(i)] *= power(scale[k], static_cast<double>(e.numerator) / e.denominator);
    }
    units_[static_cast<Index>(n + i)] = units_[static_cast<Index>(i)] / time_unit_;
  }
}

std::vector<double> StateScales::in_si(const VectorXd& state) const {
  std::vector<double> y(static_cast<std::size_t>(state.size()));
  for (Index i = 0; i < state.size(); ++i) y[static_cast<std::size_t>(i)] = state[i] * units_[i];
  return y;
}

EventFunction StateScales::event(const Watch& watch) const {
  const auto state = [this](std::span<const double> y) {
    return in_si(Eigen::Map<const VectorXd>(y.data(), units_.size()));
  };
  EventFunction event = watch.event();
  event.value = [state, value = watch.value](double, std::span<const double> y) {
    return value(0, state(y));
  };
  event.series = [this, series = watch.series](const MotionPiece& piece, unsigned order,
                                               std::span<double> coefficients) {
    std::vector<double> rows(piece.rows.begin(), piece.rows.end());
    const std::size_t width = piece.order + 1;
    for (std::size_t i = 0; i * width < rows.size(); ++i) {
      double unit = units_[static_cast<Index>(i)];
      for (std::size_t k = 0; k < width; ++k, unit /= time_unit_) rows[i * width + k] *= unit;
    }
    const double rest = series({0, piece.h * time_unit_, rows, piece.order}, order, coefficients);
    double power = 1;
    for (double& c : coefficients) {
      c *= power;
      power *= time_unit_;
    }
    return rest;
  };
  if (watch.condition) {
    event.condition = [state, condition = watch.condition](double, std::span<const double> y) {
      return condition(0, state(y));
    };
  }
  return event;
}

}  // namespace qdot
