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

#include "core/integrate/sundials_stepper.hpp"
#include "core/integrate/sundials_steppers.hpp"

namespace qdot {
namespace {

struct CvodeDeleter {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

class CvodeStepper final : public SundialsStepper {
 public:
  CvodeStepper(int family, const RightHandSide& system, const RunRequest& request)
      : SundialsStepper(system, request, 1),  // both families start with order 1
        output_(make_vector(request.y_start, context_.get())),
        memory_(created(CVodeCreate(family, context_.get()))) {
    void* memory = memory_.get();
    require_success(CVodeSetErrHandlerFn(memory, say_nothing, nullptr));
    require_success(CVodeInit(memory, derivative, t_, state_.get()));
    require_success(CVodeSetUserData(memory, &evaluator_));
    require_success(CVodeSStolerances(memory, request.tolerances.rtol, request.tolerances.atol));
    require_success(CVodeSetStopTime(memory, request.t_end));
    require_success(CVodeSetMaxErrTestFails(memory, most_attempts));
    require_success(CVodeSetMaxConvFails(memory, most_attempts));
    family == CV_ADAMS ? correct_by_fixed_point() : correct_by_newton();
  }

  std::optional<Ending> interpolate(double t, std::span<double> y_out) override {
    if (copy_end(t, y_out)) return std::nullopt;
    require_success(CVodeGetDky(memory_.get(), t, 0, output_.get()));
    std::ranges::copy(elements(output_.get()), y_out.begin());
    return std::nullopt;
  }

 private:
  int set_first_step(double h) override { return CVodeSetInitStep(memory_.get(), h); }
  int advance() override { return CVode(memory_.get(), request_.t_end, state_.get(), &t_, CV_ONE_STEP); }

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
    const auto n = static_cast<sunindextype>(y().size());
    matrix_.reset(created(SUNDenseMatrix(n, n, context_.get())));
    linear_solver_.reset(created(SUNLinSol_Dense(state_.get(), matrix_.get(), context_.get())));
    require_success(CVodeSetLinearSolver(memory_.get(), linear_solver_.get(), matrix_.get()));
    require_success(CVodeSetJacFn(memory_.get(), jacobian));
  }

  VectorPointer output_;
  NonlinearSolverPointer fixed_point_;
  MatrixPointer matrix_;
  LinearSolverPointer linear_solver_;
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
