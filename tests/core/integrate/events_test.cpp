#include "core/integrate/events.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/integrate/integrate.hpp"
#include "tests/core/integrate/systems.hpp"

namespace qdot::events_test {
namespace {

using namespace integrate_test;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// ---- EventSearch on steps of our own choosing: y(t) = t, so that g is a plain function of time. ----

class Clock : public Stepper {
 public:
  explicit Clock(std::vector<double> ends) : ends_(std::move(ends)), state_(1, ends_.front()) {}

  std::optional<Ending> step() override {
    state_[0] = ends_[++at_];
    return std::nullopt;
  }
  double t_previous() const override { return ends_[at_ - 1]; }
  double t() const override { return ends_[at_]; }
  std::span<const double> y() const override { return state_; }
  std::optional<Ending> interpolate(double t, std::span<double> y_out) override {
    y_out[0] = t;
    return std::nullopt;
  }
  std::optional<Ending> trouble() const override { return std::nullopt; }
  std::uint64_t steps() const override { return at_; }
  std::uint64_t evaluations() const override { return 0; }
  bool done() const { return at_ + 1 == ends_.size(); }

 private:
  std::vector<double> ends_;
  std::size_t at_{};
  std::vector<double> state_;
};

using Function = double (*)(double);

EventFunction event_of(Function g, Crossing direction = Crossing::either, bool terminal = false) {
  return {.value = [g](double t, auto) { return g(t); }, .direction = direction, .terminal = terminal};
}

/// Its sketches are late by a fiftieth of a second.
class RoughClock final : public Clock {
 public:
  using Clock::Clock;
  std::optional<Ending> sketch(double t, std::span<double> y_out) override {
    y_out[0] = t + 0.02;
    return std::nullopt;
  }
};

/// Its state is the number of steps taken.
class StandingClock final : public Clock {
 public:
  using Clock::Clock;
  std::optional<Ending> interpolate(double, std::span<double> y_out) override {
    y_out[0] = static_cast<double>(steps());
    return std::nullopt;
  }
};

/// All events found on steps with these ends.
template <class Stepping = Clock>
std::vector<EventOccurrence> find(std::vector<EventFunction> events, std::vector<double> ends) {
  give_series(events);
  const RunRequest request{
      .t_start = ends.front(), .y_start = {ends.front()}, .t_end = ends.back(), .events = std::move(events)};
  Stepping clock(ends);
  EventSearch search(request);
  std::vector<EventOccurrence> all;
  while (!clock.done()) {
    (void)clock.step();
    const auto found = search.search(clock);
    all.insert(all.end(), found.events.begin(), found.events.end());
    if (found.terminal) break;
  }
  return all;
}

std::vector<double> times(Function g, std::vector<double> ends, Crossing direction = Crossing::either) {
  std::vector<double> result;
  for (const auto& occurrence : find({event_of(g, direction)}, std::move(ends)))
    result.push_back(occurrence.t);
  return result;
}

void expect_times(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 4 * time_round_off(expected[i])) << i;
}

TEST(EventSearch, SeesTwoCrossingsInOneStep) {
  expect_times(times([](double t) { return (t - 1.3) * (t - 1.7); }, {0, 1, 2}), {1.3, 1.7});
  expect_times(times([](double t) { return std::sin(t); }, {0.5, 10}), {pi, 2 * pi, 3 * pi});
}

TEST(EventSearch, RoughLookMissesNothingNearZero) {
  // The dip between 1.39 and 1.41 holds one place that is looked at, 1.4; its sketch, at 1.42, is positive.
  const EventFunction dip{.value = [](double, auto y) { return (y[0] - 1.39) * (y[0] - 1.41); }};
  const auto found = find<RoughClock>({dip}, {0, 1, 2});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].t, 1.39, 4 * time_round_off(1.39));
  EXPECT_NEAR(found[1].t, 1.41, 4 * time_round_off(1.41));
}

TEST(EventSearch, HonoursTheDirection) {
  const Function g = [](double t) { return (t - 1.3) * (t - 1.7); };
  expect_times(times(g, {0, 1, 2}, Crossing::falling), {1.3});
  expect_times(times(g, {0, 1, 2}, Crossing::rising), {1.7});
}

