#include "core/motion/extended_impacts.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/compile/tape_evaluator.hpp"
#include "core/motion/impact_map.hpp"
#include "core/numerics/ball.hpp"

namespace qdot {
namespace {

constexpr unsigned order_beside = 6;  ///< of the series from a known impact to the one beside it
constexpr double farthest = 1e-4;     ///< of a section's duration: where these few terms do
constexpr int most_secants = 12;
constexpr double as_near_as_can_be = 0x1p-90;  ///< of the instant

bool has_solve(const CompiledFunction& function) {
  return std::ranges::any_of(function.instructions(),
                             [](const Instruction& i) { return i.operation == Operation::solve; });
}

std::vector<Ball> balls(std::span<const DoubleDouble> numbers) {
  std::vector<Ball> result;
  for (const DoubleDouble& x : numbers) result.emplace_back(x, 0.0);
  return result;
}

/// One of the scene's impacts.
struct Passage {
  ImpactMap map;
  CompiledFunction event;
  std::shared_ptr<const CompiledFunction> components;
  TapeEvaluator<Ball> event_at, components_at;

  Passage(const Dynamics& dynamics, const ParsedImpact& impact, std::span<const DoubleDouble> parameters)
      : map(impact_map(dynamics.model(), impact)),
        event(dynamics.event(impact.event).value),
        components(dynamics.columns(map.components)),
        event_at(event, balls(parameters)),
        components_at(*components, balls(parameters)) {}
};

class ThroughImpacts {
 public:
  ThroughImpacts(std::span<const SectionRecord> sections, const Dynamics& dynamics,
                 const ExtendedMotionRequest& request, std::vector<std::unique_ptr<Passage>>& passages)
      : sections_(sections),
        system_(extended_system(dynamics, request)),
        passages_(passages),
        piece_(request),
        grid_(request.grid) {
    run_.bounded = true;
  }

  std::optional<ExtendedRun> run() {
    for (const SectionRecord& section : sections_) {
      if (!go_to(section.t) || !pass(section)) return std::nullopt;
    }
    piece_.grid.assign(grid_.begin() + static_cast<std::ptrdiff_t>(run_.rows), grid_.end());
    if (!piece_.grid.empty() && !go_on()) return std::nullopt;
    return std::move(run_);
  }

 private:
  static std::vector<DoubleDouble> at(TapeEvaluator<Ball>& function, std::size_t outputs,
                                      const DoubleDouble& t, std::span<const DoubleDouble> y) {
    std::vector<Ball> values(outputs);
    function.set_time(Ball(t, 0));
    function(balls(y), values);
    std::vector<DoubleDouble> result;
    for (const Ball& value : values) result.push_back(value.middle);
    return result;
  }

  /// To t, which is no instant of the grid, with the rows on the way.
  [[nodiscard]] bool go_to(const DoubleDouble& t) {
    piece_.grid.clear();
    for (std::size_t i = run_.rows; i < grid_.size() && !is_before(t, grid_[i]); ++i)
      piece_.grid.push_back(grid_[i]);
    piece_.grid.push_back(t);
    if (!go_on()) return false;
    run_.rows -= 1;
    run_.states.resize(run_.rows * piece_.y_start.size());
    run_.passed.resize(run_.states.size());
    return true;
  }

  /// Through the grid of the piece. The next one begins at its end.
  [[nodiscard]] bool go_on() {
    const ExtendedRun piece = extended_states(system_, piece_);
    run_.evaluations += piece.evaluations;
    piece_.limits.max_evaluations -= std::min(piece_.limits.max_evaluations, piece.evaluations);
    run_.bounded = run_.bounded && piece.bounded;
    if (piece.rows < piece_.grid.size()) return false;
    run_.rows += piece.rows;
    run_.states.insert(run_.states.end(), piece.states.begin(), piece.states.end());
    pass_on(piece.passed);
    piece_.t_start = piece_.grid.back();
    piece_.y_start = piece.y;
    return true;
  }

