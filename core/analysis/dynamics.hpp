#pragma once
// The compiled functions of a model, its inputs replaced by functions of time.
//
// Every function has the parameters bound first and then t and the state y = (q, q'). Functions are compiled on
// first use; a Dynamics is shared by threads.

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/mechanics/model.hpp"

namespace qdot {

/// A quantity along a motion: one column.
struct Column {
  std::string name;
  std::string unit;
  Expression value;  ///< in t, q, q', q'', the parameters and inputs
};

class Dynamics {
 public:
  /// `inputs`: for each input of the scene an expression in t and the parameters; empty texts mean the default.
  /// Throws Error(syntax | unknown_symbol | too_large).
  explicit Dynamics(std::shared_ptr<const Model> model, const std::vector<std::string>& inputs = {});

  [[nodiscard]] const Model& model() const { return *model_; }

  /// q'' (n outputs), from M q'' = f.
  [[nodiscard]] const CompiledFunction& accelerations() const;
  /// d(q', q'')/d(q, q'), 2n x 2n by rows: the last n rows solve M dq''/dy = df/dy - dM/dy q''.
  [[nodiscard]] const CompiledFunction& jacobian() const;

  /// The values of columns (which belong to the model's graph).
  [[nodiscard]] std::shared_ptr<const CompiledFunction> columns(const std::vector<Column>& columns) const;
  /// The values of expressions written by a user in t, q, q' and the parameters. Not kept.
  [[nodiscard]] CompiledFunction compile(const std::vector<std::string>& expressions) const;

 private:
  class Builder;
  struct Lazy {
    std::mutex mutex;
    std::unique_ptr<const CompiledFunction> accelerations, jacobian;
    std::map<std::vector<NodeId>, std::shared_ptr<const CompiledFunction>> columns;
  };

  std::shared_ptr<const Model> model_;
  std::vector<std::string> inputs_;
  std::unique_ptr<Lazy> lazy_;
};

/// Columns of the contract's `include` groups.
[[nodiscard]] std::vector<Column> energy_columns(const Model& model);
[[nodiscard]] std::vector<Column> momentum_columns(const Model& model);
[[nodiscard]] std::vector<Column> position_columns(const Model& model);
[[nodiscard]] std::vector<Column> acceleration_columns(const Model& model);
[[nodiscard]] std::vector<Column> validity_columns(const Model& model);

}  // namespace qdot
