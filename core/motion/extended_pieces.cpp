#include "core/motion/extended_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "core/integrate/unit_of_time.hpp"

namespace qdot {
namespace {

constexpr unsigned order_beside = 6;    ///< of the series from a known instant to the one beside it
constexpr double farthest_part = 1e-3;  ///< of a piece's duration: where these few terms do
constexpr int most_secants = 12;
constexpr double as_near_as_can_be = 0x1p-90;  ///< of the instant
constexpr double clearly_beside = 0x1p30;      ///< times that
constexpr int looks_beside = 4;

std::vector<Ball> balls(std::span<const DoubleDouble> numbers) {
  std::vector<Ball> result;
  for (const DoubleDouble& x : numbers) result.emplace_back(x, 0.0);
  return result;
}

/// Whether g goes through zero there, farther and farther on both sides: at a multiple root all of it may be
/// rounding.
template <class Function>
bool is_crossed(const Function& g, const DoubleDouble& place, double step) {
  const double first = g(place - DoubleDouble(step)).value(), next = g(place + DoubleDouble(step)).value();
  if (!(first < 0 ? next > 0 : next < 0)) return false;
  double before = first, after = next;
  for (int k = 2; k <= looks_beside; ++k) {
    const double earlier = g(place - DoubleDouble(k * step)).value(),
                 later = g(place + DoubleDouble(k * step)).value();
    if (!(first < 0 ? earlier < before && later > after : earlier > before && later < after)) return false;
    before = earlier;
    after = later;
  }
  return true;
}

/// A zero of g(d), |d| <= reach.
template <class Function>
std::optional<DoubleDouble> zero_near(const Function& g, double reach, double accuracy) {
  DoubleDouble a = 1e-3 * reach, b = 0.0, at_a = g(a);
  for (int i = 0; i < most_secants; ++i) {
    const DoubleDouble at_b = g(b);
    const DoubleDouble rise = at_b - at_a;
    const DoubleDouble step = rise.high == 0 ? DoubleDouble(0) : at_b * (b - a) / rise;
    if (!(std::abs(step.high) <= reach)) return std::nullopt;
    a = b;
    at_a = at_b;
    b = b - step;
    if (std::abs(b.high) > reach) return std::nullopt;
    if (std::abs(step.high) <= accuracy)
      return is_crossed(g, b, clearly_beside * accuracy) ? std::optional(b) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

ExtendedFunction::ExtendedFunction(const CompiledFunction& function, std::span<const DoubleDouble> parameters)
    : outputs_(function.outputs()), evaluator_(function, balls(parameters)) {}

std::vector<DoubleDouble> ExtendedFunction::operator()(const DoubleDouble& t,
                                                       std::span<const DoubleDouble> y) {
  std::vector<Ball> values(outputs_);
  evaluator_.set_time(Ball(t, 0));
  evaluator_(balls(y), values);
  std::vector<DoubleDouble> result;
  for (const Ball& value : values) result.push_back(value.middle);
  return result;
}

ExtendedPieces::ExtendedPieces(const ExtendedMotionRequest& request) : piece_(request), grid_(request.grid) {
  run_.bounded = true;
}

bool ExtendedPieces::go_to(const ExtendedSystem& system, const DoubleDouble& t) {
  piece_.grid.clear();
  for (std::size_t i = run_.rows; i < grid_.size() && !is_before(t, grid_[i]); ++i)
    piece_.grid.push_back(grid_[i]);
  piece_.grid.push_back(t);
  if (!go_on(system)) return false;
  drop_last_row();
  return true;
}

void ExtendedPieces::drop_last_row() {
  run_.rows -= 1;
  run_.states.resize(run_.rows * piece_.y_start.size());
  run_.passed.resize(run_.states.size());
  run_.apart.resize(std::min(run_.apart.size(), run_.states.size()));
}

bool ExtendedPieces::finish(const ExtendedSystem& system) {
  piece_.grid.assign(grid_.begin() + static_cast<std::ptrdiff_t>(run_.rows), grid_.end());
  return piece_.grid.empty() || go_on(system);
}

/// Through the grid of the piece. The next one begins at its end.
bool ExtendedPieces::go_on(const ExtendedSystem& system) {
  const ExtendedRun piece = extended_states(system, piece_);
  run_.evaluations += piece.evaluations;
  piece_.limits.max_evaluations -= std::min(piece_.limits.max_evaluations, piece.evaluations);
  run_.bounded = run_.bounded && piece.bounded;
  has_left_ = piece.ending == Ending::event;
  run_.ending = piece.ending;
  if (piece.rows < piece_.grid.size() && !has_left_) return false;
  run_.rows += piece.rows;
  run_.states.insert(run_.states.end(), piece.states.begin(), piece.states.end());
  run_.apart.insert(run_.apart.end(), piece.apart.begin(), piece.apart.end());
  pass_on(piece.passed);
  piece_.t_start = piece.t;
  piece_.y_start = piece.y;
  piece_.apart = piece.apart_at_end;
  return !has_left_;
}

/// What earlier pieces have passed counts in later ones.
void ExtendedPieces::pass_on(std::vector<double> passed) {
  const std::size_t n = piece_.y_start.size();
  largest_.resize(n);
  for (std::size_t i = 0; i < passed.size(); ++i) {
    passed[i] = std::max(passed[i], largest_[i % n]);
    if (i + n >= passed.size()) largest_[i % n] = passed[i];
  }
  run_.passed.insert(run_.passed.end(), passed.begin(), passed.end());
}

bool ExtendedPieces::jump_at_zero(const ExtendedSystem& system, const Function& g, double duration) {
  const auto d = zero_beside(system, g, duration);
  if (!d || has_row_within(known_.high, 2 * std::abs(d->high))) return false;
  move(*d);
  piece_.apart.clear();  // what the jump makes of it is not known
  return true;
}

bool ExtendedPieces::turn_at_zero(const ExtendedSystem& system, const Function& g, double duration) {
  const auto d = zero_beside(system, g, duration);
  if (!d) return false;
  const DoubleDouble zero = known_ + *d;
  while (run_.rows > 0 && is_before(zero, grid_[run_.rows - 1])) drop_last_row();
  for (; run_.rows < grid_.size() && !is_before(zero, grid_[run_.rows]); ++run_.rows) {
    move(grid_[run_.rows] - known_);
    run_.states.insert(run_.states.end(), piece_.y_start.begin(), piece_.y_start.end());
    for (const double e : piece_.apart) run_.apart.push_back(std::abs(e));
    run_.passed.insert(run_.passed.end(), largest_.begin(), largest_.end());
  }
  move(*d);
  return true;
}

/// How much later than the place that is known.
std::optional<DoubleDouble> ExtendedPieces::zero_beside(const ExtendedSystem& system, const Function& g,
                                                        double duration) {
  known_ = piece_.t_start;
  unit_ = system.unit_of_time;
  const std::size_t n = piece_.y_start.size();
  beside_.resize(n * (order_beside + 1));
  const auto t = multiplied(known_, 1 / unit_);
  const auto y = with_velocities_multiplied(std::span<const DoubleDouble>(piece_.y_start), n, unit_);
  if (system.expansion(t, y, order_beside, beside_) != Evaluation::ok) return std::nullopt;
  const auto g_beside = [&](const DoubleDouble& d) {
    move(d);
    return g(piece_.t_start, piece_.y_start);
  };
  const double reach = farthest_part * duration;
  return zero_near(g_beside, reach, as_near_as_can_be * (reach + std::abs(known_.high)));
}

void ExtendedPieces::move(const DoubleDouble& d) {
  piece_.t_start = known_ + d;
  const DoubleDouble s = multiplied(d, 1 / unit_);
  for (std::size_t i = 0; i < piece_.y_start.size(); ++i) {
    piece_.y_start[i] = 0.0;
    for (std::size_t k = order_beside + 1; k-- > 0;)
      piece_.y_start[i] = piece_.y_start[i] * s + beside_[i * (order_beside + 1) + k];
  }
  multiply_velocities(std::span(piece_.y_start), piece_.y_start.size(), 1 / unit_);
}

bool ExtendedPieces::has_row_within(double t, double reach) const {
  return std::ranges::any_of(grid_, [&](const DoubleDouble& row) {
    return row.high != t && std::abs((row - DoubleDouble(t)).high) <= reach;
  });
}

}  // namespace qdot
