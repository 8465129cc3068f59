#include "core/steady/steady_state.hpp"

#include "core/base/error.hpp"

namespace qdot {

std::vector<double> steady_state(const Statics& statics, std::span<const double> constants,
                                 std::span<const double> x, std::span<const double> y) {
  const std::size_t n = y.size() / 2;
  std::vector<double> state(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n));
  state.resize(2 * n, 0.0);
  for (std::size_t k = 0; k < x.size(); ++k) state[statics.reduction.kept[k]] = x[k];
  std::vector<double> rates(statics.reduction.ignored.size());
  Workspace workspace = statics.ignored_rates.bind(constants);
  if (statics.ignored_rates.evaluate(0, x, workspace, rates) != Evaluation::ok) {
    throw Error(ErrorCode::invalid_state, "A steady rate has no finite value there.");
  }
  for (std::size_t k = 0; k < rates.size(); ++k) state[n + statics.reduction.ignored[k]] = rates[k];
  return state;
}

}  // namespace qdot
