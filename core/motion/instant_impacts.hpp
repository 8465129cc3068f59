#pragma once
// What impacts of one instant do to a state: one after the other, in the order in which the scene has them.
//
// One may start the next: of three balls in a row the second, hit by the first, hits the third. So after
// each, an impact with restitution follows in the same instant where its distance is zero up to rounding
// and falls; the first such in order, until none falls any more. Bodies that stick, where there are many such
// impacts, take turns. What comes out may depend on the order, as it does in nature on what gives way first
// (Newton's cradle). Where several events happen in one instant the
// true motion may have any order, and the answer says whether that matters. Source: D. E. Stewart, Rigid-body
// dynamics with friction and impact, SIAM Review 42 (2000): several contacts.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/compile/tape_evaluator.hpp"
#include "core/dynamics/watch.hpp"
#include "core/motion/event_sides.hpp"
#include "core/motion/impact_map.hpp"
#include "core/motion/simulation_request.hpp"
#include "core/numerics/ball.hpp"

namespace qdot {

class InstantImpacts {
 public:
  /// `resolution`: what happens in so short a time is one instant. Keeps the reference.
  InstantImpacts(const Dynamics& dynamics, std::span<const double> parameters, double resolution);

  struct Happened {
    std::size_t impact{};        ///< its number in the model
    std::vector<double> before;  ///< the state
  };
  struct Passed {
    std::vector<Happened> all;
    std::vector<double> after;
    bool is_over{true};              ///< false: they start each other again and again
    bool order_matters{};            ///< of those whose events have happened
    bool is_unclear{};               ///< so that the opposite order is not the only other way
    double within{};                 ///< seconds, in which they really happen
    std::vector<double> rounding{};  ///< what their maps leave in doubt of each component; empty: nothing
  };
  /// From (t, y). `met`: the impacts whose events have happened; `watches`: one for each impact.
  [[nodiscard]] Passed pass(double t, const std::vector<double>& y, const std::vector<bool>& met,
                            std::span<const Watch> watches, const EventSides& sides, ImpactOrder order);

  /// The largest rate that its distance may have where both are zero as far as the state's rounding tells;
  /// none elsewhere, and without restitution.
  [[nodiscard]] std::optional<double> hidden_rate(std::size_t impact, double t,
                                                  const std::vector<double>& y) const;
  /// Whether an impact that has just been met, at a distance of zero but for rounding, leaves it no rate.
  [[nodiscard]] bool leaves_no_rate(std::size_t impact, double t, const std::vector<double>& y) const;

  /// Of what it takes from the distance; none where its map is no restitution.
  [[nodiscard]] std::optional<double> restitution(std::size_t impact) const {
    return rules_[impact].restitution;
  }

  /// What the same impacts, one after the other, do to another state.
  [[nodiscard]] std::vector<double> repeat(double t, std::vector<double> y,
                                           std::span<const Happened> impacts) const;

 private:
  struct Rule {
    ImpactMap map;
    std::shared_ptr<const CompiledFunction> after;
    std::shared_ptr<const CompiledFunction> approach;  ///< distance and its rate; null without restitution
    std::unique_ptr<TapeEvaluator<Ball>> enclosed_approach, enclosed_after;
    std::optional<double> restitution;
    std::string event;
  };
  /// The instant, and the motion that comes to it.
  struct Instant {
    double t{};
    const std::vector<double>& y;
    std::span<const Watch> watches;
    const EventSides& sides;
  };
  [[nodiscard]] Passed in_order(const Instant& now, std::span<const std::size_t> met) const;
  [[nodiscard]] std::size_t next_after(const Passed& passed, const Instant& now,
                                       std::optional<double>& later) const;
  void doubt_rates_left(double t, Passed& passed) const;
  [[nodiscard]] bool still_comes(const Instant& now, std::size_t impact, const std::vector<double>& y) const;
  void compare_orders(const Instant& now, std::vector<std::size_t> met, Passed& passed) const;
  struct Approach {
    Ball distance, rate;
  };
  [[nodiscard]] static Approach approach(const Rule& rule, double t, const std::vector<double>& y);
  [[nodiscard]] std::optional<double> follows(std::size_t impact, const Instant& now,
                                              const std::vector<double>& y) const;
  void apply(std::size_t impact, double t, Passed& passed) const;
  void change(std::size_t impact, double t, std::vector<double>& y,
              std::vector<double>* rounding = nullptr) const;
  /// The values after it, and what they may be off.
  struct Told {
    std::vector<double> values, off;
  };
  [[nodiscard]] std::vector<double> values_of(const Rule& rule, double t, const std::vector<double>& y) const;
  [[nodiscard]] Told told_after(const Rule& rule, double t, const std::vector<double>& y) const;

  std::span<const double> parameters_;
  double resolution_;
  std::vector<Rule> rules_;
};

}  // namespace qdot
