// Work and precision of every contestant on every motion: one line a point, to standard output.
//
//     work_precision FOLDER [MOTION ...]
//
// FOLDER receives what the presets cost and give, what the ladder's second run costs, and what other programs
// need to take part: motions.json, and MOTION.reference, the rows of the reference as doubles. CPU time is
// the thread's clock; the contestants take turns, and a point's time is the median of its turns.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/bench/work_precision/motions.hpp"

namespace qdot::bench {
namespace {

constexpr int turns = 7;
constexpr double longest = 0.1;   ///< s; a point that takes longer is not measured again
constexpr double too_long = 0.3;  ///< s; the method's tighter tolerances are left out
constexpr double give_up = 1e3;   ///< an error this large is no answer

struct Point {
  const Contestant* contestant;
  double tolerance;
  double error{};
  std::uint64_t evaluations{}, steps{};
  std::vector<double> times{};
};

double timed(Point& point, Outcome& outcome) {
  const double start = seconds();
  outcome = point.contestant->solve(point.tolerance);
  point.times.push_back(seconds() - start);
  return point.times.back();
}

/// Tolerances; steps of method gauss.
std::vector<double> settings_of(const std::string& method) {
  if (method == "gauss") return {0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
  const bool is_series = method.starts_with("taylor");
  std::vector<double> settings;
  for (int digits = is_series ? 2 : 3; digits <= (is_series ? 16 : 13); digits += is_series ? 1 : 2) {
    settings.push_back(std::pow(10.0, -digits));
  }
  return settings;
}

/// First turn: errors, and which points there are.
std::vector<Point> first_turn(const std::vector<Contestant>& contestants, const std::vector<double>& rows) {
  std::vector<Point> points;
  for (const Contestant& contestant : contestants) {
    for (const double setting : settings_of(contestant.method)) {
      Point point{&contestant, setting};
      Outcome outcome;
      const double time = timed(point, outcome);
      point.error = largest_error(outcome.states, rows);
      point.evaluations = outcome.evaluations;
      point.steps = outcome.steps;
      if (point.error < give_up) points.push_back(point);
      if (time > too_long) break;
    }
  }
  return points;
}

void write(const Problem& problem, const Point& point) {
  std::printf("%s,%s,%s,%g,%.3g,%.5g,%llu,%llu,%zu\n", problem.motion.name.c_str(),
              point.contestant->method.c_str(), point.contestant->equations.c_str(), point.tolerance,
              point.error, 1e6 * median(point.times), static_cast<unsigned long long>(point.evaluations),
              static_cast<unsigned long long>(point.steps), point.times.size());
}

void measure(const Problem& problem, const std::vector<double>& rows) {
  std::vector<Contestant> contestants;
  for (const auto& list :
       {own_methods(problem), hand_written_taylor(problem), boost_methods(problem), gsl_methods(problem)}) {
    contestants.insert(contestants.end(), list.begin(), list.end());
  }
  std::vector<Point> points = first_turn(contestants, rows);
  for (int turn = 1; turn < turns; ++turn) {
    for (Point& point : points) {
      Outcome outcome;
      if (point.times.front() < longest) timed(point, outcome);
    }
  }
  for (const Point& point : points) write(problem, point);
  std::fflush(stdout);
}

nlohmann::json description(const Problem& problem) {
  nlohmann::json parameters;
  const auto& named = problem.dynamics.model().scene.parameters;
  for (std::size_t i = 0; i < named.size(); ++i) parameters[named[i].name] = problem.parameters[i];
  return {{"name", problem.motion.name}, {"system", problem.motion.system}, {"inputs", problem.motion.inputs},
          {"parameters", parameters},    {"initial", problem.y_start},      {"t_end", problem.motion.t_end}};
}

}  // namespace
}  // namespace qdot::bench

int main(int count, char** words) {
  using namespace qdot::bench;
  if (count < 2) return std::fprintf(stderr, "usage: work_precision FOLDER [MOTION ...]\n"), 2;
  const std::string folder = words[1];
  const std::vector<std::string> wanted(words + 2, words + count);
  nlohmann::json descriptions = nlohmann::json::array();
  std::ofstream presets(folder + "/presets.csv"), ladder(folder + "/ladder.csv");
  presets << "motion,preset,cpu_us,error,stated_error,meets_request,evaluations\n";
  ladder << "motion,rtol,first_us,second_us\n";
  std::printf("motion,method,equations,tolerance,error,cpu_us,evaluations,steps,repeats\n");
  for (const Motion& motion : motions()) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), motion.name) == wanted.end()) continue;
    const Problem problem(motion);
    const std::vector<double> rows = reference(problem);
    std::ofstream(folder + "/" + motion.name + ".reference", std::ios::binary)
        .write(reinterpret_cast<const char*>(rows.data()),
               static_cast<std::streamsize>(rows.size() * sizeof(double)));
    descriptions.push_back(description(problem));
    measure(problem, rows);
    write_presets(problem, rows, presets);
    write_ladder(problem, ladder);
  }
  std::ofstream(folder + "/motions.json") << descriptions;
}