TEST(EventSearch, TouchingZeroIsNoCrossing) {
  expect_times(times([](double t) { return (t - 1) * (t - 1); }, {0, 1, 2}), {});  // zero at a step's end
  expect_times(times([](double t) { return -(t - 0.2) * (t - 0.2); }, {0, 1, 2}),
               {});  // and at an inner probe
  expect_times(times([](double t) { return std::max(0., std::abs(t - 1) - 0.5); }, {0, 0.7, 1.1, 2}), {});
}

TEST(EventSearch, ExactZeroAtTheEndOfAStepIsDecidedInTheNext) {
  const Function g = [](double t) { return t - 1; };
  EXPECT_EQ(times(g, {0, 1, 2}), std::vector<double>{1});  // to the bit: the step's end is the place
  expect_times(times(g, {0, 1}), {});                      // it has not crossed yet
  expect_times(times([](double t) { return (t - 1) * (t - 1) * (t - 1); }, {0, 1, 1.5, 2}, Crossing::rising),
               {1});
}

TEST(EventSearch, StretchOfZerosIsLeftWhereItEnds) {
  // Zero between 0.5 and 1.5: the change of sign is complete at 1.5.
  const Function g = [](double t) { return t < 0.5 ? t - 0.5 : t > 1.5 ? t - 1.5 : 0; };
  const auto found = times(g, {0, 1, 2}, Crossing::rising);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(g(found[0]), 0);
}

TEST(EventSearch, ZeroAtTheStartDoesNotFireButLaterOnesDo) {
  expect_times(times([](double t) { return std::sin(t); }, {0, 1, 2, 3, 4}), {pi});
  expect_times(times([](double t) { return t < 1 ? 0 : t - 2; }, {0, 0.5, 3}), {2});
  // A start that is zero up to round-off, on either side.
  expect_times(times([](double t) { return std::sin(t) - 1e-17; }, {0, 1, 2, 3, 4}), {pi});
  expect_times(times([](double t) { return std::sin(t) + 1e-17; }, {0, 1, 2, 3, 4}), {pi});
}

TEST(EventSearch, ExactlyZeroFromTheStartOnNeverFires) {
  expect_times(times([](double) { return 0.; }, {0, 1, 2}), {});
}

/// x = cos t is 1/2 at pi/3. Values are rounded above that, series below.
TEST(EventSearch, ZeroThatValuesDoNotShowIsAtTheEndOfItsStep) {
  const EventFunction event{.value = [](double, auto y) { return y[0] - 0.5 + 1e-14; },
                            .series =
                                [](const MotionPiece& piece, unsigned order, std::span<double> c) {
                                  for (unsigned k = 0; k <= order; ++k)
                                    c[k] = k <= piece.order ? piece.rows[k] : 0;
                                  c[0] -= 0.5 + 1e-13;
                                  return 0.0;
                                },
                            .direction = Crossing::falling};
  std::size_t found = 0;
  for (const Method method : all_methods) {
    const RunRequest request{.y_start = {1, 0}, .t_end = pi / 3, .events = {event}, .method = method};
    const auto run = integrate(oscillator(), request);
    if (run.events.empty()) continue;  // by the error of the method
    ++found;
    EXPECT_NEAR(run.events[0].t, pi / 3, 1e-6) << name(method);
  }
  EXPECT_GT(found, 0);
}

TEST(EventSearch, WhatIsMetJustAfterTheStartIsMet) {
  for (const double level : {1.3e-16, 1e-18}) {
    EventFunction event{.value = [level](double, auto y) { return y[1] - level; },
                        .series =
                            [level](const MotionPiece& piece, unsigned order, std::span<double> c) {
                              for (unsigned k = 0; k <= order; ++k)
                                c[k] = k <= piece.order ? piece.rows[piece.order + 1 + k] : 0;
                              c[0] -= level;
                              return 0.0;
                            }};
    event.rounding_at_start = [] { return 1e-30; };
    const RunRequest request{.y_start = {-1, 0}, .t_end = 1, .events = {event}, .method = Method::erk};
    const auto run = integrate(oscillator(), request);
    ASSERT_EQ(run.events.size(), 1U) << level;
    EXPECT_NEAR(run.events[0].t, level, 1e-3 * level);
  }
}

