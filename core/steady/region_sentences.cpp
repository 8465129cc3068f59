#include "core/steady/region_sentences.hpp"

#include <algorithm>

#include "core/base/listed.hpp"

namespace qdot {
namespace {

const std::string& coordinate_name(const Scene& scene, const SteadyProblem& problem, std::size_t place) {
  return scene.coordinates[problem.statics->reduction.kept[place]].name;
}

}  // namespace

std::string place_named(const Scene& scene, const SteadyProblem& problem, const Box& box) {
  std::string where;
  for (std::size_t k = 0; k < problem.forces->unknowns.size(); ++k) {
    where += (where.empty() ? "Near " : " and ") +
             coordinate_name(scene, problem, problem.forces->unknowns[k]) + " = " +
             short_number(box[k].contains(0.0) ? 0.0 : box[k].middle());
  }
  return where;
}

std::vector<std::string> coordinate_names(const Scene& scene, const SteadyProblem& problem,
                                          const std::vector<std::size_t>& places) {
  std::vector<std::string> names;
  for (const std::size_t j : places) names.push_back(coordinate_name(scene, problem, j));
  return names;
}

std::string small_change(const Scene& scene, const SteadyProblem& problem, const WrittenChange& change) {
  std::vector<std::string> changes;
  for (const auto& [j, added] : change)
    changes.push_back("d" + coordinate_name(scene, problem, j) + " = " + added);
  return "The small change " + listed(changes);
}

const char* const only_families =
    " changes no force, so equilibria are no isolated points: where there are some, there is a whole family, "
    "which is not listed. 'modes' has the small motions about one of them.";

std::string given_up(const Scene& scene, const SteadyProblem& problem) {
  const std::string start = "The search was given up before it was finished, so equilibria may be missing";
  const std::vector<WrittenChange> turns = symmetric_turns(*problem.statics);
  if (problem.forces->smooth.kinks() > 0 || turns.empty())
    return start +
           ": there are many of them, perhaps without end, or many coordinates, or forces of very different "
           "sizes cancel.";
  return start + ". " + small_change(scene, problem, turns.front()) +
         " leaves the potential as it is: where it moves an equilibrium there is a whole family, which is not listed. "
         "'modes' has the small motions about one of them.";
}

std::string without_inertia(const Scene& scene, const SteadyProblem& problem, const Box& kept) {
  Box place;
  for (const std::size_t j : problem.forces->unknowns) place.push_back(kept[j]);
  const std::string where = place_named(scene, problem, place);
  return (where.empty() ? "There " : where + ", ") +
         "the mass matrix has no inverse to within rounding, as where a coordinate fails: no acceleration "
         "follows from the equations, and they do not tell whether anything can rest there.";
}

std::string undecided(const Scene& scene, const SteadyProblem& problem, const Box& box) {
  std::string where;
  for (std::size_t k = 0; k < problem.forces->unknowns.size(); ++k) {
    const std::size_t j = problem.forces->unknowns[k];
    where += (where.empty() ? "Where " : " and ") + coordinate_name(scene, problem, j) + " lies between " +
             short_number(box[k].lower) + " and " + short_number(box[k].upper);
  }
  return where + ", the forces are too small to tell whether they vanish.";
}

}  // namespace qdot
