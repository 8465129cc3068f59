#include "core/integrate/approach.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace qdot {
namespace {

void widen(std::vector<double>& errors, const std::vector<double>& others) {
  for (std::size_t k = 0; k < errors.size() && k < others.size(); ++k)
    errors[k] = std::max(errors[k], others[k]);
}

Approach::Others span_of(const Approach& one) { return one.others.value_or(Approach::Others{one.t, one.t}); }

}  // namespace

void Approach::shift(double s) {
  for (std::size_t i = 0; i < rows.size(); i += order + 1) {
    for (unsigned k = 0; k < order; ++k) {
      for (unsigned j = order; j-- > k;) rows[i + j] += s * rows[i + j + 1];
    }
  }
}

std::vector<double> Approach::state_at(double s) const {
  std::vector<double> y(rows.size() / (order + 1));
  for (std::size_t i = 0; i < y.size(); ++i) {
    for (std::size_t k = order + 1; k-- > 0;) y[i] = y[i] * s + rows[i * (order + 1) + k];
  }
  return y;
}

void Approach::take_in(Approach other) {
  const Others own = span_of(*this), another = span_of(other);
  if (!(distance <= other.distance)) std::swap(*this, other);
  widen(apart, other.apart);
  widen(unseen, other.unseen);
  others = {std::min(own.from, another.from), std::max(own.to, another.to)};
}

void take_together(std::vector<Approach>& approaches) {
  std::vector<Approach> fewer;
  std::map<std::pair<std::size_t, bool>, std::size_t> alone;  // of `fewer`, by event
  for (Approach& approach : approaches) {
    const std::pair of_event(approach.event, approach.is_condition);
    const auto before = alone.find(of_event);
    if (approach.met || before == alone.end()) {
      if (!approach.met) alone.emplace(of_event, fewer.size());
      fewer.push_back(std::move(approach));
    } else {
      fewer[before->second].take_in(std::move(approach));
      alone.erase(before);
    }
  }
  approaches = std::move(fewer);
}

}  // namespace qdot
