#include "tests/calibration/requests.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "tests/support/motions.hpp"

namespace qdot::test {
namespace {

constexpr double pi = std::numbers::pi;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  bool chance(double probability) { return random_.real() < probability; }
  double uniform(double low, double high) { return random_.real(low, high); }
  double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  double sign() { return chance(0.5) ? 1 : -1; }
  template <class T>
  T one_of(std::initializer_list<T> list) {
    return *(list.begin() + random_.integer(0, static_cast<std::int64_t>(list.size()) - 1));
  }

  /// Around a usual value: near it, or within three decades.
  double parameter(double usual) { return usual * (wild_ ? decades(-3, 3) : decades(-0.5, 0.5)); }
  double gravity() { return chance(0.08) ? 0 : chance(0.5) ? 9.81 : parameter(9.81); }
  void choose_wildness() { wild_ = chance(0.4); }

  double angle() {
    const double kind = uniform(0, 1);
    if (kind < 0.5) return uniform(-pi, pi);
    if (kind < 0.75) return sign() * decades(-6, 0);
    if (kind < 0.85) return sign() * (pi - decades(-8, -1));
    return uniform(-20, 20);
  }
  /// For a motion whose natural rate is w.
  double rate(double w) {
    const double kind = uniform(0, 1);
    if (kind < 0.3) return 0;
    return kind < 0.75 ? w * uniform(-3, 3) : w * sign() * decades(-6, 1);
  }
  double length(double usual) { return usual * (chance(0.7) ? uniform(0.3, 2) : decades(-3, 0.5)); }

