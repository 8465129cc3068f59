#pragma once
// Values as people write them: a quantity, "30deg", or an expression, "2*m*g/l", of numbers and of the
// system's parameters. Numbers in an expression are in SI; its dimension has to fit where it speaks of
// parameters.

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "api/contract/submission.hpp"
#include "api/contract/units.hpp"
#include "api/json/json.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

/// What an expression may speak of: a scene's parameters, with the values that a request gives them and by
/// default those of the scene.
class ParameterScope {
 public:
  /// Numbers only.
  ParameterScope() = default;
  /// `given` is the request's object of parameters, `place` where it is. All three have to live as long.
  ParameterScope(const Scene& scene, const Json& given, const Place& place);

  /// Has no value here, for it has many: what speaks of it is refused.
  void leave_open(const std::string& name);

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] const Parameter& parameter(std::size_t i) const { return scene_->parameters[i]; }
  /// In SI. An error where its own text has one, or where it speaks of itself, by others too (circular).
  [[nodiscard]] std::variant<Real, QuantityError> value_of(std::size_t i);

 private:
  [[nodiscard]] std::variant<Real, QuantityError> read(std::size_t i);

  const Scene* scene_{};
  const Json* given_{};
  const Place* place_{};
  std::vector<std::string> names_;
  std::vector<bool> is_open_;  ///< being read
  std::vector<bool> varies_;
};

/// The SI value of `text` for a symbol declared in `expected_unit`, rounded once. A quantity is read first:
/// "2 m" are two metres, "2*m" is twice the parameter m.
[[nodiscard]] std::variant<Real, QuantityError> written_value(std::string_view text,
                                                              std::string_view expected_unit,
                                                              ParameterScope& scope);

}  // namespace qdot::api
