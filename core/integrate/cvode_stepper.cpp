// Adams and BDF by CVODE, one internal step at a time. The dense output is the method's own Nordsieck
// polynomial and has its order. Source: A. C. Hindmarsh et al., SUNDIALS, ACM TOMS 31 (2005) 363-396; User
// Documentation for CVODE 6.4.1, sections "CVODE solver function",
// "Interpolated output function", "User-supplied functions".

#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <stdexcept>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/integrate/evaluator.hpp"
#include "core/integrate/initial_step.hpp"
#include "core/integrate/sundials_handles.hpp"
#include "core/integrate/sundials_steppers.hpp"

namespace qdot {
namespace {

struct CvodeDeleter {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

// Attempts at one step. CVODE's defaults (7 and 10) give up while the step could still shrink: near the edge
// of where f exists, or at a jump of f. A quarter each time, 30 of them reach the round-off of t.
constexpr int cvode_attempts = 30;

class CvodeStepper final : public Stepper {
 public:
  CvodeStepper(int family, const RightHandSide& system, const RunRequest& request)
      : evaluator_(system, request.limits),
        request_(request),
        context_(make_context()),
        state_(make_vector(request.y_start, context_.get())),
        output_(make_vector(request.y_start, context_.get())),
        y_previous_(request.y_start),
        t_previous_(request.t_start),
        t_(request.t_start),
        memory_(created(CVodeCreate(family, context_.get()))) {
    void* memory = memory_.get();
    require_success(CVodeSetErrHandlerFn(memory, say_nothing, nullptr));
    require_success(CVodeInit(memory, derivative, t_, state_.get()));
    require_success(CVodeSetUserData(memory, &evaluator_));
    require_success(CVodeSStolerances(memory, request.tolerances.rtol, request.tolerances.atol));
    require_success(CVodeSetStopTime(memory, request.t_end));
    require_success(CVodeSetMaxErrTestFails(memory, cvode_attempts));
    require_success(CVodeSetMaxConvFails(memory, cvode_attempts));
    family == CV_ADAMS ? correct_by_fixed_point() : correct_by_newton();
  }

  std::optional<Ending> step() override {
    if (t_ != t_previous_) evaluator_.forget_trouble();
    if (const auto failed = choose_first_step()) return failed;
    std::ranges::copy(y(), y_previous_.begin());
    t_previous_ = t_;
    const int flag = CVode(memory_.get(), request_.t_end, state_.get(), &t_, CV_ONE_STEP);
    evaluator_.rethrow();
    if (flag < 0) return undo(ending_of(flag));
    ++steps_;
    return std::nullopt;
  }

  std::optional<Ending> interpolate(double t, std::span<double> y_out) override {
    if (t == t_) {
      std::ranges::copy(y(), y_out.begin());
    } else if (t == t_previous_) {
      std::ranges::copy(y_previous_, y_out.begin());
    } else {
      require_success(CVodeGetDky(memory_.get(), t, 0, output_.get()));
      std::ranges::copy(elements(output_.get()), y_out.begin());
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

  static int jacobian(double t, N_Vector y, N_Vector, SUNMatrix matrix, void* evaluator, N_Vector, N_Vector,
                      N_Vector) {
    const auto n = static_cast<std::size_t>(SM_ROWS_D(matrix));
    const std::span<double> entries(SM_DATA_D(matrix), n * n);
    const Answer answer = static_cast<Evaluator*>(evaluator)->jacobian(t, elements(y), entries);
    // Ours are row-major, theirs column-major.
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j) std::swap(entries[i * n + j], entries[j * n + i]);
    return answer;
  }

  // Newton with the dense Jacobian saves Adams a third of the evaluations on our oscillators and costs as
  // much in all: the library's own work per step outweighs f.
  void correct_by_fixed_point() {
    fixed_point_.reset(created(SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get())));
    require_success(CVodeSetNonlinearSolver(memory_.get(), fixed_point_.get()));
  }

  // CVODE attaches its own Newton iteration; it lacks the linear algebra.
  void correct_by_newton() {
    const auto n = static_cast<sunindextype>(y_previous_.size());
    matrix_.reset(created(SUNDenseMatrix(n, n, context_.get())));
    linear_solver_.reset(created(SUNLinSol_Dense(state_.get(), matrix_.get(), context_.get())));
    require_success(CVodeSetLinearSolver(memory_.get(), linear_solver_.get(), matrix_.get()));
    require_success(CVodeSetJacFn(memory_.get(), jacobian));
  }

  std::optional<Ending> choose_first_step() {
    if (steps_ > 0) return std::nullopt;
    constexpr int first_order = 1;  // both families start with order 1
    const auto h = initial_step(evaluator_, t_, y(), request_.t_end, request_.tolerances, first_order);
    evaluator_.rethrow();
    if (!h) return evaluator_.trouble();
    require_success(CVodeSetInitStep(memory_.get(), *h));
    return std::nullopt;
  }

  std::optional<Ending> undo(Ending why) {
    t_ = t_previous_;
    std::ranges::copy(y_previous_, elements(state_.get()).begin());
    return why;
  }

  // The evaluator's own reason says more than a flag. What is left are cvode_attempts that all failed the
  // error test or the corrector although f had values everywhere: no honest name but that the work led
  // nowhere.
  Ending ending_of(int flag) const {
    if (flag == CV_MEM_FAIL) throw std::bad_alloc();
    if (evaluator_.trouble()) return *evaluator_.trouble();
    return flag == CV_TOO_MUCH_ACC ? Ending::tolerance : Ending::step_limit;
  }

  Evaluator evaluator_;
  const RunRequest& request_;
  ContextPointer context_;
  VectorPointer state_;
  VectorPointer output_;
  NonlinearSolverPointer fixed_point_;
  MatrixPointer matrix_;
  LinearSolverPointer linear_solver_;
  std::vector<double> y_previous_;
  double t_previous_;
  double t_;
  std::uint64_t steps_{};
  std::unique_ptr<void, CvodeDeleter> memory_;  // last: it refers to all of the above
};

}  // namespace

std::unique_ptr<Stepper> make_adams_stepper(const RightHandSide& system, const RunRequest& request) {
  return std::make_unique<CvodeStepper>(CV_ADAMS, system, request);
}

std::unique_ptr<Stepper> make_bdf_stepper(const RightHandSide& system, const RunRequest& request) {
  if (!system.jacobian) throw std::invalid_argument("bdf needs a Jacobian");
  return std::make_unique<CvodeStepper>(CV_BDF, system, request);
}

}  // namespace qdot