 private:
  Random random_;
  bool wild_{};
};

/// Parameters, initial state and the rates that time is measured by.
struct Motion {
  Values given;
  std::vector<double> rates;
  Forcing force{};
};

/// A stretched spring's equilibrium length.
double hanging(double m, double k, double l0, double g) {
  const double length = l0 + (k > 0 ? m * g / k : 1);
  return length > 0 ? length : 1;
}

Motion spring_pendulum(Draw& draw) {
  const double m = draw.parameter(0.5), k = draw.chance(0.03) ? 0 : draw.parameter(40);
  const double l0 = draw.chance(0.06) ? 0 : draw.parameter(0.4), g = draw.gravity();
  const double size = hanging(m, k, l0, g), w = std::sqrt(k / m), swing = std::sqrt(g / size);
  const double unit = std::max({w, swing, 1e-3});
  const double l = draw.length(size), turn = draw.rate(unit);
  return {{{"m", m},
           {"k", k},
           {"l0", l0},
           {"g", g},
           {"l", l},
           {"theta", draw.angle()},
           {"l_dot", size * draw.rate(unit)},
           {"theta_dot", turn}},
          {w, swing, std::abs(turn), std::sqrt(g / l)}};
}

Motion forced_spring_pendulum(Draw& draw) {
  Motion motion = spring_pendulum(draw);
  const double w = std::max({motion.rates[0], motion.rates[1], 1e-3});
  Forcing& f = motion.force;
  f.amplitude = draw.sign() * motion.given["m"] * std::max(motion.given["g"], 0.1) * draw.decades(-2, 0.5);
  f.frequency = draw.chance(0.3) ? w : w * draw.decades(-2, 1.5);
  if (draw.chance(0.2)) f.decay = w * draw.decades(-3, -1);
  if (draw.chance(0.6)) f.phase = draw.uniform(-3, 3);
  f.rectified = draw.chance(0.15);
  motion.rates.push_back(f.frequency);
  return motion;
}

Motion rolling_disk_platform(Draw& draw) {
  const double W = draw.chance(0.05) ? 0 : draw.sign() * draw.parameter(0.5);
  const double r = draw.parameter(0.05), g = draw.gravity();
  return {{{"m", draw.parameter(0.2)},
           {"r", r},
           {"Omega", W},
           {"g", g},
           {"q", draw.chance(0.3) ? 0 : draw.sign() * draw.parameter(0.5)},
           {"q_dot", draw.rate(1)}},
          {10 * std::abs(W)}};  // it grows as exp(W t)
}

Motion cart_pendulum(Draw& draw) {
  const double M = draw.parameter(1), m = draw.parameter(0.5), k = draw.chance(0.05) ? 0 : draw.parameter(25);
  const double l = draw.parameter(0.4), g = draw.gravity();
  const double cart = std::sqrt(k / M), swing = std::sqrt(g / l * (M + m) / M),
               w = std::max({cart, swing, 1e-3});
  return {{{"M", M},
           {"m", m},
           {"k", k},
           {"l", l},
           {"g", g},
           {"x", draw.sign() * draw.length(l)},
           {"theta", draw.angle()},
           {"x_dot", l * draw.rate(w)},
           {"theta_dot", draw.rate(w)}},
          {cart, swing, w}};
}

Motion rod_pendulum(Draw& draw) {
  const double l = draw.parameter(0.5), g = draw.gravity(), w = std::max(std::sqrt(g / l), 1e-3);
  return {{{"m", draw.parameter(0.5)},
           {"l", l},
           {"g", g},
           {"theta", draw.angle()},
           {"phi", draw.angle()},
           {"theta_dot", draw.rate(w)},
           {"phi_dot", draw.rate(w)}},
          {2.8 * w}};
}

Motion rod_spring_pendulum(Draw& draw) {
  const double m = draw.parameter(0.5), l = draw.parameter(0.5), k = draw.parameter(40),
               l0 = draw.parameter(0.4);
  const double g = draw.gravity(), size = hanging(m, k, l0, g), w = std::sqrt(k / m),
               swing = std::sqrt(g / l);
  const double unit = std::max(w, swing), r = draw.length(size);
  return {{{"m", m},
           {"l", l},
           {"k", k},
           {"l0", l0},
           {"g", g},
           {"theta", draw.angle()},
           {"phi", draw.angle()},
           {"r", r},
           {"theta_dot", draw.rate(swing)},
           {"phi_dot", draw.rate(unit)},
           {"r_dot", size * draw.rate(unit)}},
          {2 * w, swing, std::sqrt(g / r)}};
}

Motion whirling_pendulum(Draw& draw) {
  const double l = draw.parameter(0.5), g = draw.gravity(), swing = std::max(std::sqrt(g / l), 1e-3);
  const double critical = swing * (1 + draw.sign() * draw.decades(-9, -2));
  const double W = draw.sign() * (draw.chance(0.2) ? critical : swing * draw.decades(-1.5, 1.5));
  return {{{"m", draw.parameter(0.2)},
           {"l", l},
           {"R", draw.parameter(0.3)},
           {"Omega", W},
           {"g", g},
           {"theta", draw.angle()},
           {"theta_dot", draw.rate(std::max(swing, std::abs(W)))}},
          {swing, std::abs(W)}};
}

Motion orbiting_pendulum(Draw& draw) {
  const double l = draw.parameter(0.5), r = draw.chance(0.2) ? l : draw.parameter(0.5);
  const double W = draw.sign() * draw.parameter(2), w = std::abs(W) * std::sqrt(r / l);
  return {{{"m", draw.parameter(0.2)},
           {"l", l},
           {"r", r},
           {"omega0", W},
           {"phi", draw.angle()},
           {"phi_dot", draw.chance(0.3) ? W : draw.rate(w)}},
          {w, std::abs(W)}};
}

Motion free_spin_pendulum(Draw& draw) {
  const double l = draw.parameter(0.5), g = draw.gravity(), w = std::max(std::sqrt(g / l), 1e-3);
  const double spin = draw.chance(0.3) ? 2 * w : draw.rate(w);
  return {{{"m", draw.parameter(0.2)},
           {"l", l},
           {"g", g},
           {"theta", draw.angle()},
           {"psi", draw.angle()},
           {"theta_dot", draw.rate(w)},
           {"psi_dot", spin}},
          {w, std::abs(spin)}};
}

Motion compass_walker(Draw& draw) {
  const double M = draw.parameter(1), m = draw.chance(0.4) ? 0 : M * draw.decades(-4, 0);
  const double l = draw.parameter(1), g = 9.81 * draw.decades(-1, 1), w = std::sqrt(g / l);
  const double spread = draw.decades(-4, -0.5);
  const auto near = [&](double value) { return value * (1 + spread * draw.uniform(-1, 1)); };
  return {{{"M", M},
           {"m", m},
           {"l", l},
           {"g", g},
           {"gamma", 0.009 * draw.uniform(0.2, 1.6)},
           {"theta", near(0.2003)},
           {"phi", near(0.4006)},
           {"theta_dot", near(-0.1998) * w},
           {"phi_dot", near(-0.01582) * w}},
          {3 * w}};
}

Motion rotating_l_bar(Draw& draw) {
  const double l = draw.parameter(0.2), g = draw.gravity(), w = std::max(std::sqrt(g / l / 2), 1e-3);
  const double W = draw.sign() * w * draw.decades(-1.5, 1.5);
  return {{{"m", draw.parameter(0.2)},
           {"l", l},
           {"Omega", W},
           {"g", g},
           {"theta", draw.angle()},
           {"theta_dot", draw.rate(std::max(w, std::abs(W)))}},
          {w, std::abs(W)}};
}

Motion plane_pendulum(Draw& draw) {
  const double l = draw.parameter(1), g = draw.parameter(9.81), w = std::sqrt(g / l);
  const bool at_the_top = draw.chance(0.3);
  return {{{"m", 1},
           {"l", l},
           {"g", g},
           {"theta", at_the_top ? pi - draw.decades(-12, -3) : draw.angle()},
           {"theta_dot", at_the_top         ? 0
                         : draw.chance(0.2) ? 2 * w * (1 - draw.decades(-12, -3))
                                            : draw.rate(w)}},
          {w}};
}

Motion driven_pivot(Draw& draw) {
  const double l = draw.parameter(1), g = draw.gravity(), w = std::max(std::sqrt(g / l), 1e-3);
  const double drive = draw.chance(0.3) ? 2 * w : w * draw.decades(-1, 1.7);
  return {{{"m", 1},
           {"l", l},
           {"g", g},
           {"a", l * draw.decades(-3, 0)},
           {"w", drive},
           {"theta", draw.angle()},
           {"theta_dot", draw.rate(w)}},
          {w, drive}};
}

Motion damped_oscillator(Draw& draw) {
  const double m = draw.parameter(0.5), k = draw.parameter(8), w = std::sqrt(k / m);
  const double b = 2 * std::sqrt(m * k) * (draw.chance(0.1) ? 1 : draw.decades(-3, 2));
  Motion motion{{{"m", m}, {"b", b}, {"k", k}, {"x", draw.parameter(0.2)}, {"x_dot", draw.rate(w)}},
                {w, b / m}};
  if (draw.chance(0.6)) {
    motion.force = {k * draw.decades(-2, 0), 0, draw.chance(0.3) ? w : w * draw.decades(-1, 1.5), 0.3,
                    draw.chance(0.15)};
    motion.rates.push_back(motion.force.frequency);
  }
  return motion;
}

using Maker = Motion (*)(Draw&);
const std::vector<std::pair<std::string, Maker>> makers{{"spring_pendulum", spring_pendulum},
                                                        {"forced_spring_pendulum", forced_spring_pendulum},
                                                        {"rolling_disk_platform", rolling_disk_platform},
                                                        {"cart_pendulum", cart_pendulum},
                                                        {"rod_pendulum", rod_pendulum},
                                                        {"rod_spring_pendulum", rod_spring_pendulum},
                                                        {"whirling_pendulum", whirling_pendulum},
                                                        {"orbiting_pendulum", orbiting_pendulum},
                                                        {"free_spin_pendulum", free_spin_pendulum},
                                                        {"compass_walker", compass_walker},
                                                        {"rotating_l_bar", rotating_l_bar},
                                                        {"plane_pendulum", plane_pendulum},
                                                        {"driven_pivot", driven_pivot},
                                                        {"damped_oscillator", damped_oscillator}};

/// Up to 100 periods of one of the rates, and of none more than 100.
double span_of(Draw& draw, const std::vector<double>& rates) {
  double fastest = 0;
  std::vector<double> moving;
  for (const double rate : rates) {
    if (rate > 0) moving.push_back(rate);
    fastest = std::max(fastest, rate);
  }
  if (moving.empty()) return draw.decades(-1, 2);
  const auto which = static_cast<std::size_t>(draw.uniform(0, static_cast<double>(moving.size())));
  return std::min(2 * pi / moving[which] * draw.decades(-1.3, 2), 2 * pi / fastest * 100);
}

void choose_times(Draw& draw, double span, SimulationRequest& request) {
  const double kind = draw.uniform(0, 1);
  request.t_start = kind < 0.7   ? 0
                    : kind < 0.8 ? -span * draw.uniform(0, 2)
                                 : draw.sign() * span * draw.decades(0, 3);
  request.t_end = request.t_start + span;
  const int rows = static_cast<int>(draw.chance(0.2) ? draw.uniform(2, 6) : draw.decades(0.5, 2.6));
  request.grid = {request.t_start};
  const bool even = draw.chance(0.8);
  for (int i = 1; i < rows; ++i) {
    request.grid.push_back(even ? request.t_start + span * i / rows
                                : request.t_start + span * draw.uniform(0, 1));
  }
  request.grid.push_back(request.t_end);
  std::sort(request.grid.begin(), request.grid.end());
  request.grid.erase(std::unique(request.grid.begin(), request.grid.end()), request.grid.end());
}

void choose_goal(Draw& draw, double fastest, Asked& asked) {
  asked.request.method =
      draw.chance(0.4) ? Method::taylor : draw.one_of({Method::adams, Method::bdf, Method::erk});
  const double kind = draw.uniform(0, 1);
  if (kind < 0.35) {
    const double rtol = draw.decades(-14, -2);
    const double atol = draw.chance(0.4) ? 1e-12 : draw.chance(0.5) ? rtol * 1e-3 : draw.decades(-14, -2);
    asked.request.tolerances = draw.chance(0.3) ? Tolerances{1e-9, 1e-12} : Tolerances{rtol, atol};
    if (draw.chance(0.15)) {
      const double span = asked.request.t_end - asked.request.t_start;
      const double time = fastest > 0 ? 2 * pi / fastest : span;
      asked.request.method = Method::gauss;
      asked.request.h = std::min(span / 2, time * draw.decades(-2.5, -0.8));
    }
  } else if (kind < 0.6) {
    asked.goal = {AccuracyGoal::Kind::relative, draw.one_of({1e-3, 1e-6, 1e-9}), 0};
  } else if (kind < 0.85) {
    asked.goal = {AccuracyGoal::Kind::absolute, draw.decades(-13, -3), 0};
  } else {
    asked.goal = {AccuracyGoal::Kind::work, 0, static_cast<std::uint64_t>(draw.decades(3, 6))};
  }
}

const char* name_of(Method method) {
  constexpr const char* names[]{"adams", "bdf", "erk", "taylor", "gauss"};
  return names[static_cast<std::size_t>(method)];
}

}  // namespace

