#pragma once
// The compiled functions of a model, its inputs replaced by functions of time.
//
// Every function has the parameters bound first and then t and the state y = (q, q'). Functions are compiled
// on first use; a Dynamics is shared by threads.

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/dynamics/canonical_functions.hpp"
#include "core/dynamics/statics.hpp"
#include "core/mechanics/conserved.hpp"
#include "core/mechanics/model.hpp"

namespace qdot {

/// A quantity along a motion: one column.
struct Column {
  std::string name;
  std::string unit;
  Expression value;  ///< in t, q, q', q'', the parameters and inputs
};

/// An event as a compiled function: its zero, which way it is crossed, and optionally where a zero counts (>
/// 0).
struct CompiledEvent {
  CompiledFunction value;
  Crossing direction{Crossing::either};
  std::optional<CompiledFunction> when;
};

/// What stays constant along motions with given parameters.
struct Conserved {
  std::vector<ConservedQuantity> quantities;  ///< in a graph of their own
  std::shared_ptr<const CompiledFunction> values;
};

class Dynamics {
 public:
  /// `inputs`: for each input of the scene an expression in t and the parameters; empty texts mean the
  /// default. Throws Error(syntax | unknown_symbol | too_large).
  explicit Dynamics(std::shared_ptr<const Model> model, const std::vector<std::string>& inputs = {});

  [[nodiscard]] const Model& model() const { return *model_; }
  [[nodiscard]] std::shared_ptr<const Model> shared_model() const { return model_; }

  /// q'' (n outputs), from M q'' = f.
  [[nodiscard]] const CompiledFunction& accelerations() const;
  /// d(q', q'')/d(q, q'), 2n x 2n by rows: the last n rows solve M dq''/dy = df/dy - dM/dy q''.
  [[nodiscard]] const CompiledFunction& jacobian() const;

  /// The equations of first order in (q, p); null where L is not quadratic in the velocities.
  [[nodiscard]] const CanonicalFunctions* canonical() const;

  /// The values of columns, which belong to the model's graph.
  [[nodiscard]] std::shared_ptr<const CompiledFunction> columns(const std::vector<Column>& columns) const;
  /// The conserved quantities; which there are depends on the parameters that are 0.
  [[nodiscard]] std::shared_ptr<const Conserved> conserved(std::span<const double> parameters) const;
  /// Functions for questions that need no motion; they depend on the parameters that are 0. Throws
  /// Error(not_applicable) as derive_statics does.
  [[nodiscard]] std::shared_ptr<const Statics> statics(std::span<const double> parameters) const;

  /// What `make` derives from the statics for one purpose, made once for each key and each set of vanishing
  /// parameters, and kept. `make` asks nothing of this Dynamics.
  template <class T, class Make>
  [[nodiscard]] std::shared_ptr<const T> derived(const std::string& key, std::span<const double> parameters,
                                                 const Make& make) const {
    const std::shared_ptr<const Statics> from = statics(parameters);
    const std::lock_guard lock(lazy_->mutex);
    std::shared_ptr<const void>& slot = lazy_->derived[{key, from.get()}];
    if (!slot) slot = std::make_shared<const T>(make(*from));
    return std::static_pointer_cast<const T>(slot);
  }

  /// "theta = 0+": an expression in t, q, q' and the parameters, a value, and a last + or - for the
  /// direction; or the name of one of the scene's events. Throws Error(syntax | unknown_symbol | too_large).
  [[nodiscard]] CompiledEvent event(const std::string& text) const;
  /// Expressions of a copy of the model's graph, as they are along motions: q'' solved for, inputs replaced.
  [[nodiscard]] CompiledFunction compiled(const Graph& graph, std::span<const Expression> expressions) const;

 private:
  class Builder;
  struct Lazy {
    std::mutex mutex;
    std::unique_ptr<const CompiledFunction> accelerations, jacobian;
    std::optional<std::unique_ptr<const CanonicalFunctions>> canonical;
    std::map<std::vector<NodeId>, std::shared_ptr<const CompiledFunction>> columns;
    std::map<std::vector<bool>, std::shared_ptr<const Conserved>> conserved;
    std::map<std::vector<bool>, std::shared_ptr<const Statics>> statics;
    std::map<std::pair<std::string, const Statics*>, std::shared_ptr<const void>> derived;
  };

  /// The Lagrangian with vanishing parameters and the inputs replaced, in a graph of its own.
  [[nodiscard]] Lagrangian specialized(const std::vector<bool>& vanishing) const;
  [[nodiscard]] std::vector<Replacement> specialization(const std::vector<bool>& vanishing,
                                                        const Lagrangian& own) const;
  [[nodiscard]] Statics derived_statics(const std::vector<bool>& vanishing) const;
  [[nodiscard]] Conserved derived_conserved(const std::vector<bool>& vanishing) const;

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
/// What the scene reports beside its conditions.
[[nodiscard]] std::vector<Column> report_columns(const Model& model);

/// The columns' values at one state. Throws Error(invalid_state) where one of them has none.
[[nodiscard]] std::vector<double> values_at(const Dynamics& dynamics, const std::vector<Column>& columns,
                                            std::span<const double> parameters, double t,
                                            std::span<const double> y);

}  // namespace qdot
