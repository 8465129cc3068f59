#pragma once
// From expressions to a tape. Shared nodes are computed once, what depends on parameters alone goes to the
// prologue, and a sum computes the products in its terms with it.

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/expr/linear.hpp"

namespace qdot {

class TapeBuilder {
 public:
  /// `parameters` are bound once, `t` and `variables` change with every evaluation.
  TapeBuilder(Graph& graph, std::span<const Expression> parameters, const Expression& t,
              std::span<const Expression> variables);

  /// Adds the solution x of M x = b, one column of unknowns a right-hand side. The first column's values can
  /// be used in later expressions through `unknowns` (symbols, n of them).
  struct LinearSystem {
    Matrix matrix;                          ///< n rows
    std::optional<Expression> determinant;  ///< for n = 2: a form of det M without cancellation
    std::vector<std::vector<Expression>> right_hand_sides;  ///< k columns of n
    std::vector<Expression> unknowns;
  };
  /// Slots of the solutions, k columns of n. Unknowns that no equation couples are solved for separately.
  std::vector<std::vector<Slot>> solve(const LinearSystem& system);

  [[nodiscard]] Slot slot(const Expression& e);
  [[nodiscard]] Slot literal(const Real& value);
  void output(const Expression& e) { function_.outputs_.push_back(slot(e)); }
  void output(Slot slot) { function_.outputs_.push_back(slot); }

  [[nodiscard]] CompiledFunction finish();

 private:
  struct Factors {
    Slot coefficient;           ///< literal or parameter part
    std::vector<Slot> varying;  ///< factors with positive exponents
  };

  [[nodiscard]] bool varies(NodeId id);
  [[nodiscard]] Slot emit(Instruction instruction, std::span<const Slot> operands, bool varying,
                          Slot count = 1);
  [[nodiscard]] Slot emitted(NodeId id);
  [[nodiscard]] Slot emitted_sum(NodeId id, const Sum& sum);
  [[nodiscard]] Slot emitted_product(NodeId id, const Product& product);
  [[nodiscard]] Slot emitted_power(NodeId id, const Power& power);
  [[nodiscard]] Slot emitted_call(NodeId id, const Call& call);
  [[nodiscard]] std::optional<Factors> factors_of(NodeId id);
  [[nodiscard]] Slot whole_power(Slot base, int exponent, bool varying);
  [[nodiscard]] Slot product_of(Slot coefficient, std::vector<Slot> factors, bool varying);

  Graph& graph_;
  CompiledFunction function_;
  std::map<NodeId, Slot> slots_;
  std::map<NodeId, bool> varies_;
  std::map<Real, Slot> literals_;
};

}  // namespace qdot
