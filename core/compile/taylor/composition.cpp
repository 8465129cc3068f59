#include "core/compile/taylor/composition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/compile/taylor/translation.hpp"

namespace qdot {
namespace {

constexpr double rounding = 0x1p-52;  ///< of a state

/// Where these are flat, values do not show what their arguments are rounded by.
bool hides_rounding(const CompiledFunction& function) {
  return std::ranges::any_of(function.instructions(), [](const Instruction& i) {
    constexpr std::array flat{Function::sign, Function::tanh, Function::atan, Function::exp};
    return i.operation == Operation::call && std::ranges::find(flat, i.function) != flat.end();
  });
}

}  // namespace

TaylorComposition::TaylorComposition(std::shared_ptr<const CompiledFunction> function,
                                     std::span<const double> parameters, Variables variables)
    : function_(std::move(function)),
      workspace_(function_->bind(parameters)),
      kernels_(taylor::best_kernels()),
      coordinates_(function_->variables() / (variables == Variables::state ? 2 : 3)),
      start_(function_->variables()),
      left_out_(function_->variables()) {
  translation_ = std::make_unique<TaylorTranslation>(*function_, workspace_, coordinates_);
  remainder_ = std::make_unique<taylor::Remainder>(translation_->composition(), kernels_);
  if (!hides_rounding(*function_)) return;
  const auto row_of = [this](Slot slot) { return translation_->row_of(slot); };
  rounding_ = std::make_unique<taylor::Rounding>(*function_, workspace_, *remainder_, row_of);
}

TaylorComposition::~TaylorComposition() = default;

double TaylorComposition::expand(double t, std::span<const double> rows, unsigned rows_order, double h,
                                 unsigned order, std::span<double> coefficients,
                                 std::span<const double> defect) {
  const std::size_t given = 2 * coordinates_;
  for (std::size_t i = 0; i < given; ++i) start_[i] = rows[i * (rows_order + 1)];
  for (std::size_t i = given; i < start_.size(); ++i)
    start_[i] = rows[(i - coordinates_) * (rows_order + 1) + 1];
  double value{};
  const Evaluation evaluation = function_->evaluate(t, start_, workspace_, {&value, 1});
  if (evaluation == Evaluation::singular_mass) return infinity;
  if (!translation_->start(workspace_)) return infinity;
  put_variables(rows, rows_order, h, order, defect);
  taylor::Program alone = translation_->composition();
  alone.state.n = 0;  // the state's coefficients are there
  kernels_.expand(alone, order);
  const double* row = translation_->output();
  double r = remainder_->distance(row, h, order, left_out_);
  if (rounding_ && r < infinity) r += rounding_->of_output();
  std::copy_n(row, order, coefficients.begin());
  coefficients[order] = translation_->is_of_state(row) ? row[order] : 0;
  if (!(r < infinity) && remainder_->is_without_value()) return std::numeric_limits<double>::quiet_NaN();
  return evaluation == Evaluation::ok ? r : infinity;
}

void TaylorComposition::put_variables(std::span<const double> rows, unsigned rows_order, double h,
                                      unsigned order, std::span<const double> defect) {
  const std::size_t given = 2 * coordinates_, width = rows_order + 1;
  powers_[0] = 1;
  for (unsigned k = 1; k < width; ++k) powers_[k] = powers_[k - 1] * h;
  for (std::size_t i = 0; i < given; ++i) {
    const double* c = rows.data() + i * width;
    put(i, rows_order, order, [c](unsigned k) { return c[k]; });
  }
  for (std::size_t i = given; i < start_.size(); ++i) {
    const double* v = rows.data() + (i - coordinates_) * width;
    put(i, rows_order - 1, order, [v](unsigned k) { return (k + 1) * v[k + 1]; });
    left_out_[i] += defect[i - coordinates_];
  }
}

/// Coefficients up to `last`, as far as the order goes.
template <class Coefficient>
void TaylorComposition::put(std::size_t variable, unsigned last, unsigned order, const Coefficient& c) {
  double* row = translation_->variable(variable);
  const unsigned given = std::min(order, last);
  for (unsigned k = 1; k <= given; ++k) row[k] = row[taylor::reversed - static_cast<int>(k)] = c(k);
  for (unsigned k = given + 1; k <= order; ++k) row[k] = row[taylor::reversed - static_cast<int>(k)] = 0;
  double beyond = 0;
  for (unsigned k = given + 1; k <= last; ++k) beyond += std::abs(c(k)) * powers_[k];
  left_out_[variable] = beyond + rounding * std::abs(c(0));
}

}  // namespace qdot
