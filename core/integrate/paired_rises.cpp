#include "core/integrate/paired_rises.hpp"

#include <algorithm>

#include "core/integrate/series_rise.hpp"

namespace qdot {

void PairedRises::find(const MotionPiece& step, const StepTerms& terms, Separation& asked,
                       Separation& rounded) {
  if (!originals_.both) return;
  const Separation::Wanted a = asked.look_ahead(step), b = rounded.look_ahead(step);
  const unsigned order = std::max(a.order, b.order);
  const std::size_t n = a.place.size();
  place_.resize(n);
  c_.resize(n * (order + 1));
  for (std::size_t i = 0; i < n; ++i) place_[i] = PairOfDoubles{a.place[i], b.place[i]};
  if (!originals_.both(step.t, place_, order, c_)) return;

  Separation::Known &of_a = asked.known(), &of_b = rounded.known();
  for (Separation::Known* const known : {&of_a, &of_b}) {
    known->e.resize(n);
    known->rise.resize(n);
    known->order = order;
    known->enough = std::min(least_order, order);
  }
  std::ranges::copy(a.apart, of_a.e.begin());
  std::ranges::copy(b.apart, of_b.e.begin());
  for (std::size_t i = 0; i < n; ++i) {
    const double* own = step.rows.data() + i * (step.order + 1);
    PairOfDoubles* c = c_.data() + i * (order + 1);
    const auto [sum, largest] =
        terms.subtract(own, order, magnitudes(PairOfDoubles{a.apart[i], b.apart[i]}), c);
    of_a.rise[i] = sum[0];
    of_b.rise[i] = sum[1];
    of_a.enough = order_that_does(order, of_a.enough, largest[0], [c](unsigned k) { return c[k][0]; });
    of_b.enough = order_that_does(order, of_b.enough, largest[1], [c](unsigned k) { return c[k][1]; });
  }
}

}  // namespace qdot