  /// What earlier pieces have passed counts in later ones.
  void pass_on(std::vector<double> passed) {
    const std::size_t n = piece_.y_start.size();
    largest_.resize(n);
    for (std::size_t i = 0; i < passed.size(); ++i) {
      passed[i] = std::max(passed[i], largest_[i % n]);
      if (i + n >= passed.size()) largest_[i % n] = passed[i];
    }
    run_.passed.insert(run_.passed.end(), passed.begin(), passed.end());
  }

  /// From just beside the impact to the state after it.
  [[nodiscard]] bool pass(const SectionRecord& section) {
    Passage& passage = *passages_[section.impacts.front()];
    const std::size_t n = piece_.y_start.size();
    std::vector<DoubleDouble> c(n * (order_beside + 1));
    if (system_.expansion(piece_.t_start, piece_.y_start, order_beside, c) != Evaluation::ok) return false;
    const auto state_after = [&](const DoubleDouble& d) {
      std::vector<DoubleDouble> y(n);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = order_beside + 1; k-- > 0;) y[i] = y[i] * d + c[i * (order_beside + 1) + k];
      }
      return y;
    };
    const double reach = farthest * section.duration;
    const auto d = zero_near(
        [&](const DoubleDouble& s) {
          return at(passage.event_at, 1, piece_.t_start + s, state_after(s)).front();
        },
        reach);
    if (!d || has_row_within(section.t, 2 * std::abs(d->high))) return false;
    piece_.y_start = state_after(*d);
    piece_.t_start = piece_.t_start + *d;
    passage.map.assign(at(passage.components_at, passage.map.places.size(), piece_.t_start, piece_.y_start),
                       piece_.y_start);
    return true;
  }

  template <class Function>
  [[nodiscard]] std::optional<DoubleDouble> zero_near(const Function& g, double reach) const {
    const double accuracy = as_near_as_can_be * (reach + std::abs(piece_.t_start.high));
    DoubleDouble a = 1e-3 * reach, b = 0.0, at_a = g(a);
    for (int i = 0; i < most_secants; ++i) {
      const DoubleDouble at_b = g(b);
      const DoubleDouble rise = at_b - at_a;
      const DoubleDouble step = rise.high == 0 ? DoubleDouble(0) : at_b * (b - a) / rise;
      if (!(std::abs(step.high) <= reach)) return std::nullopt;
      a = b;
      at_a = at_b;
      b = b - step;
      if (std::abs(b.high) > reach) return std::nullopt;
      if (std::abs(step.high) <= accuracy) return b;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool has_row_within(double t, double reach) const {
    return std::ranges::any_of(grid_, [&](const DoubleDouble& row) {
      return row.high != t && std::abs((row - DoubleDouble(t)).high) <= reach;
    });
  }

  std::span<const SectionRecord> sections_;
  ExtendedSystem system_;
  std::vector<std::unique_ptr<Passage>>& passages_;
  ExtendedMotionRequest piece_;
  std::span<const DoubleDouble> grid_;
  ExtendedRun run_;
  std::vector<double> largest_;  ///< that was passed, of each component
};

}  // namespace

std::optional<ExtendedRun> extended_states_through(std::span<const SectionRecord> sections,
                                                   const Dynamics& dynamics,
                                                   const ExtendedMotionRequest& request) {
  const auto is_one = [](const SectionRecord& section) { return section.impacts.size() == 1; };
  if (!std::ranges::all_of(sections, is_one)) return std::nullopt;
  std::vector<std::unique_ptr<Passage>> passages;
  for (const ParsedImpact& impact : dynamics.model().parsed.impacts) {
    const auto components = dynamics.columns(impact_map(dynamics.model(), impact).components);
    if (has_solve(dynamics.event(impact.event).value) || has_solve(*components)) return std::nullopt;
    passages.push_back(std::make_unique<Passage>(dynamics, impact, request.parameters));
  }
  return ThroughImpacts(sections, dynamics, request, passages).run();
}

}  // namespace qdot
