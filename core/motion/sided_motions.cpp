#include "core/motion/sided_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/compile/taylor/composition.hpp"
#include "core/compile/taylor/expansion.hpp"
#include "core/motion/extended_pieces.hpp"

namespace qdot {

Staying staying_on(const Sides& sides) {
  Staying staying;
  for (const int side : sides) staying.push_back(side == 0);
  return staying;
}

struct SidedMotions::Mode {
  std::shared_ptr<const KinkedMotion> motion;
  TaylorExpansion expansion;
  std::vector<std::unique_ptr<TaylorComposition>> arguments;
  std::vector<double> parameters, rows;

  Mode(std::shared_ptr<const KinkedMotion> of, std::vector<double> with)
      : motion(std::move(of)), expansion(motion->accelerations, with), parameters(std::move(with)) {
    for (const auto& u : motion->arguments) {
      arguments.push_back(std::make_unique<TaylorComposition>(u, parameters));
    }
  }
};

SidedMotions::SidedMotions(const Dynamics& dynamics, std::span<const double> parameters, double resolution)
    : dynamics_(dynamics),
      kinks_(*dynamics.kinks()),
      parameters_(parameters.begin(), parameters.end()),
      resolution_(resolution) {}

SidedMotions::~SidedMotions() = default;

std::vector<double> SidedMotions::parameters(const Sides& sides) const {
  std::vector<double> all = parameters_;
  all.insert(all.end(), sides.begin(), sides.end());
  return all;
}

std::shared_ptr<const KinkedMotion> SidedMotions::motion(const Sides& sides) const {
  return dynamics_.kinked(staying_on(sides));
}

SidedMotions::Mode* SidedMotions::mode(const Sides& sides) {
  const auto [place, is_new] = modes_.try_emplace(sides);
  if (is_new) {
    if (auto functions = motion(sides)) {
      place->second = std::make_unique<Mode>(std::move(functions), parameters(sides));
    }
  }
  return place->second.get();
}

std::vector<double> SidedMotions::geometry(const Sides& sides, double t, std::span<const double> y) const {
  Workspace workspace = kinks_.geometry.bind(parameters(sides));
  std::vector<double> values(kinks_.geometry.outputs());
  if (kinks_.geometry.evaluate(t, y, workspace, values) == Evaluation::ok) return values;
  return std::vector<double>(values.size(), std::numeric_limits<double>::quiet_NaN());
}

double SidedMotions::exact_argument(std::size_t kink, const Sides& sides, double t,
                                    std::span<const double> y) {
  const Mode& with = *mode(sides);
  const std::vector<DoubleDouble> constants(with.parameters.begin(), with.parameters.end());
  ExtendedFunction u(*with.motion->arguments[kink], constants);
  return u(t, std::vector<DoubleDouble>(y.begin(), y.end())).front().value();
}

int SidedMotions::argument_sign(std::size_t kink, const Sides& sides, double t, std::span<const double> y) {
  return argument_sign(kink, sides, {Reals(parameters_), t, Reals(y)});
}

int SidedMotions::argument_sign(std::size_t kink, const Sides& sides, const Typed& place) {
  const Mode* const with = mode(sides);
  if (with == nullptr) return 0;
  std::vector<Ball> numbers = place.parameters.as<Ball>();
  for (const int side : sides) numbers.emplace_back(side);
  TapeEvaluator<Ball> u(*with->motion->arguments[kink], numbers);
  u.set_time(Ball::literal(place.t));
  Ball value;
  u(place.y.as<Ball>(), {&value, 1});
  if (!value.is_finite() || value.contains_zero()) return 0;
  return value.value() > 0 ? 1 : -1;
}

void SidedMotions::look_from(double t, std::span<const double> y) {
  t_ = t;
  y_.assign(y.begin(), y.end());
  series_.clear();
}

const SidedMotions::Series& SidedMotions::series(const Sides& sides) {
  const auto [place, is_new] = series_.try_emplace(sides);
  Series& result = place->second;
  Mode* const with = is_new ? mode(sides) : nullptr;
  if (with == nullptr) return result;
  with->rows.resize(y_.size() * (order + 1));
  if (with->expansion.expand(t_, y_, order, with->rows) != Evaluation::ok) return result;
  if (!std::ranges::all_of(with->rows, [](double c) { return std::isfinite(c); })) return result;
  result.emplace();
  for (const auto& u : with->arguments) {
    std::vector<double>& c = result->emplace_back(order + 1);
    (void)u->expand(t_, with->rows, order, resolution_, order, c);
  }
  return result;
}

const std::vector<double>& SidedMotions::rows(const Sides& sides) { return mode(sides)->rows; }

std::optional<std::vector<double>> SidedMotions::rows_from(const Sides& sides, std::span<const double> y) {
  std::vector<double> rows(y.size() * (order + 1));
  const bool ok = mode(sides)->expansion.expand(t_, y, order, rows) == Evaluation::ok;
  return ok ? std::optional(std::move(rows)) : std::nullopt;
}

double SidedMotions::equivalent_side(const Sides& sides, std::size_t kink) {
  const Mode& with = *mode(sides);
  Workspace workspace = with.motion->sides[kink]->bind(with.parameters);
  double s{};
  const bool ok = with.motion->sides[kink]->evaluate(t_, y_, workspace, {&s, 1}) == Evaluation::ok;
  return ok ? s : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace qdot
