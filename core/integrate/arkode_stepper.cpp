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

#include "core/integrate/evaluator.hpp"
#include "core/integrate/initial_step.hpp"
#include "core/integrate/prince_dormand.hpp"
#include "core/integrate/sundials_handles.hpp"
#include "core/integrate/sundials_steppers.hpp"

namespace qdot {
namespace {

struct ArkodeDeleter {
  void operator()(void* memory) const { ARKStepFree(&memory); }
};

struct TableDeleter {
  void operator()(ARKodeButcherTable table) const { ARKodeButcherTable_Free(table); }
};

constexpr int arkode_attempts = 30;  // at one step: a quarter each time, they reach the round-off of t
constexpr double shrink = 0.25;      // of a step whose stages left the domain of f

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

class ArkodeStepper final : public Stepper {
 public:
  ArkodeStepper(const RightHandSide& system, const RunRequest& request)
      : evaluator_(system, request.limits),
        request_(request),
        context_(make_context()),
        state_(make_vector(request.y_start, context_.get())),
        y_previous_(make_vector(request.y_start, context_.get())),
        t_previous_(request.t_start),
        t_(request.t_start),
        slope_before_(request.y_start.size()),
        slope_after_(request.y_start.size()),
        fan_(evaluator_, request.y_start.size()),
        memory_(created(ARKStepCreate(derivative, nullptr, t_, state_.get(), context_.get()))) {
    void* memory = memory_.get();
    require_success(ARKStepSetErrHandlerFn(memory, say_nothing, nullptr));
    require_success(ARKStepSetUserData(memory, &evaluator_));
    require_success(ARKStepSStolerances(memory, request.tolerances.rtol, request.tolerances.atol));
    require_success(ARKStepSetStopTime(memory, request.t_end));
    require_success(ARKStepSetMaxErrTestFails(memory, arkode_attempts));
    require_success(ARKStepSetInterpolantDegree(memory, 1));  // unused, and so the cheapest
    set_prince_dormand(memory);
  }

  std::optional<Ending> step() override {
    if (t_ != t_previous_) evaluator_.forget_trouble();
    if (const auto failed = choose_first_step()) return failed;
    std::ranges::copy(y(), elements(y_previous_.get()).begin());
    t_previous_ = t_;
    fan_.set_base(t_, y());
    const int flag = evolve();
    evaluator_.rethrow();
    if (flag < 0) return undo(ending_of(flag));
    ++steps_;
    return std::nullopt;
  }

  std::optional<Ending> interpolate(double t, std::span<double> y_out) override {
    if (t == t_ || t == t_previous_) {
      std::ranges::copy(elements(t == t_ ? state_.get() : y_previous_.get()), y_out.begin());
      return std::nullopt;
    }
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

  double t_previous() const override { return t_previous_; }
  double t() const override { return t_; }
  std::span<const double> y() const override { return elements(state_.get()); }
  std::optional<Ending> trouble() const override { return evaluator_.trouble(); }
  std::uint64_t steps() const override { return steps_; }
  std::uint64_t evaluations() const override { return evaluator_.evaluations(); }

 private:
  static int derivative(double t, N_Vector y, N_Vector f, void* evaluator) {
    return static_cast<Evaluator*>(evaluator)->derivative(t, elements(y), elements(f));
  }

  std::optional<Ending> choose_first_step() {
    if (steps_ > 0) return std::nullopt;
    const auto h =
        initial_step(evaluator_, t_, y(), request_.t_end, request_.tolerances, PrinceDormand::embedded_order);
    evaluator_.rethrow();
    if (!h) return evaluator_.trouble();
    require_success(ARKStepSetInitStep(memory_.get(), *h));
    return std::nullopt;
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

  int evolve() {
    int flag{};
    for (int i = 0; i < arkode_attempts; ++i) {
      flag = ARKStepEvolve(memory_.get(), request_.t_end, state_.get(), &t_, ARK_ONE_STEP);
      if (flag != ARK_UNREC_RHSFUNC_ERR) break;
      if (!start_over()) break;
    }
    return flag;
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

  std::optional<Ending> undo(Ending why) {
    t_ = t_previous_;
    std::ranges::copy(elements(y_previous_.get()), elements(state_.get()).begin());
    return why;
  }

  // As in CvodeStepper: the evaluator's reason first.
  Ending ending_of(int flag) const {
    if (flag == ARK_MEM_FAIL) throw std::bad_alloc();
    if (evaluator_.trouble()) return *evaluator_.trouble();
    return flag == ARK_TOO_MUCH_ACC ? Ending::tolerance : Ending::step_limit;
  }

  Evaluator evaluator_;
  const RunRequest& request_;
  ContextPointer context_;
  VectorPointer state_;
  VectorPointer y_previous_;
  double t_previous_;
  double t_;
  std::uint64_t steps_{};
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
