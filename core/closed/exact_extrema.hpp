#pragma once
// Turning points as roots of a linear or quadratic polynomial of the coordinate, of its cosine or of its
// sine.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/closed/closed_form.hpp"
#include "core/closed/turning_equation.hpp"

namespace qdot {

struct ExactExtremum {
  ClosedForm value;
  std::optional<ClosedForm> cosine, sine;
};

/// The shortest formulas of all equations that are considered, each held against the number that was found
/// and against other values of the parameters.
class ExactExtrema {
 public:
  /// Keeps the reference.
  explicit ExactExtrema(const TurningEquation& equation)
      : equation_(equation),
        is_angle_(equation.values.model().scene.coordinates[equation.found.coordinate].unit == "rad") {}

  /// The extrema that are roots of `left`, where their formulas are shorter.
  void consider(const Expression& left, const Relations& relations);
  /// Those at the place where the motion begins, or at its mirror image in 0 or pi/2.
  void consider_start(const Expression& left, const Relations& relations);

  /// Takes the shortest that hold wherever the signs do that they assume; after all was considered.
  void assume_signs();

  std::optional<ExactExtremum> maximum, minimum;

 private:
  using Found = std::optional<std::pair<Expression, ExactExtremum>>;
  enum class End { maximum, minimum };
  struct Kept {
    Expression x;
    ExactExtremum form;
    Relations relations;
  };

  void consider(End end, Function function, const Expression& root, const Expression& left,
                const Relations& relations);
  void consider_tilted(const Expression& left, const Relations& relations);
  /// Where it is a root of `left`.
  void keep(End end, Found found, const Expression& left, const Relations& relations);
  /// Whether that is possible.
  [[nodiscard]] bool assume_signs(End end, Kept& kept) const;
  [[nodiscard]] std::optional<ExactExtremum> shortest(End end);
  [[nodiscard]] const Finding& number_of(End end) const {
    return end == End::maximum ? equation_.found.maximum : equation_.found.minimum;
  }
  /// Values of the cosine or sine of an angle, or else of the coordinate, where `left` is a quadratic
  /// polynomial of it, or one times the factor that vanishes where the motion begins.
  [[nodiscard]] std::vector<Expression> roots_in(Function function, const Expression& left) const;
  /// Of c0 + c1 u + c2 u^2 that is left of `left` without that factor.
  [[nodiscard]] std::vector<Expression> roots_beside_start(std::vector<Expression> c,
                                                           const Expression& left) const;
  [[nodiscard]] std::vector<std::string> started() const;
  [[nodiscard]] Found number(const Expression& root, const Finding& extremum,
                             const Relations& relations) const;
  [[nodiscard]] Found angle(Function function, const Expression& root, const Finding& extremum,
                            const Relations& relations) const;
  /// Before acos(1/2): pi/3.
  void add_known(Function function, const Expression& value, std::vector<Expression>& principal) const;
  /// At other values of the parameters, too.
  [[nodiscard]] bool is_root(const Expression& x, const Expression& left, const Relations& relations) const;

  const TurningEquation& equation_;
  bool is_angle_;
  std::map<End, std::vector<Kept>> kept_;
};

}  // namespace qdot
