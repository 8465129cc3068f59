#include "core/motion/many_pieces.hpp"

#include <algorithm>

namespace qdot {
namespace {

constexpr std::size_t pieces_judged = 1000;
constexpr double clearly_longer = 1.01;
constexpr double far_too_many = 10;  ///< times the steps that are left

}  // namespace

bool takes_too_many_pieces(const Simulation& so_far, const SimulationRequest& request) {
  const std::vector<PieceRecord>& all = so_far.pieces;
  if (all.size() <= 2 * pieces_judged || all.size() % pieces_judged != 0) return false;
  const auto ended = [&](std::size_t back) { return all[all.size() - 1 - back].t; };
  const double now = ended(0) - ended(pieces_judged),
               before = ended(pieces_judged) - ended(2 * pieces_judged);
  const double left =
      static_cast<double>(request.limits.max_steps - std::min(request.limits.max_steps, so_far.steps));
  return now <= clearly_longer * before &&
         (request.t_end - so_far.t) / now * pieces_judged > far_too_many * left;
}

}  // namespace qdot
