#include "tests/calibration/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/support/motions.hpp"

namespace qdot::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::uint64_t quick = 1'000;     ///< steps of the reference: tests take these
constexpr std::uint64_t patient = 20'000;  ///< the report alone
constexpr std::uint64_t long_run = 1'500'000;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

AccuracyGoal preset(double relative) { return {.kind = AccuracyGoal::Kind::relative, .value = relative}; }
AccuracyGoal within(double error) { return {.kind = AccuracyGoal::Kind::absolute, .value = error}; }

class List {
 public:
  Asked& add(const std::string& group, const std::string& name, std::uint64_t steps, Asked asked) {
    asked.request.on_invalid = OnInvalid::go_on;
    all_.push_back({group, name, std::move(asked), steps});
    return all_.back().asked;
  }
  std::vector<Extreme> take() { return std::move(all_); }

 private:
  std::vector<Extreme> all_;
};

void stiff_springs(List& list) {
  const auto motion = [](double k, double t_end) {
    return asked_for("spring_pendulum", {{"m", 1}, {"k", k}, {"l0", 1}, {"l", 1.2}, {"theta", 0.7}}, t_end,
                     101);
  };
  for (const double k : {1e6, 1e8, 1e10, 1e12}) {
    const double period = 2 * pi / std::sqrt(k);
    list.add("Stiff spring", "k = " + number(k) + ", 50 periods", quick, motion(k, 50 * period));
    list.add("Stiff spring", "k = " + number(k) + ", 1000 periods, accurate", patient,
             motion(k, 1000 * period))
        .goal = preset(1e-9);
    list.add("Stiff spring", "k = " + number(k) + ", 10 s", k < 1e7 ? patient : 0, motion(k, 10));
  }
}

void strong_damping(List& list) {
  for (const double b : {50.0, 1e3, 1e5}) {
    const Values oscillator{{"m", 0.5}, {"b", b}, {"k", 8}, {"x", 0.2}, {"x_dot", 1}};
    const std::uint64_t steps = b < 100 ? quick : b < 1e4 ? patient : long_run;
    list.add("Strong damping", "oscillator, b/m = " + number(b / 0.5) + " /s, 20 s", steps,
             asked_for("damped_oscillator", oscillator, 20, 41));
    list.add("Strong damping", "pendulum, b/(m l^2) = " + number(b) + " /s, 10 s, balanced", steps,
             asked_for("damped_pendulum", {{"b", b}, {"theta", 2.5}}, 10, 41))
        .goal = preset(1e-6);
  }
  const Values stiff{{"m", 0.5}, {"b", 1e3}, {"k", 8}, {"x", 0.2}, {"x_dot", 1}};
  for (const Method method : {Method::bdf, Method::adams, Method::erk}) {
    list.add("Strong damping", "oscillator, b/m = 2000 /s, method " + std::string(record_of(method).name),
             patient, asked_for("damped_oscillator", stiff, 20, 41))
        .request.method = method;
  }
}

void many_periods(List& list) {
  const double oscillator = 2 * pi / 4, pendulum = 2 * pi / std::sqrt(9.81);
  constexpr int rows = 100;  // not at whole periods, where velocities vanish
  for (const double periods : {1e3, 1e4, 1e5}) {
    const std::uint64_t steps = periods > 2e3 ? long_run : patient;
    const std::string n = number(periods) + " periods";
    list.add("Many periods", "harmonic oscillator, " + n, steps,
             asked_for("damped_oscillator", {{"m", 0.5}, {"b", 0}, {"k", 8}, {"x", 1}}, periods * oscillator,
                       rows));
    const Asked swing = asked_for("plane_pendulum", {{"l", 1}, {"theta", 1.2}}, periods * pendulum, rows);
    list.add("Many periods", "pendulum, " + n, steps, swing);
    list.add("Many periods", "pendulum, " + n + ", accurate", steps, swing).goal = preset(1e-9);
  }
}

void separatrices(List& list) {
  for (const double distance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    list.add("Near the separatrix", "pendulum at rest " + number(distance) + " from the top, 20 s", quick,
             asked_for("plane_pendulum", {{"l", 1}, {"theta", pi - distance}}, 20, 101));
    list.add("Near the separatrix", "the same, max_error 1e-6", quick,
             asked_for("plane_pendulum", {{"l", 1}, {"theta", pi - distance}}, 20, 101))
        .goal = within(1e-6);
  }
  const double critical = std::sqrt(9.81 / 0.5);
  for (const double theta : {0.1, 1e-6}) {
    list.add("Omega at critical", "whirling pendulum, theta = " + number(theta) + ", 100 s", patient,
             asked_for("whirling_pendulum", {{"l", 0.5}, {"Omega", critical}, {"theta", theta}}, 100, 101));
  }
}

void through_the_pivot(List& list) {
  for (const double spin : {1e-3, 1e-6}) {
    const Values given{{"m", 1}, {"k", 40},    {"l0", 0.5},        {"g", 0},
                       {"l", 1}, {"theta", 0}, {"theta_dot", spin}};
    const std::string name = "spring pendulum, g = 0, angular momentum " + number(spin);
    list.add("Through l -> 0", name, quick, asked_for("spring_pendulum", given, 5, 101));
    list.add("Through l -> 0", name + ", accurate", quick, asked_for("spring_pendulum", given, 5, 101)).goal =
        preset(1e-9);
  }
}

