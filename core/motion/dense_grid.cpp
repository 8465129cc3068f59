#include "core/motion/dense_grid.hpp"

#include <algorithm>

namespace qdot {
namespace {

constexpr std::size_t instants = 64;  ///< at least so many places are compared

void thin_rows(std::vector<double>& rows, std::size_t count, std::size_t width,
               const std::vector<bool>& wanted) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!wanted[i]) continue;
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                rows.begin() + static_cast<std::ptrdiff_t>(kept++ * width));
  }
  rows.resize(kept * width);
}

}  // namespace

DenseGrid::DenseGrid(const SimulationRequest& request) : t(request.grid) {
  const double span = (request.grid.empty() ? request.t_end : request.grid.back()) - request.t_start;
  for (std::size_t i = 1; t.size() < instants && i < instants; ++i) {
    t.push_back(request.t_start + span * static_cast<double>(i) / instants);
  }
  if (!std::ranges::is_sorted(t)) std::sort(t.begin(), t.end());
  t.erase(std::unique(t.begin(), t.end()), t.end());
  if (t == request.grid) {
    wanted.assign(t.size(), true);
    left_out = request.grid_left_out;
    left_out.resize(t.size());
    return;
  }
  auto next = request.grid.begin();
  for (const double instant : t) {
    while (next != request.grid.end() && *next < instant) ++next;
    wanted.push_back(next != request.grid.end() && *next == instant);
    const auto place = static_cast<std::size_t>(next - request.grid.begin());
    left_out.push_back(wanted.back() && !request.grid_left_out.empty() ? request.grid_left_out[place] : 0);
  }
}

void DenseGrid::thin(Simulation& simulation, std::size_t width, std::size_t columns) const {
  if (std::ranges::find(wanted, false) == wanted.end()) return;
  const std::size_t rows = simulation.rows;
  thin_rows(simulation.states, rows, width, wanted);
  thin_rows(simulation.columns, rows, columns, wanted);
  simulation.rows = static_cast<std::size_t>(
      std::count(wanted.begin(), wanted.begin() + static_cast<std::ptrdiff_t>(rows), true));
}

}  // namespace qdot
