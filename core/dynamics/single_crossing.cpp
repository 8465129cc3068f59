#include "core/dynamics/single_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/compile/tape_evaluator.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/taylor_enclosure.hpp"

namespace qdot {
namespace {

/// Of time: its values and slopes in the box; of how they change nothing is said.
Curvature along(const Interval& values, const Interval& slopes) {
  Curvature x = Curvature::constant(values);
  x.at[1] = x.over[1] = slopes;
  x.at[2] = x.over[2] = Interval::whole();
  x.terms = x.at.size();
  return x;
}

bool has_sign(const Interval& x) { return x.lower > 0 || x.upper < 0; }
bool has_same_sign(const Interval& a, const Interval& b) {
  return has_sign(a) && has_sign(b) && (a.lower > 0) == (b.lower > 0);
}

class SingleCrossing {
 public:
  SingleCrossing(std::shared_ptr<const CompiledFunction> function, std::span<const double> parameters)
      : function_(std::move(function)) {
    for (const double p : parameters) {
      const Interval nearest(std::nextafter(p, -infinity), std::nextafter(p, infinity));
      parameters_.push_back(Curvature::constant(nearest));
    }
  }

  bool holds(const MotionBox& box) const {
    TapeEvaluator<Curvature> along_motion(*function_, parameters_);
    const Curvature g = value(along_motion, box);
    const std::vector<Kink> kinks = kinks_in(along_motion);
    if (kinks.empty()) return has_sign(g.over[1]);
    if (kinks.size() > 1 || !has_sign(kinks[0].slope)) return false;
    const Curvature above = on_side(kinks[0], 1, box), below = on_side(kinks[0], -1, box);
    if (has_sign(above.over[0]) && has_sign(below.over[0])) return true;
    return !kinks[0].is_jump && has_same_sign(above.over[1], below.over[1]);
  }

 private:
  struct Kink {
    Slot out;
    Interval slope;  ///< of its argument
    bool is_jump;
  };

  static Curvature value(TapeEvaluator<Curvature>& function, const MotionBox& box) {
    std::vector<Curvature> y;
    for (std::size_t k = 0; k < box.y.size(); ++k) y.push_back(along(box.y[k], box.rates[k]));
    function.set_time(along(box.t, 1));
    Curvature g = Curvature::constant(0);
    function(y, {&g, 1});
    if (g.terms < 2) g.over[1] = 0;
    return g;
  }

  std::vector<Kink> kinks_in(const TapeEvaluator<Curvature>& function) const {
    std::vector<Kink> kinks;
    for (const Instruction& i : function_->instructions()) {
      const bool is_jump = i.function == Function::sign;
      if (i.operation != Operation::call || !(is_jump || i.function == Function::abs)) continue;
      const Curvature& u = function.slots()[function_->operands()[i.first]];
      if (u.over[0].contains(0)) kinks.push_back({i.out, u.terms > 1 ? u.over[1] : Interval(0), is_jump});
    }
    return kinks;
  }

  Curvature on_side(const Kink& kink, int side, const MotionBox& box) const {
    TapeEvaluator<Curvature> there(*function_, parameters_);
    there.take_side(kink.out, side);
    return value(there, box);
  }

  std::shared_ptr<const CompiledFunction> function_;
  std::vector<Curvature> parameters_;
};

}  // namespace

std::function<bool(const MotionBox& box)> single_crossing_of(std::shared_ptr<const CompiledFunction> function,
                                                             std::span<const double> parameters) {
  const auto is_solve = [](const Instruction& i) { return i.operation == Operation::solve; };
  if (std::ranges::any_of(function->instructions(), is_solve)) return nullptr;
  return [crossing = SingleCrossing(std::move(function), parameters)](const MotionBox& box) {
    return crossing.holds(box);
  };
}

}  // namespace qdot
