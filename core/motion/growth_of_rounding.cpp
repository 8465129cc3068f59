#include "core/motion/growth_of_rounding.hpp"

#include <algorithm>
#include <cmath>

#include "core/compile/taylor/expansion.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

/// Of steps that are made for 22: what is cut off is 1e-3 of the last terms, and nearly alike in both series.
constexpr unsigned low_order = 8;

/// y + e, and not y itself, where nothing would be rounded otherwise.
double beside(double y, double e) {
  const double sum = y + e;
  return sum == y && e != 0 ? std::nextafter(y, e < 0 ? -infinity : infinity) : sum;
}

class Following {
 public:
  Following(const CompiledFunction& accelerations, const Neighbours& neighbours)
      : neighbours_(neighbours),
        e_(neighbours.moved_by),
        largest_(e_.size()),
        beside_(e_.size()),
        one_(accelerations, neighbours.parameters),
        other_(accelerations, neighbours.moved_parameters) {
    note();
  }

  std::vector<double> follow() {
    std::span<const double> y = neighbours_.y_start;
    double t = neighbours_.t_start;
    for (std::size_t k = 0; k < neighbours_.steps.t.size(); ++k) {
      if (!step(t, y, neighbours_.steps.t[k] - t)) break;
      note();
      t = neighbours_.steps.t[k];
      y = std::span(neighbours_.steps.y).subspan(k * e_.size(), e_.size());
    }
    return std::move(largest_);
  }

 private:
  void note() {
    for (std::size_t i = 0; i < e_.size(); ++i) largest_[i] = std::max(largest_[i], std::abs(e_[i]));
  }

  bool step(double t, std::span<const double> y, double h) {
    for (std::size_t i = 0; i < e_.size(); ++i) beside_[i] = beside(y[i], e_[i]);
    if (one_.expand(t, y, low_order, c_) != Evaluation::ok) return false;
    if (other_.expand(t, beside_, low_order, c_beside_) != Evaluation::ok) return false;
    for (std::size_t i = 0; i < e_.size(); ++i) {
      const std::size_t row = i * (low_order + 1);
      double apart = 0;
      for (std::size_t k = low_order; k > 0; --k) apart = (apart + (c_beside_[row + k] - c_[row + k])) * h;
      e_[i] += apart;
    }
    return std::ranges::all_of(e_, [](double e) { return std::isfinite(e); });
  }

  const Neighbours& neighbours_;
  std::vector<double> e_, largest_, beside_;
  std::vector<double> c_ = std::vector<double>(e_.size() * (low_order + 1)), c_beside_ = c_;
  TaylorExpansion one_, other_;
};

}  // namespace

std::vector<double> growth_of_rounding(const CompiledFunction& accelerations, const Neighbours& neighbours) {
  return Following(accelerations, neighbours).follow();
}

}  // namespace qdot
