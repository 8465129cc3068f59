#pragma once
// Reading the texts of a scene one at a time: which symbols each may use, and which dimension it must have.

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/mechanics/dimension_check.hpp"
#include "core/mechanics/exponents.hpp"
#include "core/mechanics/followers.hpp"
#include "core/mechanics/scene.hpp"
#include "core/mechanics/symbols.hpp"

namespace qdot {

/// Which symbols an expression may use; each kind includes the ones before it.
enum class Context {
  parameters,     ///< the parameters
  time,           ///< and t
  configuration,  ///< and coordinates, inputs, held lengths
  state,          ///< and velocities
  motion          ///< and multipliers of constraints
};

/// Whether texts have dimensions, or are numbers all of them.
enum class Dimensions { checked, none };

/// Reads texts into one graph and collects what is wrong with them.
class SceneText {
 public:
  /// `exponents`: parameters to be put in where they are exponents; `followers` wherever they are.
  SceneText(Graph& graph, std::vector<Diagnostic>& diagnostics, Dimensions dimensions,
            const ExponentValues& exponents, const Followers& followers)
      : graph_(graph),
        diagnostics_(diagnostics),
        dimensions_kind_(dimensions),
        exponents_(exponents),
        followers_(followers) {}

  void complain(const std::string& place, const std::string& code, const std::string& message);
  [[nodiscard]] bool has_complaint(const std::string& place) const;
  /// There, or at a place inside it.
  [[nodiscard]] bool has_complaint_below(const std::string& place) const;

  /// A new symbol that expressions of `context` and later ones may use. No dimension: it is unknown.
  Expression declare(const std::string& name, const std::optional<Dimension>& dimension, Context context,
                     const std::string& place);

  /// x, x_dot and x_ddot.
  void declare_varying(Symbols::Varying& varying, const std::string& name,
                       const std::optional<Dimension>& dimension, Context value, Context rate,
                       const std::string& place);

  /// The dimension of a coherent SI unit; complains about any other. Of a scene without units, none: rad may
  /// still say that a coordinate is an angle.
  std::optional<Dimension> unit(const std::string& text, const std::string& place);

  /// The expression, or 0 with a complaint. Nothing expected: any dimension that is consistent in itself. A
  /// plain number is taken as a number of SI units.
  Expression read(const std::string& text, Context context, const std::string& place,
                  const std::optional<Dimension>& expected);
  std::optional<Expression> read_optional(const std::string& text, Context context, const std::string& place,
                                          const std::optional<Dimension>& expected);

  /// 2 components, or 3: as many as in all vectors of the scene.
  Vector read_vector(const std::vector<std::string>& components, Context context, const std::string& place,
                     const std::optional<Dimension>& dimension);
  [[nodiscard]] Vector zero_vector() const;

  /// A place that positions may name.
  void declare_point(const std::string& name, const Vector& components) {
    points_.emplace_back(name, components);
  }
  Vector read_position(const Position& position, const std::string& place);

  /// Its domain has no other values.
  void declare_positive(const std::string& name) { exponent_symbols_.positive.insert(name); }
  [[nodiscard]] const FoundExponents& exponents() const { return found_exponents_; }

  /// No value: any fits, or there is a mistake.
  [[nodiscard]] std::optional<Dimension> dimension(const Expression& e) const {
    return dimension_of(e, dimensions_).dimension;
  }

  [[nodiscard]] std::optional<Dimension> dimension_of_symbol(const Expression& symbol) const {
    const auto found = dimensions_.find(symbol.id());
    return found == dimensions_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  [[nodiscard]] Expression with_followers(const Expression& e);
  void check_dimension(const Expression& e, const std::string& place,
                       const std::optional<Dimension>& expected);

  Graph& graph_;
  std::vector<Diagnostic>& diagnostics_;
  Dimensions dimensions_kind_;
  ExponentValues exponents_;
  Followers followers_;
  std::vector<Replacement> following_;  ///< made when it is first wanted
  ExponentSymbols exponent_symbols_;
  FoundExponents found_exponents_;
  std::set<std::string> declared_;
  std::vector<std::string> allowed_[5];
  SymbolDimensions dimensions_;
  std::vector<std::pair<std::string, Vector>> points_;
  std::size_t space_{0};
};

/// The dimension of a unit's name; no value where it is unknown.
[[nodiscard]] std::optional<Dimension> dimension_of_unit(const std::string& text);

}  // namespace qdot
