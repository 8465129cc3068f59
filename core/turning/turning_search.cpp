#include "core/turning/turning_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr int most_pieces = 5000;
constexpr int most_narrowings = 2200;  ///< a bisection through all exponents
constexpr double farthest = 1e150;

/// Four units in the last place: no piece is shorter.
double least_width(double x) { return 4 * (std::nextafter(std::abs(x), infinity) - std::abs(x)); }

bool excludes_zero(const Interval& x) { return x.lower > 0 || x.upper < 0; }

}  // namespace

TurningSearch::TurningSearch(EnergyBalance& energy, const Range& range, Direction direction)
    : energy_(energy),
      range_(range),
      sign_(static_cast<double>(direction)),
      p_(energy.x0()),
      remaining_(energy.remaining(energy.x0())) {}

double TurningSearch::limit() const {
  if (range_.period) return energy_.x0() + sign_ * *range_.period;
  return sign_ > 0 ? range_.domain.upper : range_.domain.lower;
}

/// Beyond the turning point of the harmonic motion with the same g and K at x0; only a guess.
double TurningSearch::first_width() {
  constexpr double usual = std::numbers::pi / 4;
  const double k = energy_.stiffness(energy_.x0()).middle();
  const double g = sign_ * energy_.potential_rate(energy_.x0()).middle();
  const double t = energy_.kinetic_energy().middle();
  if (!(k > 0)) return usual;
  const double amplitude = (std::sqrt(g * g + 2 * t * k) - g) / k;
  return amplitude > 0 && amplitude < usual ? 1.5 * amplitude : usual;
}

TurningSearch::Piece TurningSearch::piece(double width) {
  const double end = p_ + sign_ * width;
  Piece piece;
  piece.q = sign_ > 0 ? std::min(end, limit()) : std::max(end, limit());
  piece.x = hull(p_, piece.q);
  piece.remaining = energy_.remaining(piece.x);
  piece.slope = energy_.potential_rate(piece.x);
  piece.stiffness = energy_.stiffness(piece.x);
  if (excludes_zero(piece.stiffness)) {  // g rises or falls: its ends bound it
    piece.slope =
        intersection(piece.slope, hull(energy_.potential_rate(p_), energy_.potential_rate(piece.q)));
  }
  return piece;
}

bool TurningSearch::rises(const Interval& slope) const {
  return sign_ > 0 ? slope.upper <= 0 : slope.lower >= 0;
}
bool TurningSearch::rises_strictly(const Interval& slope) const {
  return sign_ > 0 ? slope.upper < 0 : slope.lower > 0;
}
bool TurningSearch::falls(const Interval& slope) const {
  return sign_ > 0 ? slope.lower > 0 : slope.upper < 0;
}

bool TurningSearch::is_positive(const Piece& piece) {
  if (piece.remaining.lower > 0) return true;
  if (energy_.starts_at_rest() && p_ == energy_.x0()) {  // F = -(x - x0) U[x0, x]
    const Interval start = energy_.start();
    const Interval slope =
        intersection(energy_.potential_slope(start, piece.x), energy_.potential_rate(hull(start, piece.x)));
    return rises_strictly(slope) || rises_strictly(slope_beside_start(piece));
  }
  const Interval slope = intersection(energy_.potential_slope(p_, piece.x), piece.slope);
  return (remaining_ - (piece.x - Interval(p_)) * slope).lower > 0;
}

/// U' by its rise from the force at the start, which may be far smaller than what rounds it elsewhere.
Interval TurningSearch::slope_beside_start(const Piece& piece) {
  const Interval away = intersection(Interval(sign_) * (piece.x - energy_.start()), Interval(0, infinity));
  return energy_.potential_rate_at_start() +
         Interval(sign_) * away * energy_.stiffness(hull(energy_.start(), piece.x));
}

/// F(x) by whichever arithmetic says more.
Interval TurningSearch::remaining_at(double x) {
  const Interval remaining = energy_.remaining(x);
  return remaining.contains(0.0) ? intersection(remaining, energy_.remaining_sharply(x)) : remaining;
}

