#include "core/integrate/separation.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr unsigned least_order = 8;
constexpr double negligible = 0.03;  ///< of the largest term: so the last ones show that these were enough
constexpr double lost = 2;           ///< times what a component has reached
constexpr double enlarged = 0x1p-30;
constexpr double most_of_all = 1e300;  ///< instead of an error without a bound

/// y - e, and not y itself, where nothing would be rounded otherwise.
double beside(double y, double e) {
  const double difference = y - e;
  return difference == y && e != 0 ? std::nextafter(y, e < 0 ? infinity : -infinity) : difference;
}

}  // namespace

Separation::Separation(const RightHandSide& original, std::vector<double> moved_by, Scale scale)
    : original_(original),
      scale_(scale),
      order_(least_order),
      e_(std::move(moved_by)),
      largest_(e_.size()),
      y_(e_.size()),
      size_(e_.size()),
      added_(e_.size()),
      beside_(e_.size()),
      rise_(e_.size()) {
  for (std::size_t i = 0; i < e_.size(); ++i) largest_[i] = std::abs(e_[i]);
}

void Separation::follow(const MotionPiece& step, const StepTerms& terms) {
  for (std::size_t i = 0; i < e_.size(); ++i) {
    y_[i] = step.rows[i * (step.order + 1)];
    size_[i] = std::max(size_[i], terms.largest()[i]);
  }
  const std::size_t n = e_.size() / 2;
  for (std::size_t i = 0; i < n; ++i) added_[i] += step.h * added_[n + i];
  project(step.t);
  for (std::size_t i = 0; i < e_.size(); ++i) largest_[i] = std::abs(e_[i]);
  const bool are_together = std::ranges::all_of(e_, [](double e) { return e == 0; });
  if (scale_ != Scale::as_it_is && are_together) return;  // series would differ by last digits alone
  place_beside();
  take_rise(step, terms);
  for (std::size_t i = 0; i < e_.size(); i += 2)
    move_to(i, pair_at(&e_[i]) + pair_at(&rise_[i]) / PairOfDoubles{factor_, factor_});
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
  const PairOfDoubles size = pair_at(&size_[i]), added = pair_at(&added_[i]), before = pair_at(&e_[i]);
  const PairOfDoubles most = lost * larger_or(added, size);  // what stands still has no size but that
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

void Separation::place_beside() {
  if (scale_ == Scale::as_it_is) {
    for (std::size_t i = 0; i < e_.size(); ++i) beside_[i] = beside(y_[i], e_[i]);
    return;
  }
  const double part = part_of_size();
  factor_ = part > 0 && std::isfinite(part) ? std::max(1.0, enlarged / part) : 1;
  for (std::size_t i = 0; i < e_.size(); ++i) beside_[i] = y_[i] - factor_ * e_[i];
}

/// The largest part that e is of what components have reached.
double Separation::part_of_size() const {
  const std::size_t n = e_.size() / 2;
  double part = 0;
  for (std::size_t begin = 0; begin < e_.size(); begin += n) {
    const auto sizes = std::span(size_).subspan(begin, n);
    const double largest = *std::ranges::max_element(sizes);
    for (std::size_t i = 0; i < n; ++i) {
      const double size = scale_ == Scale::by_largest ? largest : sizes[i];
      if (e_[begin + i] != 0) part = std::max(part, std::abs(e_[begin + i]) / size);
    }
  }
  return part;
}

/// By series of the order that does, as the step before tells, or else of the step's own.
void Separation::take_rise(const MotionPiece& step, const StepTerms& terms) {
  const unsigned order = std::min(order_, step.order);
  unsigned enough = rise(step, terms, order);
  if (enough > order && order < step.order) enough = rise(step, terms, step.order);
  order_ = enough > least_order ? enough + 1 : least_order;
}

/// rise_: what the step adds to e, by series of an order. The order that does, from least_order on: two small
/// terms in a row show that the rest is. It is more than this one where there are none.
unsigned Separation::rise(const MotionPiece& step, const StepTerms& terms, unsigned order) {
  std::ranges::fill(rise_, 0.0);
  c_.resize(e_.size() * (order + 1));
  if (original_.expansion(step.t, beside_, order, c_) != Evaluation::ok) return order + 1;
  unsigned enough = std::min(least_order, order);
  for (std::size_t i = 0; i < e_.size(); ++i) {
    const double* own = step.rows.data() + i * (step.order + 1);
    double* c = c_.data() + i * (order + 1);
    const auto [sum, largest] = terms.subtract(own, order, factor_ * std::abs(e_[i]), c);
    rise_[i] = sum;
    unsigned last = order;
    while (last + 2 > enough && std::abs(c[last]) <= negligible * largest) --last;
    enough = std::max(enough, last + 2);
  }
  return enough;
}

}  // namespace qdot
