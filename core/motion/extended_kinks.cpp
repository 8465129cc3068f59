#include "core/motion/extended_kinks.hpp"

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/compile/extended/expansion.hpp"
#include "core/motion/extended_pieces.hpp"
#include "core/motion/kink_modes.hpp"

namespace qdot {
namespace {

constexpr int most_own_turns = 64;

/// The motion on given sides of its kinks.
class ExtendedSides {
 public:
  ExtendedSides(const Dynamics& dynamics, Sides sides, ExtendedMotionRequest request)
      : sides_(std::move(sides)), functions_(dynamics.kinked(staying_on(sides_))) {
    request.parameters.insert(request.parameters.end(), sides_.begin(), sides_.end());
    parameters_ = request.parameters;
    if (functions_ && has_extended_expansion(functions_->accelerations))
      system_ = extended_system(functions_->accelerations, request);
  }

  /// u of the kink, or what is zero where the motion no longer stays on it.
  [[nodiscard]] DoubleDouble end(std::size_t kink, const DoubleDouble& t, std::span<const DoubleDouble> y) {
    const auto& function = sides_[kink] == 0 ? functions_->holds[kink] : functions_->arguments[kink];
    return ends_.try_emplace(kink, *function, parameters_).first->second(t, y).front();
  }

  /// As long as all kinks but that one have their sides; none where there are no such equations.
  [[nodiscard]] const ExtendedSystem* system_beside(std::optional<std::size_t> kink) {
    if (!system_.expansion) return nullptr;
    system_.margin = [this, kink](const DoubleDouble& t, std::span<const DoubleDouble> y) {
      return margin(kink, t, y).least;
    };
    return &system_;
  }

  struct Margin {
    double least{infinity};
    std::size_t kink{};
  };
  [[nodiscard]] Margin margin(std::optional<std::size_t> but, const DoubleDouble& t,
                              std::span<const DoubleDouble> y) {
    Margin found;
    for (std::size_t kink = 0; kink < sides_.size(); ++kink) {
      if (sides_[kink] == 0 || kink == but) continue;
      const double beside = sides_[kink] * end(kink, t, y).value();
      if (beside < found.least) found = {beside, kink};
    }
    return found;
  }

 private:
  Sides sides_;
  std::shared_ptr<const KinkedMotion> functions_;
  std::vector<DoubleDouble> parameters_;
  ExtendedSystem system_;
  std::map<std::size_t, ExtendedFunction> ends_;  ///< by kink
};

class ExtendedKinks {
 public:
  /// Keeps the references.
  ExtendedKinks(const Dynamics& dynamics, const ExtendedMotionRequest& request)
      : dynamics_(dynamics), request_(request), motion_(request) {}

  /// False where the motion is not followed beyond this piece.
  [[nodiscard]] bool follow(const PieceRecord& piece) {
    ExtendedSides& mode = mode_of(piece.sides);
    const bool is_last = piece.ended_by.empty();
    const std::optional<std::size_t> kink = is_last ? std::nullopt : std::optional(piece.ended_by.front());
    const ExtendedSystem* system = mode.system_beside(kink);
    if (system == nullptr) return false;
    const bool has_come = is_last ? motion_.finish(*system) : motion_.go_to(*system, piece.t);
    if (motion_.has_left()) go_own_way(piece.sides, kink);
    if (is_last || !has_come || piece.ended_by.size() > 1) return false;
    const auto g = [&](const DoubleDouble& t, std::span<const DoubleDouble> y) {
      return mode.end(*kink, t, y);
    };
    return motion_.turn_at_zero(*system, g, piece.duration);
  }

  [[nodiscard]] ExtendedRun run() && { return std::move(motion_).run(); }

 private:
  ExtendedSides& mode_of(const Sides& sides) {
    return modes_.try_emplace(sides, dynamics_, sides, request_).first->second;
  }

  /// To the end, over each kink that it meets to its other side: in doubles it lies on one that it leaves.
  void go_own_way(Sides sides, std::optional<std::size_t> but) {
    for (int turns = 0; turns < most_own_turns && motion_.has_left(); ++turns) {
      const std::size_t met = mode_of(sides).margin(but, motion_.t(), motion_.y()).kink;
      sides[met] = -sides[met];
      but.reset();
      const ExtendedSystem* system = mode_of(sides).system_beside(std::nullopt);
      if (system == nullptr || motion_.finish(*system)) return;
    }
  }

  const Dynamics& dynamics_;
  const ExtendedMotionRequest& request_;
  std::map<Sides, ExtendedSides> modes_;
  ExtendedPieces motion_;
};

}  // namespace

ExtendedRun extended_states_along(std::span<const PieceRecord> pieces, const Dynamics& dynamics,
                                  const ExtendedMotionRequest& request) {
  ExtendedKinks motion(dynamics, request);
  for (const PieceRecord& piece : pieces) {
    if (!motion.follow(piece)) break;
  }
  return std::move(motion).run();
}

}  // namespace qdot
