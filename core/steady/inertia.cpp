#include "core/steady/inertia.hpp"

namespace qdot {

const char* const two_signs =
    "The kinetic energy has two signs here, so that the potential does not decide, and eigenvalues of the "
    "linearized equations are zero or imaginary to within rounding: what terms beyond them do is not looked at.";

Inertia inertia_of(std::vector<Interval> matrix, std::size_t n) {
  Inertia result;
  std::vector<std::size_t> left(n);
  for (std::size_t i = 0; i < n; ++i) left[i] = i;
  const auto entry = [&](std::size_t i, std::size_t j) -> Interval& { return matrix[i * n + j]; };
  while (!left.empty()) {
    // The pivot farthest from zero beside its own uncertainty: the units of the coordinates do not matter.
    const auto certainty = [&](std::size_t i) {
      return entry(i, i).least_magnitude() / entry(i, i).magnitude();
    };
    auto best = left.begin();
    for (auto i = left.begin(); i != left.end(); ++i) {
      if (certainty(*i) > certainty(*best) || !(certainty(*best) >= 0)) best = i;
    }
    const std::size_t p = *best;
    if (!(entry(p, p).least_magnitude() > 0)) break;
    left.erase(best);
    ++(entry(p, p).lower > 0 ? result.positive : result.negative);
    for (const std::size_t i : left) {
      for (const std::size_t j : left) {
        if (is_zero(entry(i, p)) || is_zero(entry(p, j))) continue;
        entry(i, j) = entry(i, j) -
                      (i == j ? square(entry(i, p)) / entry(p, p) : entry(i, p) * entry(p, j) / entry(p, p));
      }
    }
  }
  // Nothing certain on the diagonal: an entry beside it that is not zero means one of each sign.
  while (left.size() >= 2) {
    bool found = false;
    for (std::size_t a = 0; a < left.size() && !found; ++a) {
      for (std::size_t b = a + 1; b < left.size() && !found; ++b) {
        const Interval off = square(entry(left[a], left[b]));
        const Interval diagonal = entry(left[a], left[a]) * entry(left[b], left[b]);
        if (!(off.lower > diagonal.upper)) continue;
        ++result.positive;
        ++result.negative;
        result.undecided += left.size() - 2;
        left.clear();
        found = true;
      }
    }
    if (!found) break;
  }
  result.undecided += left.size();
  return result;
}

}  // namespace qdot
