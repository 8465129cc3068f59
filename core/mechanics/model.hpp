#pragma once
// A scene with everything that is derived from it once: read this after core/pipeline.hpp.
//
// A model never changes after it is built, its graph included, so threads share it. Whoever derives more from
// its expressions works on a copy of the graph (Graph::adopt).

#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/mechanics/equations_of_motion.hpp"
#include "core/mechanics/followers.hpp"
#include "core/mechanics/lagrangian.hpp"
#include "core/mechanics/parsed_scene.hpp"
#include "core/mechanics/partial_quantities.hpp"

namespace qdot {

/// A scene with mistakes, all of them.
class SceneError : public Error {
 public:
  explicit SceneError(std::vector<Diagnostic> diagnostics);
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

struct Model {
  Scene scene;
  ParsedScene parsed;
  Lagrangian lagrangian;
  EquationsOfMotion equations;
  AugmentedSystem system;  ///< what determines the accelerations and the multipliers
  /// T by degree in the velocities [J]; absent when the scene gives only L.
  std::vector<Expression> kinetic_parts;  ///< T2, T1, T0
  std::optional<Expression> energy;       ///< T + V [J]
  std::vector<Expression> momenta;        ///< p_i = dL/dq_i'
  Expression jacobi;                      ///< h = sum p_i q_i' - L [J]
  std::vector<Expression> validity;       ///< the quantities of Scene::valid_while; may contain q''
  std::vector<Expression> reports;        ///< those of Scene::reports
  std::vector<PartialQuantity> partial;   ///< what has values in some places only
  std::string impulse;                    ///< why no motion is computed, where L jumps

  [[nodiscard]] std::size_t degrees_of_freedom() const { return scene.coordinates.size(); }
  [[nodiscard]] bool has_constraints() const { return !scene.constraints.empty(); }
};

/// Throws SceneError with every mistake in the scene. With `exponents` the model is that of the scene where
/// these parameters have these values (exponents.hpp).
[[nodiscard]] std::shared_ptr<const Model> build_model(const Scene& scene,
                                                       const ExponentValues& exponents = {},
                                                       const Followers& followers = {});

/// Values by name.
using Values = std::map<std::string, double>;

/// Values by name, as a request gives them.
class RealValues {
 public:
  using Map = std::map<std::string, Real>;
  RealValues() = default;
  RealValues(std::initializer_list<Map::value_type> values) : by_name_(values) {}
  RealValues(const Values& doubles) : by_name_(doubles.begin(), doubles.end()) {}  // NOLINT: they are exact
  template <class Iterator>
  RealValues(Iterator begin, Iterator end) : by_name_(begin, end) {}

  /// Null where there is none of that name.
  [[nodiscard]] const Real* find(const std::string& name) const {
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : &found->second;
  }

 private:
  Map by_name_;
};

/// All parameters in order: those given, the others by their defaults, which may depend on the given ones.
[[nodiscard]] Reals parameter_values(const Model& model, const RealValues& given);

/// q, then q', in order: those given ("theta", "theta_dot"), the others by their defaults.
[[nodiscard]] Reals initial_state(const Model& model, const Reals& parameters, const RealValues& given);

}  // namespace qdot