std::vector<std::string> Asked::inputs() const {
  if (model_of(system)->scene.inputs.empty()) return {};
  return {force.text()};
}

QuadProblem Asked::problem() const {
  const auto model = model_of(system);
  QuadProblem problem{system, {}, request.y_start, request.t_start, request.grid, force, false};
  for (std::size_t i = 0; i < request.parameters.size(); ++i) {
    problem.parameters.emplace_back(model->scene.parameters[i].name, request.parameters[i]);
  }
  problem.impacts = model->scene.impact && request.impacts == Impacts::apply;
  return problem;
}

std::string Asked::words() const {
  std::ostringstream out;
  out.precision(17);
  out << system;
  const auto model = model_of(system);
  for (const auto& [name, value] : problem().parameters) out << ' ' << name << '=' << value;
  const std::size_t n = model->degrees_of_freedom();
  for (std::size_t i = 0; i < 2 * n; ++i) {
    out << ' ' << model->scene.coordinates[i % n].name << (i < n ? "=" : "_dot=") << request.y_start[i];
  }
  if (force.amplitude != 0) out << " F=" << force.text();
  out << " t_start=" << request.t_start << " t_end=" << request.t_end << " rows=" << request.grid.size()
      << " method=" << name_of(request.method);
  switch (goal.kind) {
    case AccuracyGoal::Kind::tolerances:
      if (request.method == Method::gauss) {
        out << " h=" << request.h;
        break;
      }
      out << " rtol=" << request.tolerances.rtol << " atol=" << request.tolerances.atol;
      break;
    case AccuracyGoal::Kind::absolute:
      out << " max_error=" << goal.value;
      break;
    case AccuracyGoal::Kind::relative:
      out << " preset=" << goal.value;
      break;
    case AccuracyGoal::Kind::work:
      out << " max_evaluations=" << goal.evaluations;
      break;
  }
  if (request.on_invalid == OnInvalid::go_on) out << " on_invalid=continue";
  if (request.impacts == Impacts::ignore) out << " impacts=false";
  return out.str();
}

Asked asked_for(const std::string& system, const Values& given, double t_end, int samples) {
  Asked asked;
  asked.system = system;
  asked.request = request_for(*model_of(system), given, instants(t_end, samples - 1));
  asked.request.method = Method::taylor;
  asked.request.tolerances = {1e-9, 1e-12};
  return asked;
}

Asked random_request(std::uint64_t seed, std::uint64_t number) {
  Draw draw(seed * 1'000'003 + number);
  draw.choose_wildness();
  const auto& [system, make] = makers[number % makers.size()];
  const Motion motion = make(draw);
  Asked asked = asked_for(system, motion.given, 1, 2);
  asked.force = motion.force;
  choose_times(draw, span_of(draw, motion.rates), asked.request);
  choose_goal(draw, *std::ranges::max_element(motion.rates), asked);
  if (draw.chance(0.6)) asked.request.on_invalid = OnInvalid::go_on;
  if (draw.chance(0.3)) asked.request.impacts = Impacts::ignore;
  return asked;
}

}  // namespace qdot::test
