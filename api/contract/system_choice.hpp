#pragma once
// The system of a request, and what the request says of the system's own symbols.

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/contract/field.hpp"
#include "api/contract/field_values.hpp"
#include "api/contract/submission.hpp"
#include "api/contract/symbol.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

/// Only what was given, in the scene's order; what is missing has the scene's defaults.
struct SystemChoice {
  std::shared_ptr<const Scene> scene{};
  bool is_carried{};  ///< the request brings the scene, so that its start is the request's
  std::vector<std::pair<std::string, Real>> parameters{};     ///< SI
  std::vector<std::pair<std::string, Real>> initial{};        ///< coordinates and velocities, SI
  std::vector<std::pair<std::string, std::string>> inputs{};  ///< expressions in t and the parameters
  std::vector<std::pair<std::string, Real>> equilibrium{};    ///< coordinates where it is meant, SI
  std::vector<std::pair<std::string, Real>> position{};       ///< coordinates, SI
  /// Parameters and the initial state as they were written, "30deg", "2*m*g/l".
  std::vector<std::pair<std::string, std::string>> written{};
  std::vector<std::string> notes{};  ///< how a value was understood that could be meant otherwise
};

/// Finds the system that a request's value names or is: a name, or a scene object. Without one it reports
/// why.
using FindSystem =
    std::function<std::shared_ptr<const Scene>(const Json& value, const Place& place, Errors& errors)>;

/// The symbols of one role: parameters; or each coordinate and its velocity; or inputs; or coordinates.
[[nodiscard]] std::vector<Symbol> symbols(const Scene& scene, SymbolRole role);

/// The symbol's role, if the scene has it; a coordinate by itself is an initial value.
[[nodiscard]] std::optional<SymbolRole> role_of(const Scene& scene, const std::string& name);

/// Reads an object of the role's symbols into `choice`, whose scene is set, and returns the resolved object.
/// `scope`: what the values may speak of.
Json read_symbols(SymbolRole role, const Json& value, const Place& place, ParameterScope& scope,
                  SystemChoice& choice, Errors& errors);

}  // namespace qdot::api
