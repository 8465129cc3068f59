#pragma once
// SUNDIALS objects owned by unique_ptr. Everything of a run hangs on one SUNContext, which is not thread safe
// and is therefore the run's own; creating and freeing all of it takes a few microseconds.

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <type_traits>

namespace qdot {

struct SundialsDeleter {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};

template <class Handle>
using SundialsPointer = std::unique_ptr<std::remove_pointer_t<Handle>, SundialsDeleter>;

using ContextPointer = SundialsPointer<SUNContext>;
using VectorPointer = SundialsPointer<N_Vector>;
using MatrixPointer = SundialsPointer<SUNMatrix>;
using LinearSolverPointer = SundialsPointer<SUNLinearSolver>;
using NonlinearSolverPointer = SundialsPointer<SUNNonlinearSolver>;

/// A creating function returns null when memory is short.
template <class Handle>
[[nodiscard]] Handle created(Handle handle) {
  if (!handle) throw std::bad_alloc();
  return handle;
}

/// Setting up fails on short memory or on our own mistake, never because of the motion.
inline void require_success(int flag) {
  constexpr int mem_fail = -20;  // CV_MEM_FAIL and ARK_MEM_FAIL
  if (flag == mem_fail) throw std::bad_alloc();
  if (flag < 0) throw std::logic_error("SUNDIALS refused a setting");
}

[[nodiscard]] inline ContextPointer make_context() {
  SUNContext context{};
  if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
  return ContextPointer(context);
}

[[nodiscard]] inline VectorPointer make_vector(std::span<const double> values, SUNContext context) {
  VectorPointer vector(created(N_VNew_Serial(static_cast<sunindextype>(values.size()), context)));
  for (std::size_t i = 0; i < values.size(); ++i) NV_Ith_S(vector.get(), i) = values[i];
  return vector;
}

[[nodiscard]] inline std::span<double> elements(N_Vector vector) {
  return {NV_DATA_S(vector), static_cast<std::size_t>(NV_LENGTH_S(vector))};
}

/// Instead of the library's printing on stderr.
inline void say_nothing(int, const char*, const char*, char*, void*) {}

}  // namespace qdot
