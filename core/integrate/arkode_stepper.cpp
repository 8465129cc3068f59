// The explicit Runge-Kutta pair of prince_dormand.hpp, stepped by ARKODE's ARKStep with its default
// controller. Source: D. R. Reynolds et al., ARKODE, ACM TOMS 49 (2023) 19; User Documentation for
// ARKODE 5.4.1, "ARKStep".
//
// Three things are done differently from what the library offers, each for a measured reason:
// - ARKStep, not ERKStep, which in this version reuses the last stage as f(t, y)
//   and so loses up to five orders.
// - Dense output by RungeKuttaFan: the library's Hermite polynomials have degree 5 at most.
// - A stage at which f has no value ends an explicit run of the library's;
//   here the step is tried again from its beginning, shorter.

#include <arkode/arkode_arkstep.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "core/integrate/prince_dormand.hpp"
#include "core/integrate/sundials_stepper.hpp"
#include "core/integrate/sundials_steppers.hpp"

namespace qdot {
namespace {

struct ArkodeDeleter {
  void operator()(void* memory) const { ARKStepFree(&memory); }
};

struct TableDeleter {
  void operator()(ARKodeButcherTable table) const { ARKodeButcherTable_Free(table); }
};

constexpr double shrink = 0.25;  // of a step whose stages left the domain of f

void set_prince_dormand(void* memory) {
  auto c = PrinceDormand::c;
  auto a = PrinceDormand::a;
  auto b = PrinceDormand::b;
  auto d = PrinceDormand::d;
  const std::unique_ptr<ARKodeButcherTableMem, TableDeleter> table(created(
      ARKodeButcherTable_Create(PrinceDormand::stages, PrinceDormand::order, PrinceDormand::embedded_order,
                                c.data(), a.front().data(), b.data(), d.data())));
  require_success(
      ARKStepSetTables(memory, PrinceDormand::order, PrinceDormand::embedded_order, nullptr, table.get()));
}

class ArkodeStepper final : public SundialsStepper {
 public:
  ArkodeStepper(const RightHandSide& system, const RunRequest& request)
      : SundialsStepper(system, request, PrinceDormand::embedded_order),
        slope_before_(request.y_start.size()),
        slope_after_(request.y_start.size()),
        fan_(evaluator_, request.y_start.size()),
        memory_(created(ARKStepCreate(derivative, nullptr, t_, state_.get(), context_.get()))) {
    void* memory = memory_.get();
    require_success(ARKStepSetErrHandlerFn(memory, say_nothing, nullptr));
    require_success(ARKStepSetUserData(memory, &evaluator_));
    require_success(ARKStepSStolerances(memory, request.tolerances.rtol, request.tolerances.atol));
    require_success(ARKStepSetStopTime(memory, request.t_end));
    require_success(ARKStepSetMaxErrTestFails(memory, most_attempts));
    require_success(ARKStepSetInterpolantDegree(memory, 1));  // unused, and so the cheapest
    set_prince_dormand(memory);
  }

  std::optional<Ending> interpolate(double t, std::span<double> y_out) override {
    if (copy_end(t, y_out)) return std::nullopt;
    const Answer answer = fan_.advance(t - t_previous_, y_out);
    evaluator_.rethrow();
    return answer == answer_ok ? std::nullopt : evaluator_.trouble();
  }

  // Cubic Hermite interpolation between the ends, one evaluation a step instead of a fan's for every place.
  std::optional<Ending> sketch(double t, std::span<double> y_out) override {
    if (const auto failed = take_slopes()) return failed;
    const double h = t_ - t_previous_;
    const double x = (t - t_previous_) / h;
    const std::span<const double> y0 = elements(y_previous_.get());
    const std::span<const double> y1 = y();
    for (std::size_t i = 0; i < y_out.size(); ++i) {
      const double rise = y1[i] - y0[i];
      const double bend = (1 - 2 * x) * rise + h * ((x - 1) * slope_before_[i] + x * slope_after_[i]);
      y_out[i] = (1 - x) * y0[i] + x * y1[i] + x * (x - 1) * bend;
    }
    return std::nullopt;
  }

 private:
  int set_first_step(double h) override { return ARKStepSetInitStep(memory_.get(), h); }

  int advance() override {
    fan_.set_base(t_, y());
    int flag{};
    for (int i = 0; i < most_attempts; ++i) {
      flag = ARKStepEvolve(memory_.get(), request_.t_end, state_.get(), &t_, ARK_ONE_STEP);
      if (flag != ARK_UNREC_RHSFUNC_ERR) break;
      if (!start_over()) break;
    }
    return flag;
  }

  // f at both ends of the last step; the end of one step is the beginning of the next.
  std::optional<Ending> take_slopes() {
    if (slopes_until_ == t_) return std::nullopt;
    slope_before_.swap(slope_after_);
    const bool follows = slopes_until_ == t_previous_;
    if (!follows &&
        evaluator_.derivative(t_previous_, elements(y_previous_.get()), slope_before_) != answer_ok) {
      return evaluator_.trouble();
    }
    slopes_until_ = t_;
    return evaluator_.derivative(t_, y(), slope_after_) == answer_ok ? std::nullopt : evaluator_.trouble();
  }

  // Back to (t_n, y_n) with a shorter step. A reset forgets the stop time.
  bool start_over() {
    double h{};
    require_success(ARKStepGetCurrentStep(memory_.get(), &h));
    if (!(h * shrink > 0)) return false;
    require_success(ARKStepReset(memory_.get(), t_previous_, y_previous_.get()));
    require_success(ARKStepSetInitStep(memory_.get(), h * shrink));
    require_success(ARKStepSetStopTime(memory_.get(), request_.t_end));
    return true;
  }

  std::vector<double> slope_before_, slope_after_;
  double slopes_until_{std::numeric_limits<double>::quiet_NaN()};
  RungeKuttaFan fan_;
  std::unique_ptr<void, ArkodeDeleter> memory_;  // last: it refers to all of the above
};

}  // namespace

std::unique_ptr<Stepper> make_erk_stepper(const RightHandSide& system, const RunRequest& request) {
  return std::make_unique<ArkodeStepper>(system, request);
}

}  // namespace qdot
