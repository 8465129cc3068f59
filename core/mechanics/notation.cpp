#include "core/mechanics/notation.hpp"

namespace qdot {

Notation notation_of(const Scene& scene) {
  Notation notation;
  for (const Parameter& p : scene.parameters) {
    notation.parameters.push_back(p.name);
    if (!p.latex.empty()) notation.latex.emplace_back(p.name, p.latex);
  }
  for (const Input& input : scene.inputs) notation.parameters.push_back(input.name);
  for (const Coordinate& q : scene.coordinates) {
    notation.coordinates.push_back(q.name);
    if (!q.latex.empty()) notation.latex.emplace_back(q.name, q.latex);
  }
  return notation;
}

}  // namespace qdot