void mass_ratios(List& list) {
  for (const double ratio : {1e-12, 1e-6, 1e6, 1e12}) {
    list.add("Mass ratio", "cart and pendulum, m/M = " + number(ratio), patient,
             asked_for("cart_pendulum", {{"M", 1}, {"m", ratio}, {"k", 20}, {"l", 0.4}}, 5, 101));
  }
  for (const double mu : {0.0, 1e-12}) {
    list.add("Mass ratio", "walker, mu = " + number(mu) + ", 5 s", quick,
             asked_for("compass_walker", {{"m", mu}}, 5, 101));
    list.add("Mass ratio", "walker, mu = " + number(mu) + ", 5 s, accurate", quick,
             asked_for("compass_walker", {{"m", mu}}, 5, 101))
        .goal = preset(1e-9);
  }
}

void scaled(List& list) {
  for (const double s : {1e-150, 1e150}) {
    list.add("Merely scaled", "spring pendulum, masses and stiffness times " + number(s), quick,
             asked_for("spring_pendulum", {{"m", 0.5 * s}, {"k", 40 * s}}, 10, 101));
    for (const double goal : {0.0, 1e-9}) {
      Asked& lengths = list.add(
          "Merely scaled", "spring pendulum, lengths times " + number(s) + (goal > 0 ? ", accurate" : ""),
          quick, asked_for("spring_pendulum", {{"l0", 0.37 * s}, {"g", 9.81 * s}, {"l", 0.55 * s}}, 10, 101));
      if (goal > 0) lengths.goal = preset(goal);
    }
  }
}

void chaos(List& list) {
  for (const double rtol : {1e-6, 1e-9, 1e-12}) {
    Asked& asked =
        list.add("Chaos", "rod pendulum from (2, 2), 20 Lyapunov times, rtol " + number(rtol), patient,
                 asked_for("rod_pendulum", {{"l", 0.5}, {"theta", 2}, {"phi", 2}}, 12, 601));
    asked.request.tolerances = {rtol, rtol * 1e-3};
  }
  list.add("Chaos", "the same, accurate", patient,
           asked_for("rod_pendulum", {{"l", 0.5}, {"theta", 2}, {"phi", 2}}, 12, 601))
      .goal = preset(1e-9);
}

void tolerances_and_spans(List& list) {
  for (int digits = 2; digits <= 14; digits += 2) {
    const double rtol = std::pow(10.0, -digits);
    list.add("Tolerance", "spring pendulum, 20 s, rtol " + number(rtol), quick,
             asked_for("spring_pendulum", {}, 20, 101))
        .request.tolerances = {rtol, rtol * 1e-3};
  }
  for (int power = -9; power <= 6; power += 3) {
    const double t_end = std::pow(10.0, power);
    list.add("Span", "spring pendulum, t_end " + number(t_end),
             power <= 0   ? quick
             : power <= 3 ? patient
                          : 0,
             asked_for("spring_pendulum", {}, t_end, 101));
  }
}

void resonance(List& list) {
  Asked oscillator =
      asked_for("damped_oscillator", {{"m", 0.5}, {"b", 0}, {"k", 8}, {"x", 0}}, 100 * pi / 2, 100);
  oscillator.force = {0.5, 0, 4, 0, false};
  list.add("Resonance", "undamped oscillator, 100 periods", patient, oscillator);
  Asked spring = asked_for("forced_spring_pendulum", {}, 60, 101);
  spring.force = {0.3, 0, std::sqrt(80.0), 0, false};
  list.add("Resonance", "spring pendulum, 60 s", patient, spring);
  spring.force.rectified = true;
  list.add("Resonance", "spring pendulum, rectified force, 20 s", patient, spring).request.t_end = 60;
}

void samples(List& list) {
  list.add("Rows", "100,000 rows, 10 s", quick, asked_for("spring_pendulum", {}, 10, 100'000));
  list.add("Rows", "1e-12 s apart", quick, asked_for("spring_pendulum", {}, 1e-9, 1001));
  Asked late = asked_for("spring_pendulum", {}, 1 + 1e-9, 2);
  late.request.grid.clear();
  for (int i = 0; i <= 1000; ++i) late.request.grid.push_back(1 + 1e-12 * i);
  late.request.t_end = late.request.grid.back();
  list.add("Rows", "1e-12 s apart from t = 1 s on", quick, late);
}

}  // namespace

std::vector<Extreme> extremes() {
  List list;
  for (const auto add : {stiff_springs, strong_damping, many_periods, separatrices, through_the_pivot,
                         mass_ratios, scaled, chaos, tolerances_and_spans, resonance, samples}) {
    add(list);
  }
  return list.take();
}

std::string fate(const Outcome& outcome) {
  if (outcome.failed()) return "refused";
  if (outcome.measured.max_abs_error.empty()) return "no error stated";
  const auto held = [](const ColumnOutcome& c) { return c.true_error <= c.stated; };
  if (!std::ranges::all_of(outcome.columns, held)) return "NOT HELD";
  return outcome.known_rows == outcome.measured.simulation.rows ? "held" : "held as far as known";
}

}  // namespace qdot::test