/// Without a bound where a pole lies.
EventFunction with_poles(Function g, std::vector<double> poles) {
  EventFunction event = event_of(g);
  event.series = [bare = event, poles](const MotionPiece& piece, unsigned order, std::span<double> c) {
    const double off = sampled_series(bare, piece, order, c);
    const bool has_pole =
        std::ranges::any_of(poles, [&](double pole) { return piece.t <= pole && pole <= piece.t + piece.h; });
    return has_pole ? std::numeric_limits<double>::infinity() : off;
  };
  return event;
}

TEST(EventSearch, PolesAreNoZeros) {
  const auto found =
      find({with_poles([](double t) { return std::tan(t); }, {pi / 2, 1.5 * pi})}, {1, 2, 3, 4});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].t, pi, 1e-14);
  EXPECT_TRUE(find({with_poles([](double t) { return 1 / (t - 1.1); }, {1.1})}, {0, 1, 2}).empty());
  EXPECT_TRUE(find({with_poles([](double t) { return 1 / (t - 1); }, {1})}, {0, 1, 2}).empty());
}

TEST(EventSearch, CrossingsAsSteepAsPolesAreZeros) {
  const auto steep = [](double t) { return (t - 1.1) / ((t - 1.1) * (t - 1.1) + 1e-34); };
  const auto found = find({with_poles(steep, {})}, {0, 1, 2});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].t, 1.1, 1e-14);
}

TEST(EventSearch, JumpsCountAsZeros) {
  expect_times(times([](double t) { return t < 1.1 ? -1. : 2.; }, {0, 1, 2}), {1.1});
}

TEST(EventSearch, UndefinedStretchesArePassedOver) {
  const auto found = times([](double t) { return t < 0.5 ? -1 : t < 1.5 ? nan : t - 1.2; }, {0, 1, 2});
  expect_times(found, {1.5});
}

TEST(EventSearch, OneInstantIsReportedInOrderOfIndex) {
  // Six functions with a zero at sqrt 2, each found with round-off of its own, and two that cross elsewhere.
  static const double sqrt2 = std::sqrt(2.);
  const auto found = find(
      {event_of([](double t) { return std::exp(t) - std::exp(sqrt2); }),
       event_of([](double t) { return t - 1.5; }), event_of([](double t) { return 1 / sqrt2 - 1 / t; }),
       event_of([](double t) { return t * t * t - 2 * sqrt2; }), event_of([](double t) { return t - 1.4; }),
       event_of([](double t) { return std::log(t) - std::log(2.) / 2; }),
       event_of([](double t) { return 2 - t * t; }),
       event_of([](double t) { return std::sin(3 * (t - sqrt2)); })},
      {0.9, 1.9});
  ASSERT_EQ(found.size(), 8u);
  const std::size_t order[] = {4, 0, 2, 3, 5, 6, 7, 1};
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].event, order[i]);
  for (std::size_t i = 1; i < 7; ++i) EXPECT_EQ(found[i].t, found[1].t);
}

TEST(EventSearch, NothingIsReportedAfterATerminalEvent) {
  const auto found =
      find({event_of([](double t) { return t - 1.8; }), event_of([](double t) { return t - 1.2; }),
            event_of([](double t) { return t - 1.5; }, Crossing::either, true),
            event_of([](double t) { return 1.5 - t; })},
           {0, 1, 2, 3});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].event, 1u);
  EXPECT_EQ(found[1].event, 2u);
  EXPECT_EQ(found[2].event, 3u);  // of the same instant
}

TEST(EventSearch, StepOfNoLengthCanCross) {
  // t + h = t, but the state moves on.
  const auto found =
      find<StandingClock>({{.value = [](double, auto y) { return y[0] - 1.5; }}}, {0, 1, 1, 2});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].t, 1);
}

}  // namespace
}  // namespace qdot::events_test
