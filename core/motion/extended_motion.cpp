#include "core/motion/extended_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/compile/extended/expansion.hpp"

namespace qdot {
namespace {

using Form = ExtendedMotionRequest::Form;

constexpr double round_off_of_mixed = 1e-19;
/// Steps in double-doubles cost mostly by their number: the order in doubles, which makes them long, is
/// cheap.
constexpr unsigned order_of_mixed = TaylorExpansion::highest_order;
constexpr unsigned lower_order_of_mixed = 24;
constexpr double round_off_of_full = 1e-32;
constexpr unsigned order_beside_full = 24;  ///< of the series in doubles that tell what a step in full hides
/// Of coefficients: next to where doubles end, and where there is room on both sides.
constexpr int range_of_exponents = 830, exponent_at_start = 400;
constexpr double most_of_exponents = 400;  ///< of a unit of time, whose square is in the equations

std::vector<double> rounded(std::span<const DoubleDouble> numbers) {
  std::vector<double> result;
  for (const DoubleDouble& x : numbers) result.push_back(x.high);
  return result;
}

RightHandSide in_doubles(const CompiledFunction& accelerations, std::span<const DoubleDouble> parameters) {
  RightHandSide system;
  const auto expansion = std::make_shared<TaylorExpansion>(accelerations, rounded(parameters));
  system.expansion = [expansion](double t, std::span<const double> y, unsigned order, std::span<double> c) {
    return expansion->expand(t, y, order, c);
  };
  return system;
}

/// By series in doubles, whose remainder is bounded beyond their digits.
decltype(ExtendedSystem::hidden) hidden_of(const std::shared_ptr<TaylorExpansion>& expansion) {
  constexpr unsigned order = order_beside_full;
  return [expansion, t_expanded = 0.0, place = std::vector<double>(), c = std::vector<double>()](
             double t, std::span<const double> y, double h, std::span<const double> allowed,
             std::span<double> defect) mutable {
    if (t != t_expanded || !std::ranges::equal(place, y)) {
      c.resize(y.size() * (order + 1));
      place.clear();
      if (expansion->expand(t, y, order, c) != Evaluation::ok) return std::numeric_limits<double>::infinity();
      t_expanded = t;
      place.assign(y.begin(), y.end());
    }
    return expansion->bound_defect(h, allowed, defect);
  };
}

/// All computations in double-doubles have the rounding inside of their forces in common.
void look_between(ExtendedSystem& system, const CompiledFunction& accelerations,
                  const ExtendedMotionRequest& request) {
  const auto expansion = std::make_shared<TaylorExpansion>(accelerations, rounded(request.parameters));
  system.hidden = hidden_of(expansion);
  system.order_of_hidden = order_beside_full;
  const auto length = std::make_shared<double>();
  system.hidden = [hidden = system.hidden, length](double t, std::span<const double> y, double h,
                                                   std::span<const double> allowed,
                                                   std::span<double> defect) {
    *length = h;
    return hidden(t, y, h, allowed, defect);
  };
  system.rounding = [expansion, length](std::span<double> of_doubles, std::span<double> of_double_doubles) {
    std::ranges::fill(of_doubles, 0.0);
    expansion->find_ranges(*length);
    expansion->bound_rounding(of_double_doubles, taylor::half_unit_of_double_doubles);
  };
  if (!request.follow_rounding) return;
  system.in_doubles = in_doubles(accelerations, request.parameters);
  system.highest_in_doubles = order_beside_full;
}

/// By the series in doubles that the expansion has taken anyway.
decltype(ExtendedSystem::hidden) hidden_of(const std::shared_ptr<MixedExpansion>& expansion) {
  return [expansion](double t, std::span<const double> y, double h, std::span<const double> allowed,
                     std::span<double> defect) { return expansion->bound_defect(t, y, h, allowed, defect); };
}

double tolerance_of(const ExtendedMotionRequest& request) {
  if (request.rtol > 0) return request.rtol;
  return request.form == Form::full ? round_off_of_full : round_off_of_mixed;
}

unsigned order_of(const ExtendedMotionRequest& request) {
  if (request.taylor_order > 0) return request.taylor_order;
  return request.form == Form::full ? extended_order(tolerance_of(request), ExtendedExpansion::highest_order)
                                    : order_of_mixed;
}

bool is_in_range(const DoubleDouble& c) {
  return is_finite(c) && (c.high == 0 || std::ilogb(c.high) <= range_of_exponents);
}

/// log2 of what coefficients grow by from order to order, by two in range that are far apart; 0 where there
/// are none.
double growth(std::span<const DoubleDouble> series) {
  const auto is_usable = [&](std::size_t k) { return series[k].high != 0 && is_in_range(series[k]); };
  std::size_t later = series.size() - 1;
  while (later > 0 && !is_usable(later)) --later;
  std::size_t earlier = later / 2;
  while (earlier > 0 && !is_usable(earlier)) --earlier;
  if (later == 0 || !is_usable(earlier)) return 0;
  const int rise = std::ilogb(series[later].high) - std::ilogb(series[earlier].high);
  return rise / static_cast<double>(later - earlier);
}

/// A second, where coefficients at the start are in range by it, as those of most motions are; otherwise one
/// by which they are, with room for a motion that becomes faster or slower.
double unit_of_time_for(const ExtendedSystem& system, const ExtendedMotionRequest& request) {
  const unsigned order = std::max(order_of(request), system.order_of_hidden);
  std::vector<DoubleDouble> c(system.dimension * (order + 1));
  if (system.expansion(request.t_start, request.y_start, order, c) != Evaluation::ok) return 1;
  if (std::ranges::all_of(c, is_in_range)) return 1;
  double fastest = 0;
  for (std::size_t i = 0; i < system.dimension; ++i)
    fastest = std::max(fastest, growth(std::span(c).subspan(i * (order + 1), order + 1)));
  const double room = static_cast<double>(exponent_at_start) / order;
  return std::ldexp(1.0, -static_cast<int>(std::clamp(fastest - room, 0.0, most_of_exponents)));
}

ExtendedSystem system_of(const CompiledFunction& accelerations, const ExtendedMotionRequest& request) {
  ExtendedSystem system;
  system.dimension = request.y_start.size();
  const auto use = [&system](auto expansion) {
    system.expansion = [expansion](const DoubleDouble& t, std::span<const DoubleDouble> y, unsigned order,
                                   std::span<DoubleDouble> c) { return expansion->expand(t, y, order, c); };
  };
  if (request.form == Form::full) {
    use(std::make_shared<ExtendedExpansion>(accelerations, request.parameters));
    if (request.look_for_hidden) look_between(system, accelerations, request);
  } else {
    const auto mixed = std::make_shared<MixedExpansion>(accelerations, request.parameters);
    use(mixed);
    system.first_in_doubles = MixedExpansion::first_in_doubles;
    system.round_off = 1e-18;
    if (request.look_for_hidden) {
      system.hidden = hidden_of(mixed);
      system.rounding = [mixed](std::span<double> in_doubles, std::span<double> in_double_doubles) {
        mixed->bound_rounding(in_doubles, taylor::half_unit_of_doubles);
        mixed->bound_rounding(in_double_doubles, taylor::half_unit_of_double_doubles);
      };
      system.in_doubles = in_doubles(accelerations, request.parameters);
    }
  }
  return system;
}

}  // namespace

std::vector<DoubleDouble> double_doubles(const Reals& numbers) {
  std::vector<DoubleDouble> result;
  for (std::size_t i = 0; i < numbers.size(); ++i) result.push_back(numbers.exact(i).double_double());
  return result;
}

ExtendedMotionRequest extended_request(const Reals& parameters, const Reals& y_start, double t_start,
                                       std::span<const double> grid) {
  ExtendedMotionRequest result;
  result.parameters = double_doubles(parameters);
  result.y_start = double_doubles(y_start);
  result.t_start = t_start;
  result.grid.assign(grid.begin(), grid.end());
  return result;
}

ExtendedSystem extended_system(const CompiledFunction& accelerations, const ExtendedMotionRequest& request) {
  ExtendedSystem in_seconds = system_of(accelerations, request);
  const double unit = unit_of_time_for(in_seconds, request);
  if (unit == 1) return in_seconds;
  const auto by_clock = std::make_shared<const CompiledFunction>(accelerations.in_unit_of_time(unit));
  ExtendedSystem system = system_of(*by_clock, request);
  system.unit_of_time = unit;
  system.kept = by_clock;
  return system;
}

ExtendedRun extended_states(const Dynamics& dynamics, const ExtendedMotionRequest& request) {
  return extended_states(extended_system(dynamics.accelerations(), request), request);
}

ExtendedRun extended_states(const ExtendedSystem& system, const ExtendedMotionRequest& request) {
  const double rtol = tolerance_of(request);
  const ExtendedRunRequest run{.t_start = request.t_start,
                               .y_start = request.y_start,
                               .apart = request.apart,
                               .t_end = request.grid.empty() ? request.t_start : request.grid.back(),
                               .order = order_of(request),
                               .lower_order = request.form == Form::full ? 0 : lower_order_of_mixed,
                               .tolerances = {rtol, rtol * request.atol_over_rtol},
                               .limits = request.limits};
  return integrate(system, run, request.grid);
}

}  // namespace qdot
