#include "core/integrate/separation.hpp"

#include <algorithm>
#include <cmath>

#include "core/integrate/series_rise.hpp"
#include "core/integrate/step_polynomial.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/rough_powers.hpp"
#include "core/numerics/whole_power.hpp"

namespace qdot {
namespace {

constexpr double lost = 2;                             ///< times what a component has reached
constexpr double large_part = 1.0 / 16;                ///< of it
constexpr double smallest_part = 0x1p-12, some = 0.5;  ///< of a step
constexpr double shortest_where_lost = 0x1p-5;
constexpr int most_lost_steps = 16;  ///< one after the other, in which shorter parts are tried all the same
constexpr double at_begin = 0.25;    ///< of what acts all through a step
constexpr double much_growth = 2, most_late = 0.75, log_of_2 = 0.7;
constexpr double enlarged = 0x1p-30;
constexpr double most_of_enlarging = 0x1p900;  ///< of what is less than a normal double, too
constexpr double most_of_all = 1e300;          ///< instead of an error without a bound

/// y - e, and not y itself, where nothing would be rounded otherwise.
double beside(double y, double e) {
  const double difference = y - e;
  return difference == y && e != 0 ? std::nextafter(y, e < 0 ? infinity : -infinity) : difference;
}

}  // namespace

Separation::Separation(const RightHandSide& original, std::vector<double> moved_by, Scale scale)
    : original_(original),
      scale_(scale),
      shown_(original),
      order_(least_order),
      e_(std::move(moved_by)),
      largest_(e_.size()),
      y_(e_.size()),
      size_(e_.size()),
      slow_(e_.size()),
      added_(e_.size()),
      most_(e_.size()),
      before_(e_.size()),
      added_before_(e_.size()),
      beside_(e_.size()),
      rise_(e_.size()) {
  for (std::size_t i = 0; i < e_.size(); ++i) largest_[i] = std::abs(e_[i]);
}

Separation::Wanted Separation::look_ahead(const MotionPiece& step) {
  begin(step);
  place_beside(step.t);
  return {beside_, e_, std::min(order_, step.order)};
}

void Separation::begin(const MotionPiece& step) {
  for (std::size_t i = 0; i < e_.size(); ++i) y_[i] = step.rows[i * (step.order + 1)];
  project(step.t);
  has_begun_ = true;
  is_known_ = false;
}

void Separation::follow(const MotionPiece& step, const StepTerms& terms, const Errors& made) {
  for (std::size_t i = 0; i < e_.size(); ++i) size_[i] = std::max(size_[i], terms.largest()[i]);
  if (is_given_up_) return stay_lost();
  if (!has_begun_) begin(step);
  has_begun_ = false;
  const std::size_t n = e_.size() / 2;
  for (std::size_t i = 0; i < n; ++i) {
    added_[i] += step.h * added_[n + i];
    slow_[n + i] = size_[i] / step.h;
  }
  lost_steps_ = is_lost() ? lost_steps_ + 1 : 0;
  made_ = made;
  acting_left_ = 1;
  release_what_is_pushed();
  if (!made.hidden.empty()) {
    add(made.hidden, made.sides);
    project(step.t);
  }
  for (std::size_t i = 0; i < e_.size(); ++i) largest_[i] = std::abs(e_[i]);
  shortest_part_ = 1;
  advance(step, terms, {});
}

/// Coordinates and their velocities whose steps alone make errors about as large as they are.
void Separation::release_what_is_pushed() {
  const std::size_t n = e_.size() / 2;
  const auto is_pushed = [&](std::size_t i) {
    const double of_series = made_.of_series.empty() ? 0 : made_.of_series[i];
    const double hidden = made_.hidden.empty() ? 0 : made_.hidden[i];
    const double acting = made_.acting.empty() ? 0 : made_.acting[i];
    return of_series + hidden + acting > large_part * size_[i];
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (is_pushed(i) || is_pushed(n + i)) most_[i] = most_[n + i] = most_of_all;
  }
}

/// What a whole step has added has hardly any time left to grow within it. Of a part of a step, all may have
/// been added where the part begins.
void Separation::advance(const MotionPiece& piece, const StepTerms& terms, const Part& part) {
  const bool is_whole = part.from == 0 && part.to == 1;
  std::ranges::copy(e_, before_.begin());
  std::ranges::copy(added_, added_before_.begin());
  if (is_whole) {
    take_some(piece.order);
  } else {
    for (std::size_t i = 0; i < e_.size(); ++i) y_[i] = piece.rows[i * (piece.order + 1)];
    project(piece.t);
    is_known_ = false;
    add_part(piece.order, part);
  }
  bool is_told = take_rise(piece, terms);
  if (is_whole && !made_.sizes.empty()) note_growth(piece.order);
  if (is_whole && is_told && part_of_acting() > large_part) is_told = begin_with_acting(piece, terms);
  const double length = part.to - part.from;
  is_given_up_ = is_given_up_ || (!is_told && length <= shortest_where_lost && lost_steps_ > most_lost_steps);
  if (is_given_up_) return stay_lost();
  if (length > (is_told ? made_.longest_part : smallest_part)) {
    e_ = before_;
    added_ = added_before_;
    return advance_by_halves(piece, part);
  }
  shortest_part_ = std::min(shortest_part_, length);
  for (std::size_t i = 0; i < e_.size(); i += 2)
    move_to(i, pair_at(&e_[i]) + pair_at(&rise_[i]) / PairOfDoubles{factor_, factor_});
  if (is_whole) add_part(piece.order, part);
}

/// Of e, by rise_.
double Separation::growth() const {
  double before = 0, after = 0;
  for (std::size_t i = 0; i < e_.size(); ++i) {
    if (!(size_[i] > 0)) continue;
    before += std::abs(e_[i]) / size_[i];
    after += std::abs(e_[i] + rise_[i] / factor_) / size_[i];
  }
  const double growth = after / before;
  return std::isfinite(growth) ? growth : 1;
}

/// What becomes of 1 that comes in a step as s^order does, while e grows in it as exp(a s):
/// 1 + a/(order + 1) + a^2/((order + 1)(order + 2)) + ... < 1/(1 - a/order).
void Separation::note_growth(unsigned order) {
  const double of_e = growth(), exponent = of_e > much_growth ? log_of_2 * rough_log2(of_e) : 0;
  late_growth_ = 1 / (1 - std::min(exponent / order, most_late));
}

/// Beside e.
double Separation::part_of_acting() const {
  double acting = 0, before = 0;
  for (std::size_t i = 0; i < made_.acting.size(); ++i) {
    if (!(size_[i] > 0)) continue;
    acting += made_.acting[i] / size_[i];
    before += std::abs(e_[i]) / size_[i];
  }
  return acting / before;
}

/// What a constant force makes of a velocity in a step in which that grows as exp(a s) is sinh(a)/a times as
/// much as without: about (cosh(a) + 3)/4, as if a quarter came at its beginning and the others at its end.
/// Doubles may show of this quarter how it grows, and not of an e that is far smaller.
bool Separation::begin_with_acting(const MotionPiece& step, const StepTerms& terms) {
  const std::vector<double> e = e_, added = added_, rise = rise_;
  const double factor = factor_;
  std::vector<double> sizes(made_.acting.begin(), made_.acting.end());
  for (double& size : sizes) size *= at_begin;
  add(sizes, made_.sides);
  is_known_ = false;
  const bool is_told = take_rise(step, terms);
  if (growth() > much_growth) {
    acting_left_ = 1 - at_begin;
    return is_told;
  }
  e_ = e;
  added_ = added;
  rise_ = rise;
  factor_ = factor;
  return true;
}

/// Some of what the step has made has all of it to grow in: where no more than that was there before it tells
/// whether series are long enough.
void Separation::take_some(unsigned order) {
  const double share = whole_power(some, order);
  for (std::size_t i = 0; i < made_.sizes.size(); ++i) {
    const double acting = made_.acting.empty() ? 0 : made_.acting[i];
    const double least = share * std::min(made_.sizes[i] + acting, most_of_all);
    if (std::abs(e_[i]) < least) e_[i] = std::copysign(least, made_.sides[i]);
  }
}

bool Separation::are_together() const {
  return std::ranges::all_of(e_, [](double e) { return e == 0; });
}

/// Where series are too short for all of it.
void Separation::advance_by_halves(const MotionPiece& piece, const Part& part) {
  const double half = piece.h / 2, middle = (part.from + part.to) / 2;
  std::vector<double> rows(piece.rows.begin(), piece.rows.end());
  StepTerms terms(e_.size());
  const auto go = [&](double t, const Part& half_of_it) {
    const MotionPiece first{t, half, rows, piece.order, {}, {}};
    terms.take(first);
    advance(first, terms, half_of_it);
  };
  go(piece.t, {part.from, middle});
  shift_rows(rows, piece.order, half);
  go(piece.t + half, {middle, part.to});
}

/// Of what the step has made.
void Separation::add_part(unsigned order, const Part& part) {
  if (made_.sizes.empty()) return;
  const bool is_whole = part.from == 0 && part.to == 1;
  if (is_whole && late_growth_ == 1 && made_.acting.empty()) return add(made_.sizes, made_.sides);
  const double share = is_whole ? late_growth_ : whole_power(part.to, order) - whole_power(part.from, order);
  const double of_acting = is_whole ? acting_left_ : part.to - part.from;
  part_.resize(made_.sizes.size());
  for (std::size_t i = 0; i < part_.size(); ++i) {
    part_[i] = made_.sizes[i] * share;
    if (!made_.acting.empty()) part_[i] += of_acting * made_.acting[i];
  }
  add(part_, made_.sides);
}

void Separation::add(std::span<const double> sizes, std::span<const double> sides) {
  for (std::size_t i = 0; i < sizes.size(); i += 2) {
    const PairOfDoubles given = pair_at(&sizes[i]), most{most_of_all, most_of_all};
    const PairOfDoubles size = most < given ? most : given;
    put_pair(&added_[i], pair_at(&added_[i]) + size);
    const PairOfDoubles aside{std::copysign(size[0], sides[i]), std::copysign(size[1], sides[i + 1])};
    move_to(i, pair_at(&e_[i]) + aside);
  }
}

/// Of two components side by side: there is an even number of them. Each stays where it is while `e` is no
/// number.
void Separation::move_to(std::size_t i, PairOfDoubles e) {
  const PairOfDoubles reached = larger_or(pair_at(&slow_[i]), pair_at(&size_[i]));
  const PairOfDoubles size = larger_or(pair_at(&added_[i]), reached);  // of what stands still
  const PairOfDoubles most = larger_or(pair_at(&most_[i]), lost * size), before = pair_at(&e_[i]);
  const PairOfDoubles within = e < -most ? -most : (most < e ? most : e);
  const PairOfDoubles now = magnitudes(e) < infinity ? within : before;
  put_pair(&e_[i], now);
  put_pair(&largest_[i], larger_or(magnitudes(now), pair_at(&largest_[i])));
}

/// Motions that obey constraints are apart within them.
void Separation::project(double t) {
  if (!original_.project) return;
  for (std::size_t i = 0; i < e_.size(); ++i) beside_[i] = y_[i] - e_[i];
  if (!original_.project(t, beside_)) return;
  for (std::size_t i = 0; i < e_.size(); ++i) e_[i] = y_[i] - beside_[i];
}

void Separation::place_beside(double t) {
  if (scale_ == Scale::as_it_is) {
    for (std::size_t i = 0; i < e_.size(); ++i) beside_[i] = beside(y_[i], e_[i]);
    return note_lost();
  }
  factor_ = enlarging(0);
  if (scale_ == Scale::by_largest) factor_ = shown_.find(t, y_, e_, factor_, enlarging(1));
  for (std::size_t i = 0; i < e_.size(); ++i) beside_[i] = y_[i] - factor_ * e_[i];
}

/// Where e is as large as the largest of all coordinates, or velocities, and steps alone have not made it so,
/// it is the other motion that tells how far they go. Of one that only rests it is not.
void Separation::note_lost() {
  const std::size_t n = e_.size() / 2;
  for (std::size_t begin = 0; begin < e_.size(); begin += n) {
    const double largest = largest_size(begin);
    for (std::size_t i = begin; i < begin + n; ++i) {
      if (is_lost(i, largest)) size_[i] = std::max(size_[i], std::abs(beside_[i]));
    }
  }
}

bool Separation::is_lost(std::size_t i, double largest) const {
  return std::abs(e_[i]) >= std::max(largest, lost * added_[i]);
}

/// Of the coordinates, or velocities, that begin there.
double Separation::largest_size(std::size_t begin) const {
  const double* const size = size_.data() + begin;
  double largest = size[0];
  for (std::size_t i = 1; i < size_.size() / 2; ++i) largest = largest < size[i] ? size[i] : largest;
  return largest;
}

bool Separation::is_lost() const {
  const std::size_t n = e_.size() / 2;
  for (std::size_t begin = 0; begin < e_.size(); begin += n) {
    const double largest = largest_size(begin);
    for (std::size_t i = begin; largest > 0 && i < begin + n; ++i) {
      if (is_lost(i, large_part * largest)) return true;
    }
  }
  return false;
}

/// All of it then, as far from the motion as either has been.
void Separation::stay_lost() {
  for (std::size_t i = 0; i < e_.size(); ++i) {
    e_[i] = std::copysign(std::max(std::abs(e_[i]), lost * size_[i]), e_[i]);
    largest_[i] = std::abs(e_[i]);
  }
}

/// With components of `least` size.
double Separation::enlarging(double least) const {
  const double part = part_of_size(least);
  return part > 0 && std::isfinite(part) ? std::clamp(enlarged / part, 1.0, most_of_enlarging) : 1;
}

/// The largest part that e is of what components have reached.
double Separation::part_of_size(double least) const {
  const std::size_t n = e_.size() / 2;
  double part = 0;
  for (std::size_t begin = 0; begin < e_.size(); begin += n) {
    const double largest = largest_size(begin);
    for (std::size_t i = 0; i < n; ++i) {
      const double size = std::max(scale_ == Scale::by_largest ? std::max(largest, least) : size_[begin + i],
                                   slow_[begin + i]);
      if (e_[begin + i] != 0) part = std::max(part, std::abs(e_[begin + i]) / size);
    }
  }
  return part;
}

/// By series of the order that does, as the step before tells, or else of the step's own. False where that
/// does not.
bool Separation::take_rise(const MotionPiece& step, const StepTerms& terms) {
  if (scale_ != Scale::as_it_is && are_together()) {  // series would differ by last digits alone
    std::ranges::fill(rise_, 0.0);
    return true;
  }
  const bool is_known = is_known_ && known_.e == e_;
  const unsigned order = is_known ? known_.order : std::min(order_, step.order);
  unsigned enough = is_known ? known_.enough : rise(step, terms, order);
  if (is_known) rise_.swap(known_.rise);
  if (enough > order && order < step.order) enough = rise(step, terms, step.order);
  order_ = enough > least_order ? enough + 1 : least_order;
  return enough <= step.order;
}

/// rise_: what the step adds to e, by series of an order. The order that does, from least_order on: two small
/// terms in a row show that the rest is. It is more than this one where there are none.
unsigned Separation::rise(const MotionPiece& step, const StepTerms& terms, unsigned order) {
  std::ranges::fill(rise_, 0.0);
  place_beside(step.t);
  c_.resize(e_.size() * (order + 1));
  if (original_.expansion(step.t, beside_, order, c_) != Evaluation::ok) return order + 1;
  unsigned enough = std::min(least_order, order);
  for (std::size_t i = 0; i < e_.size(); ++i) {
    const double* own = step.rows.data() + i * (step.order + 1);
    double* c = c_.data() + i * (order + 1);
    const auto [sum, largest] = terms.subtract(own, order, factor_ * std::abs(e_[i]), c);
    rise_[i] = sum;
    enough = order_that_does(order, enough, largest, [c](unsigned k) { return c[k]; });
  }
  return enough;
}

}  // namespace qdot
