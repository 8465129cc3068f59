#include "core/motion/kink_ends.hpp"

#include <algorithm>
#include <limits>
#include <memory>

#include "core/compile/taylor/composition.hpp"
#include "core/integrate/methods.hpp"

namespace qdot {
namespace {

constexpr double some_round_off = 32 * std::numeric_limits<double>::epsilon();
constexpr double step_errors = 10;  ///< that u may have gathered, in units of the tolerances

/// What of a kink ends a section: factor times a function, plus a margin.
struct End {
  std::shared_ptr<const CompiledFunction> function;
  double factor{}, margin{};
  double t_begin{};
  unsigned contact{};  ///< so many coefficients at t_begin are 0
};

decltype(EventFunction::series) series_along(const End& end, const std::vector<double>& parameters) {
  return [end, along = std::make_shared<TaylorComposition>(end.function, parameters)](
             const MotionPiece& piece, unsigned order, std::span<double> c) {
    const double rest = along->expand(piece.t, piece.rows, piece.order, piece.h, order, c);
    for (double& x : c) x *= end.factor;
    if (end.contact > 0 && piece.t == end.t_begin) {
      std::fill_n(c.begin(), std::min<std::size_t>(end.contact, c.size()), 0.0);
    } else {
      c[0] += end.margin;
    }
    return rest;
  };
}

decltype(EventFunction::value) value_along(const End& end, const std::vector<double>& parameters) {
  return [end, workspace = end.function->bind(parameters)](double t, std::span<const double> y) mutable {
    double value{};
    const bool ok = end.function->evaluate(t, y, workspace, {&value, 1}) == Evaluation::ok;
    return ok ? end.factor * value + end.margin : std::numeric_limits<double>::quiet_NaN();
  };
}

}  // namespace

std::vector<EventFunction> kink_ends(const KinkModes& modes, const KinkModes::Way& way, double t,
                                     Method method, const Tolerances& tolerances) {
  const std::vector<double> with = modes.parameters(way.sides);
  const std::shared_ptr<const KinkedMotion> functions = modes.motion(way.sides);
  std::vector<EventFunction> ends;
  for (std::size_t k = 0; k < way.sides.size(); ++k) {
    const bool stays = way.sides[k] == 0, leaves = way.contact[k] > 0;
    End end{stays ? functions->holds[k] : functions->arguments[k], stays ? 1.0 : way.sides[k], 0, t, 0};
    if (leaves && record_of(method).expands()) {
      end.margin = some_round_off * way.size[k];
      end.contact = way.contact[k];
    } else if (leaves) {
      end.margin = step_errors * (tolerances.atol + tolerances.rtol * way.size[k]);
    }
    ends.push_back({.value = value_along(end, with),
                    .series = series_along(end, with),
                    .direction = Crossing::falling,
                    .terminal = true,
                    .counts_at_start = false,
                    .condition = {},
                    .sign_at_start = 1,
                    .rounding_at_start = [rounding = some_round_off * way.size[k]] { return rounding; },
                    .ends_where_hidden = !stays,
                    .must_have_value = true,
                    .is_zero_at_start = leaves});
  }
  return ends;
}

}  // namespace qdot
