#include "core/motion/simulation_output.hpp"

#include "core/base/work.hpp"

namespace qdot {
namespace {

constexpr std::size_t rows_of_reference = 64;  ///< at which it is looked at what that keeps

}  // namespace

void fill_columns(const SimulationRequest& request, MotionSections& sections,
                  std::span<const std::size_t> row_sections, Simulation& motion) {
  if (request.columns.empty()) return;
  const std::size_t width = request.columns.size(), size = request.y_start.size();
  motion.columns.resize(motion.rows * width);
  for (std::size_t i = 0; i < motion.rows; ++i) {
    if (i % 256 == 0) check_interruption();
    const std::span<const double> row = std::span(motion.states).subspan(i * size, size);
    const std::span<double> out = std::span(motion.columns).subspan(i * width, width);
    auto& [function, workspace] = sections.columns_in(row_sections[i]);
    if (function->evaluate(request.grid[i], row, workspace, out) == Evaluation::ok) continue;
    throw Error(ErrorCode::invalid_state, "One of the columns has no finite value along this motion.");
  }
}

void note_what_is_kept(const Dynamics& dynamics, const SimulationRequest& request,
                       std::span<const Segment> segments, Simulation& motion) {
  const std::size_t every = request.is_reference ? 1 + motion.rows / rows_of_reference : 1;
  std::vector<double> changes = conserved_changes(dynamics, request, motion.states, segments, every);
  motion.conserved = conserved_records(dynamics, request, changes);
  if (request.is_reference) return;
  motion.changes = std::move(changes);
  motion.constraints = constraints_along(dynamics, request, motion.states);
}

}  // namespace qdot
