#include "core/numerics/box.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/function.hpp"
#include "core/numerics/same_bits.hpp"

namespace qdot {
namespace {

constexpr double golden_cut = 0.4876;  ///< not a half: zeros like to lie at the middle of a region

bool touch(const Box& a, const Box& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double gap = a[i].width() + b[i].width();
    if (a[i].lower > b[i].upper + gap || b[i].lower > a[i].upper + gap) return false;
  }
  return true;
}

}  // namespace

Box middle(const Box& box) {
  Box c;
  for (const Interval& x : box) c.emplace_back(x.middle());
  return c;
}

bool is_inside(const Box& a, const Box& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(a[i].lower > b[i].lower && a[i].upper < b[i].upper)) return false;
  }
  return true;
}

bool contains(const Box& outer, const Box& box) {
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (!outer[i].contains(box[i])) return false;
  }
  return true;
}

bool is_bounded(const Box& box) { return std::ranges::all_of(box, &Interval::is_finite); }

bool overlap(const Box& a, const Box& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (is_empty(intersection(a[i], b[i]))) return false;
  }
  return true;
}

double BoxUnits::width(const Box& box) const {
  double widest = 0;
  for (std::size_t i = 0; i < box.size(); ++i) widest = std::max(widest, width(box, i));
  return widest;
}

double BoxUnits::width(const Box& box, std::size_t i) const {
  const double direct = box[i].width() / (scales_[i] + box[i].least_magnitude());
  if (direct < 1) return direct;
  return inverse_sinh(box[i].upper / scales_[i]) - inverse_sinh(box[i].lower / scales_[i]);
}

double BoxUnits::distance(const Box& box) const {
  double largest = 0;
  for (std::size_t i = 0; i < box.size(); ++i)
    largest = std::max(largest, inverse_sinh(box[i].least_magnitude() / scales_[i]));
  return largest;
}

Box BoxUnits::around(const Box& point, double reach) const {
  Box box;
  for (std::size_t i = 0; i < point.size(); ++i) {
    const double x = point[i].middle();
    const double width = reach * (scales_[i] + std::abs(x));
    box.emplace_back(x - width, x + width);
  }
  return box;
}

std::pair<Box, Box> BoxUnits::halves(const Box& box) const {
  std::size_t widest = 0;
  for (std::size_t i = 1; i < box.size(); ++i) {
    if (width(box, i) > width(box, widest)) widest = i;
  }
  std::pair<Box, Box> parts{box, box};
  parts.first[widest].upper = parts.second[widest].lower = cut(box[widest], scales_[widest]);
  return parts;
}

double BoxUnits::cut(const Interval& x, double scale) const {
  if (x.width() < 4 * (scale + x.least_magnitude())) return x.lower + golden_cut * x.width();
  const double a = inverse_sinh(x.lower / scale);
  const double b = inverse_sinh(x.upper / scale);
  return scale * evaluate(Function::sinh, a + golden_cut * (b - a));
}

std::vector<Box> joined_where_they_touch(std::span<const Box> boxes) {
  std::vector<Box> found;
  for (Box box : boxes) {
    for (;;) {
      const auto near = std::ranges::find_if(found, [&](const Box& other) { return touch(box, other); });
      if (near == found.end()) break;
      for (std::size_t i = 0; i < box.size(); ++i) box[i] = hull(box[i], (*near)[i]);
      found.erase(near);
    }
    found.push_back(std::move(box));
  }
  return found;
}

}  // namespace qdot
