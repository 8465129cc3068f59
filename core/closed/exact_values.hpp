#pragma once
// What a request says of its numbers, exactly: a parameter that is given by others, k = 2*m*g/l, and initial
// values as expressions of the parameters. Formulas are written with what such relations leave.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/closed/written_texts.hpp"
#include "core/expr/surd.hpp"
#include "core/mechanics/model.hpp"

namespace qdot {

/// A parameter and the expression of others that it is.
struct Relations {
  std::vector<Replacement> replacements;
  /// So that relations of the scene's own defaults can be told from those of a request.
  bool are_defaults{true};
};

class ExactValues {
 public:
  /// Expressions are made in `graph`, a copy of the model's. No relation speaks of the parameter number
  /// `unknown`, which is asked for.
  ExactValues(const Model& model, std::shared_ptr<Graph> graph, const WrittenTexts& written,
              const Reals& parameters, std::optional<std::size_t> unknown = std::nullopt);

  /// Values only, of expressions of any copy of the model's graph; nothing is read.
  ExactValues(const Model& model, const Reals& parameters);

  /// Whether what is written may give relations that the scene's defaults have not: an expression, or
  /// decimals in small proportions.
  [[nodiscard]] bool may_have_relations(const WrittenTexts& written) const;
  [[nodiscard]] const std::shared_ptr<Graph>& graph() const { return graph_; }
  /// As the request or the scene writes them.
  [[nodiscard]] const Relations& relations() const { return relations_; }
  /// These, and those that decimals satisfy in the scene's units of mass, length and time: k = 2*m*g/l for k
  /// = 19.62, m = l = 0.5 and g = 9.81. Small factors only.
  [[nodiscard]] const Relations& relations_by_scale() const { return by_scale_; }
  /// Only symbols of the scene's units of mass, length and time.
  [[nodiscard]] bool speaks_of_scales(const Expression& e) const;
  /// Coordinate i or its velocity, by the parameters; no value where nothing exact is known.
  [[nodiscard]] std::optional<Expression> coordinate(std::size_t i) const;
  [[nodiscard]] std::optional<Expression> velocity(std::size_t i) const;
  /// The sign where the symbols have their values: -1, 1, or 0 where it is not known. A formula made with it
  /// holds for other values with the same answers to all that was asked.
  [[nodiscard]] int sign(const Expression& e) const;
  [[nodiscard]] int sign(const Polynomial& a) const { return sign(to_expression(*graph_, a)); }
  using Signs = std::vector<std::pair<Expression, int>>;
  [[nodiscard]] const Signs& asked() const { return asked_; }
  [[nodiscard]] bool gives(const Signs& answers) const;
  [[nodiscard]] SignOf sign_of() const {
    return [this](const Polynomial& a) { return sign(a); };
  }
  /// Gives a symbol that is no parameter a value.
  void set(const Expression& symbol, const Real& value) { values_.emplace_back(symbol, value); }
  /// Enclosed, where the symbols have their values.
  [[nodiscard]] Real value(const Expression& e) const;
  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const Reals& parameters() const { return parameters_; }
  /// Exactly, by number.
  [[nodiscard]] bool is_zero(std::size_t parameter) const { return parameters_.exact(parameter) == Real(0); }
  [[nodiscard]] const std::vector<Expression>& symbols() const { return symbols_; }

 private:
  [[nodiscard]] std::optional<Expression> read(const std::string& name, const Expression& by_default) const;
  void find_relations(std::optional<std::size_t> unknown);
  void find_scaled_relations();
  [[nodiscard]] std::optional<Number> factor_of(const Expression& parameter, const Expression& unit) const;

  const Model& model_;
  std::shared_ptr<Graph> graph_;
  WrittenTexts written_;
  Reals parameters_;
  std::vector<Expression> symbols_;
  std::vector<Replacement> numbers_;  ///< of the parameters that are written as such
  std::vector<RealAssignment> values_;
  Relations relations_, by_scale_;
  mutable Signs asked_;
};

}  // namespace qdot
