#include "core/compile/taylor/composition.hpp"

#include <algorithm>
#include <cmath>

#include "core/compile/taylor/translation.hpp"

namespace qdot {
namespace {

constexpr double rounding = 0x1p-52;  ///< of a state

}  // namespace

TaylorComposition::TaylorComposition(std::shared_ptr<const CompiledFunction> function,
                                     std::span<const double> parameters)
    : function_(std::move(function)),
      workspace_(function_->bind(parameters)),
      kernels_(taylor::best_kernels()),
      translation_(std::make_unique<TaylorTranslation>(*function_, workspace_)),
      remainder_(std::make_unique<taylor::Remainder>(translation_->composition(), kernels_)),
      start_(function_->variables()),
      left_out_(function_->variables()) {}

TaylorComposition::~TaylorComposition() = default;

double TaylorComposition::expand(double t, std::span<const double> rows, unsigned rows_order, double h,
                                 unsigned order, std::span<double> coefficients) {
  for (std::size_t i = 0; i < start_.size(); ++i) start_[i] = rows[i * (rows_order + 1)];
  double value{};
  if (function_->evaluate(t, start_, workspace_, {&value, 1}) != Evaluation::ok) return infinity;
  if (!translation_->start(workspace_)) return infinity;
  put_state(rows, rows_order, h, order);
  taylor::Program alone = translation_->composition();
  alone.state.n = 0;  // the state's coefficients are there
  kernels_.expand(alone, order);
  const double* row = translation_->output();
  const double r = remainder_->distance(row, h, order, left_out_);
  std::copy_n(row, order, coefficients.begin());
  coefficients[order] = translation_->is_of_state(row) ? row[order] : 0;
  return r;
}

void TaylorComposition::put_state(std::span<const double> rows, unsigned rows_order, double h,
                                  unsigned order) {
  double* row = translation_->composition().state.rows;
  const unsigned given = std::min(order, rows_order);
  for (std::size_t i = 0; i < start_.size(); ++i, row += taylor::stride) {
    const double* c = rows.data() + i * (rows_order + 1);
    for (unsigned k = 1; k <= order; ++k) {
      row[k] = row[taylor::reversed - static_cast<int>(k)] = k <= given ? c[k] : 0;
    }
    double beyond = 0;
    for (unsigned k = rows_order; k > given; --k) beyond = (beyond + std::abs(c[k])) * h;
    for (unsigned k = given; k > 0; --k) beyond *= h;
    left_out_[i] = beyond + rounding * std::abs(c[0]);
  }
}

}  // namespace qdot
