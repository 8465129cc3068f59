#include "core/motion/extended_kinks.hpp"

#include <map>
#include <memory>

#include "core/compile/extended/expansion.hpp"
#include "core/motion/extended_pieces.hpp"
#include "core/motion/kink_modes.hpp"

namespace qdot {
namespace {

/// The motion on given sides of its kinks.
struct ExtendedSides {
  std::shared_ptr<const KinkedMotion> functions;
  std::vector<DoubleDouble> parameters;
  ExtendedSystem system;
  std::map<std::size_t, ExtendedFunction> ends;  ///< by kink

  ExtendedSides(const Dynamics& dynamics, const Sides& sides, ExtendedMotionRequest request)
      : functions(dynamics.kinked(staying_on(sides))) {
    request.parameters.insert(request.parameters.end(), sides.begin(), sides.end());
    parameters = request.parameters;
    if (functions && has_extended_expansion(functions->accelerations)) {
      system = extended_system(functions->accelerations, request);
    }
  }

  /// What is zero where the kink ends a piece.
  [[nodiscard]] ExtendedFunction& end(const Sides& sides, std::size_t kink) {
    const auto& function = sides[kink] == 0 ? functions->holds[kink] : functions->arguments[kink];
    return ends.try_emplace(kink, *function, parameters).first->second;
  }
};

}  // namespace

ExtendedRun extended_states_along(std::span<const PieceRecord> pieces, const Dynamics& dynamics,
                                  const ExtendedMotionRequest& request) {
  std::map<Sides, ExtendedSides> modes;
  ExtendedPieces motion(request);
  for (const PieceRecord& piece : pieces) {
    ExtendedSides& mode = modes.try_emplace(piece.sides, dynamics, piece.sides, request).first->second;
    if (!mode.system.expansion) break;
    if (piece.ended_by.empty()) {
      (void)motion.finish(mode.system);
      break;
    }
    if (!motion.go_to(mode.system, piece.t) || piece.ended_by.size() > 1) break;
    ExtendedFunction& end = mode.end(piece.sides, piece.ended_by.front());
    const auto g = [&](const DoubleDouble& t, std::span<const DoubleDouble> y) { return end(t, y).front(); };
    if (!motion.turn_at_zero(mode.system, g, piece.duration)) break;
  }
  return std::move(motion).run();
}

}  // namespace qdot
