#include "core/motion/sided_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/compile/sharp_signs.hpp"
#include "core/compile/taylor/composition.hpp"
#include "core/compile/taylor/expansion.hpp"
#include "core/motion/extended_pieces.hpp"

namespace qdot {
namespace {

constexpr double of_state = 2 * std::numeric_limits<double>::epsilon();  ///< rounding
constexpr int doublings = 60;  ///< of the time after which a sign is looked for

}  // namespace

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

std::vector<Ball> SidedMotions::numbers(const Reals& parameters, const Sides& sides) {
  std::vector<Ball> all = parameters.as<Ball>();
  for (const int side : sides) all.emplace_back(side);
  return all;
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

bool SidedMotions::tells(const Sides& sides, double s) {
  if (!series(sides)) return false;
  const std::vector<double>& all = rows(sides);
  for (std::size_t i = 0; i < all.size(); i += order + 1) {
    double power = 1, size = 0, last = 0;
    for (std::size_t k = 0; k <= order; ++k, power *= s) {
      const double term = std::abs(all[i + k]) * power;
      size += term;
      if (k + 1 >= order) last += term;
    }
    if (!(last <= of_state * size)) return false;
  }
  return true;
}

std::vector<double> SidedMotions::sums_at(double s, std::span<const double> rows) {
  std::vector<double> sums(rows.size() / (order + 1));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    for (std::size_t k = order + 1; k-- > 0;) sums[i] = sums[i] * s + rows[i * (order + 1) + k];
  }
  return sums;
}

std::vector<Interval> SidedMotions::enclosed_geometry(const Sides& sides, double t,
                                                      std::span<const double> y) {
  const std::vector<double> with = parameters(sides);
  const std::vector<Interval> constants(with.begin(), with.end());
  if (!enclosed_geometry_)
    enclosed_geometry_.emplace(kinks_.geometry, constants);
  else
    enclosed_geometry_->bind(constants);
  std::vector<Interval> places(kinks_.geometry.outputs());
  enclosed_geometry_->set_time(t);
  (*enclosed_geometry_)(std::vector<Interval>(y.begin(), y.end()), places);
  return places;
}

bool SidedMotions::is_told(const Sides& sides, std::size_t kink, double t, std::span<const double> y) {
  return !enclosed_geometry(sides, t, y)[kink * (2 + y.size())].contains(0);
}

bool SidedMotions::is_slope_told(const Sides& sides, std::size_t kink) {
  const std::vector<Interval> places = enclosed_geometry(sides, t_, y_);
  const std::size_t first = kink * (2 + y_.size());
  Interval slope = places[first + 1];
  for (std::size_t i = 0; i < y_.size(); ++i)
    slope = slope + places[first + 2 + i] * Interval(rate(sides, i));
  return !slope.contains(0);
}

bool SidedMotions::is_gradient_told(const Sides& sides, std::size_t kink) {
  const std::vector<Interval> places = enclosed_geometry(sides, t_, y_);
  const auto slopes = std::span(places).subspan(kink * (2 + y_.size()) + 2, y_.size());
  return std::ranges::any_of(slopes, [](const Interval& slope) { return !slope.contains(0); });
}

std::vector<double> SidedMotions::told_series(const Sides& sides, std::size_t kink) {
  if (is_slope_told(sides, kink)) return (*series(sides))[kink];
  const std::vector<Ball> with = numbers(parameters_, sides);
  const auto of_motion =
      sharp_series({*mode(sides)->motion->arguments[kink], with, t_, rows(sides), order + 1});
  std::vector<double> told;
  for (std::size_t k = 0; k <= order; ++k)
    told.push_back(of_motion[k].contains_zero() ? 0 : of_motion[k].value());
  return told;
}

bool SidedMotions::is_told(std::size_t kink, const Sides& sides, std::span<const double> rows, double s,
                           int sign) {
  const Mode& with = *mode(sides);
  TapeEvaluator<Interval> u(*with.motion->arguments[kink],
                            std::vector<Interval>(with.parameters.begin(), with.parameters.end()));
  const std::vector<double> y = sums_at(s, rows);
  Interval value;
  u.set_time(t_ + s);
  u(std::vector<Interval>(y.begin(), y.end()), {&value, 1});
  return sign > 0 ? value.lower > 0 : value.upper < 0;
}

std::vector<SignPiece> SidedMotions::argument_signs(std::size_t kink, const Sides& sides,
                                                    std::span<const double> rows, double from, double to) {
  const std::vector<Ball> with = numbers(parameters_, sides);
  return sharp_signs({*mode(sides)->motion->arguments[kink], with, t_, rows, order + 1}, from, to,
                     resolution_);
}

double SidedMotions::told_after(const Sides& sides, std::size_t kink, const std::optional<Typed>& place) {
  const std::vector<double> along = rows(sides);
  double to = resolution_;
  for (int i = 0; i < doublings && tells(sides, 2 * to) && !is_told(kink, sides, along, to, sides[kink]); ++i)
    to *= 2;
  const std::vector<Ball> with = numbers(place ? place->parameters : Reals(parameters_), sides);
  const std::vector<Ball> start = place ? place->y.as<Ball>() : std::vector<Ball>();
  const FunctionAlong argument{*mode(sides)->motion->arguments[kink], with, t_, along, order + 1, start};
  double after = 0;
  for (const SignPiece& piece : sharp_signs(argument, 0, to, resolution_)) {
    if (piece.sign != sides[kink]) after = piece.to;
  }
  return after;
}

double SidedMotions::time_elsewhere(const Sides& sides, std::size_t kink, double duration) {
  if (!tells(sides, duration)) return duration;
  double elsewhere = 0;
  for (const SignPiece& piece : argument_signs(kink, sides, rows(sides), -duration, 0)) {
    if (piece.sign != sides[kink]) elsewhere += piece.to - piece.from;
  }
  return elsewhere;
}

double SidedMotions::equivalent_side(const Sides& sides, std::size_t kink) {
  const Mode& with = *mode(sides);
  Workspace workspace = with.motion->sides[kink]->bind(with.parameters);
  double s{};
  const bool ok = with.motion->sides[kink]->evaluate(t_, y_, workspace, {&s, 1}) == Evaluation::ok;
  return ok ? s : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace qdot
