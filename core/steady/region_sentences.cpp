#include "core/steady/region_sentences.hpp"

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
