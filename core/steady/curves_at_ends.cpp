#include "core/steady/curves_at_ends.hpp"

#include <algorithm>
#include <numeric>

namespace qdot {
namespace {

/// Takes away what lies outermost on either side, each time of those that are left.
class Outermost {
 public:
  explicit Outermost(std::span<const double> x) : order_(x.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_sort(order_, {}, [&](std::size_t i) { return x[i]; });
  }
  void move_to(std::vector<std::size_t>& taken, bool is_upper) {
    if (order_.empty()) return;
    const auto place = is_upper ? order_.end() - 1 : order_.begin();
    taken.push_back(*place);
    order_.erase(place);
  }

 private:
  std::vector<std::size_t> order_;
};

}  // namespace

CurvesAtEnds curves_at_ends(std::span<const EndCrossing> crossings, double low, double high,
                            std::span<const double> before, std::span<const double> after) {
  CurvesAtEnds result;
  Outermost left(before), right(after);
  for (const EndCrossing& crossing : crossings) {
    if (crossing.p.upper < low || crossing.p.lower > high) continue;
    if (crossing.side == 0) return {};
    if (crossing.side < 0) left.move_to(result.gone, crossing.end > 0);
    if (crossing.side > 0) right.move_to(result.come, crossing.end > 0);
  }
  return result;
}

}  // namespace qdot