MotionBound TurningSearch::run() {
  double width = first_width();
  for (int i = 0; i < most_pieces; ++i) {
    const Piece next = piece(width);
    const Verdict verdict = look(next);
    if (verdict == Verdict::bound) return bound_;
    if (verdict == Verdict::undecided) {
      width = std::abs(next.q - p_) / 2;
      if (width >= least_width(p_)) continue;
      return look_beyond_resolution();
    }
    p_ = next.q;
    remaining_ = remaining_at(p_);
    if (p_ == limit()) {
      return {range_.period ? MotionBound::Kind::full_turn : MotionBound::Kind::domain_end, p_};
    }
    if (!std::isfinite(limit()) && has_inertia_from_here() && is_free_from_here())
      return {MotionBound::Kind::unbounded, p_};
    if (std::abs(p_) > farthest) {
      if (is_free_from_here()) return {MotionBound::Kind::unbounded, p_};
      break;
    }
    width *= 2;
  }
  return {MotionBound::Kind::unresolved, p_};
}

/// Where nothing is known of the slope, as at a jump of U, two values still prove that F changes its sign,
/// but not over a pole: F has to have values all the way between them.
MotionBound TurningSearch::look_beyond_resolution() {
  constexpr int doublings = 24;
  double width = least_width(p_);
  for (int i = 0; i < doublings; ++i, width *= 2) {
    const Piece next = piece(width);
    if (!energy_.potential(next.x).is_finite()) {
      const bool is_pole = grows_towards(next);
      return {is_pole ? MotionBound::Kind::fall : MotionBound::Kind::no_value, around_what_is_singular(next)};
    }
    if (remaining_at(next.q).upper < 0) return {MotionBound::Kind::turning, next.x};
    if (const Interval inertia = energy_.inertia(next.x); !(inertia.lower > 0))
      return {inertia.is_finite() ? MotionBound::Kind::no_inertia : MotionBound::Kind::endless_inertia,
              around_what_has_no_inertia(next)};
    if (next.q == limit() && !range_.period) return {MotionBound::Kind::near_end, next.q};
  }
  return {MotionBound::Kind::unresolved, p_};
}

/// From p_ to where something is known of U again: next to 0 that may be a wide range, in which U overflows
/// on this side already.
Interval TurningSearch::around_what_is_singular(const Piece& from) {
  if (!energy_.potential(p_).is_finite() && !energy_.potential(0.0).is_finite()) return hull(p_, 0.0);
  for (double width = from.x.width(); width <= 4 * std::abs(p_); width *= 2) {
    const double end = p_ + sign_ * width;
    const Interval value = energy_.potential(end);
    if (value.lower > -infinity || value.upper < infinity) return hull(p_, end);
  }
  return from.x;
}

/// Next to 0 the inertia underflows, or overflows, on this side already.
Interval TurningSearch::around_what_has_no_inertia(const Piece& from) {
  constexpr double least = 1e-300, grown = 1e290;
  const Interval up_to_zero = hull(p_, 0.0);
  const Interval inertia = energy_.inertia(up_to_zero);
  const bool vanishes = inertia.contains(0.0) && inertia.upper < least;
  const bool overflows =
      sign_ * p_ < 0 && energy_.inertia(p_).lower / grown > energy_.inertia(energy_.x0()).upper;
  return vanishes || overflows ? up_to_zero : from.x;
}

/// Whether F rises towards the piece, in equal factors of the distance by ever more: so does the logarithm.
bool TurningSearch::grows_towards(const Piece& piece) {
  constexpr double equal = 0.9;
  const double reach = std::abs(energy_.x0() - p_), width = piece.x.width();
  const double half = std::sqrt(width / reach);
  const double quarter = std::sqrt(half);
  const auto at = [&](double distance) { return energy_.remaining(p_ - sign_ * distance); };
  const Interval far = at(reach * half), near = at(reach * half * quarter), nearest = remaining_;
  const double before = (near - far).upper;
  return before > 0 && (nearest - near).lower > equal * before;
}

TurningSearch::Verdict TurningSearch::look(Piece piece) {
  if (!(energy_.inertia(piece.x).lower > 0)) return Verdict::undecided;
  if (is_positive(piece)) return Verdict::nothing;
  if (piece.stiffness.upper < 0 && !rises(piece.slope) && !falls(piece.slope)) return look_at_crest(piece);
  if (rises(piece.slope)) return Verdict::nothing;
  if (falls(piece.slope) || piece.stiffness.lower > 0) return look_at_end(piece);
  return Verdict::undecided;
}

TurningSearch::Verdict TurningSearch::look_at_end(const Piece& piece) {
  const Interval end = remaining_at(piece.q);
  if (end.lower > 0) return Verdict::nothing;
  if (!(end.upper < 0)) return Verdict::undecided;
  bound_ = {MotionBound::Kind::turning, narrowed(p_, piece.q)};
  return Verdict::bound;
}

TurningSearch::Verdict TurningSearch::look_at_crest(const Piece& piece) {
  const Interval c = critical_point(piece.x);
  if (is_empty(c)) {  // F has no least value here after all: it falls or rises all along
    return rises(energy_.potential_rate(piece.x.middle())) ? Verdict::nothing : look_at_end(piece);
  }
  const double centre = c.middle();
  const Interval remaining = remaining_at_crest(c);
  const double blur = energy_.rounding_of_start();
  if (remaining.lower > blur) return Verdict::nothing;
  if (remaining.upper < -blur) {
    bound_ = {MotionBound::Kind::turning, narrowed(p_, centre)};
  } else {
    const Interval open = hull(remaining, Interval(-blur, blur));
    bound_ = {MotionBound::Kind::asymptote, touching_range(centre, piece.stiffness, open)};
  }
  return Verdict::bound;
}

/// Around a zero of g, F(x) = F(m) - (x - m) g is known far better than from the range of x alone.
Interval TurningSearch::remaining_at_crest(const Interval& c) {
  const double m = c.middle();
  const Interval change = (c - Interval(m)) * energy_.potential_rate(c);
  return intersection(energy_.remaining(c),
                      intersection(energy_.remaining(m), energy_.remaining_sharply(m)) - change);
}

Interval TurningSearch::rest() const { return sign_ > 0 ? Interval(p_, infinity) : Interval(-infinity, p_); }

bool TurningSearch::has_inertia_from_here() { return energy_.inertia(rest()).lower > 0; }

bool TurningSearch::is_free_from_here() {
  const Interval rest = this->rest();
  return energy_.remaining(rest).lower > 0 || rises(energy_.potential_rate(rest));
}

/// The one zero of F between two places, F(from) >= 0 > F(to):
/// interval Newton where g has a sign, else halves.
Interval TurningSearch::narrowed(double from, double to) {
  for (int i = 0; i < most_narrowings; ++i) {
    const Interval x = hull(from, to);
    const double m = x.middle();
    const Interval value = remaining_at(m);
    const Interval slope = energy_.potential_rate(x);
    if (excludes_zero(slope)) {
      const Interval next = intersection(Interval(m) + value / slope, x);  // F' = -g
      if (is_empty(next)) return x;
      if (next.width() < 0.9 * x.width()) {
        from = sign_ > 0 ? next.lower : next.upper;
        to = sign_ > 0 ? next.upper : next.lower;
        continue;
      }
    }
    if (m == from || m == to) return x;
    if (value.lower > 0) {
      from = m;
    } else if (value.upper < 0) {
      to = m;
    } else {
      return x;
    }
  }
  return hull(from, to);
}

/// The zero of g in x, where K has a sign; empty if there is none.
Interval TurningSearch::critical_point(Interval x) {
  while (true) {
    const double m = x.middle();
    const Interval step = energy_.potential_rate(m) / energy_.stiffness(x);
    const Interval next = intersection(Interval(m) - step, x);
    if (is_empty(next) || !(next.width() < 0.9 * x.width())) return next;
    x = next;
  }
}

/// Where 1/2 |K| (x - c)^2 + F(c) may vanish: all of what rounding leaves open.
Interval TurningSearch::touching_range(double centre, const Interval& stiffness, const Interval& remaining) {
  const auto range = [&](const Interval& k) {
    const double radius = std::sqrt(std::max(0.0, -2 * remaining.lower / -k.upper));
    return Interval(std::nextafter(centre - radius, -infinity), std::nextafter(centre + radius, infinity));
  };
  const Interval first = range(stiffness);
  const Interval near = energy_.stiffness(first);
  return near.upper < 0 ? range(near) : first;
}

}  // namespace qdot
