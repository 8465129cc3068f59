#pragma once
// A model with its inputs, and the functions that questions about it have in common: each made when it is
// first asked for, kept, and shared by threads. A thread waits for another only where both want the same
// function (core/base/made_once.hpp), so that a short question is not held up by a long one.
//
// How the functions are made: motion_functions.hpp, specialization.hpp, statics.hpp, canonical_functions.hpp.

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/made_once.hpp"
#include "core/dynamics/canonical_functions.hpp"
#include "core/dynamics/columns.hpp"
#include "core/dynamics/constraint_surface.hpp"
#include "core/dynamics/kink_functions.hpp"
#include "core/dynamics/motion_functions.hpp"
#include "core/dynamics/specialization.hpp"

namespace qdot {

class Dynamics {
 public:
  /// Throws Error(syntax | unknown_symbol | too_large) for an input that does not parse.
  /// `exponents`: parameters that are put in where they are exponents in events that are typed.
  explicit Dynamics(std::shared_ptr<const Model> model, InputTexts inputs = {},
                    ExponentValues exponents = {});

  [[nodiscard]] const Model& model() const { return *model_; }
  [[nodiscard]] std::shared_ptr<const Model> shared_model() const { return model_; }

  /// q'' (n outputs), from M q'' = f.
  [[nodiscard]] const CompiledFunction& accelerations() const;
  /// d(q', q'')/d(q, q'), 2n x 2n by rows.
  [[nodiscard]] const CompiledFunction& jacobian() const;
  /// The kinks in the equations of motion; null where there are none.
  [[nodiscard]] const Kinks* kinks() const;
  /// The motion on their sides, staying on some of them; null where it cannot.
  [[nodiscard]] std::shared_ptr<const KinkedMotion> kinked(const Staying& staying) const;
  /// The same as jacobian().
  [[nodiscard]] const CompiledFunction& kinked_jacobian(const Staying& staying) const;
  /// The equations of first order in (q, p); null where L is not quadratic in the velocities, and
  /// with constraints.
  [[nodiscard]] const CanonicalFunctions* canonical() const;
  /// What states have to obey; null without constraints.
  [[nodiscard]] const ConstraintSurface* constraint_surface() const;
  /// The values of columns, which belong to the model's graph; `staying` as in motion_functions.hpp.
  [[nodiscard]] std::shared_ptr<const CompiledFunction> columns(const std::vector<Column>& columns,
                                                                const Staying* staying = nullptr) const;

  /// A column as compiled_by_accelerations makes it; null where that is none.
  [[nodiscard]] std::shared_ptr<const CompiledFunction> by_accelerations(const Expression& column) const;

  /// The conserved quantities; which there are depends on the parameters that are 0.
  [[nodiscard]] std::shared_ptr<const Conserved> conserved(const Reals& parameters) const;
  /// What symmetries of several coordinates keep beside these, searched for when it is first asked for.
  [[nodiscard]] std::shared_ptr<const Conserved> found(const Reals& parameters) const;
  /// Functions for questions that need no motion; they depend on the parameters that are 0. Throws
  /// Error(not_applicable) where the time enters the equations, and with constraints.
  [[nodiscard]] std::shared_ptr<const Statics> statics(const Reals& parameters) const;
  /// What `make` derives from the statics for one purpose,
  /// made once for each key and each set of vanishing parameters.
  template <class T, class Make>
  [[nodiscard]] std::shared_ptr<const T> derived(const std::string& key, const Reals& parameters,
                                                 const Make& make) const {
    const std::shared_ptr<const Statics> from = statics(parameters);
    return std::static_pointer_cast<const T>(
        derived_.get({key, from.get()}, [&] { return std::make_shared<const T>(make(*from)); }));
  }

  /// As compiled_event; made for the caller and not kept.
  [[nodiscard]] CompiledEvent event(const std::string& text, const Staying* staying = nullptr) const;
  /// As compiled_along_motion; made for the caller and not kept.
  [[nodiscard]] CompiledFunction compiled(const Graph& graph, std::span<const Expression> expressions) const;

 private:
  using Only = std::monostate;  ///< the key of what there is one of

  std::shared_ptr<const Model> model_;
  InputTexts inputs_;
  ExponentValues exponents_;
  mutable MadeOnce<Only, CompiledFunction> accelerations_, jacobian_;
  mutable MadeOnce<Only, std::unique_ptr<const CanonicalFunctions>> canonical_;
  mutable MadeOnce<Only, std::unique_ptr<const Kinks>> kinks_;
  mutable MadeOnce<Only, std::unique_ptr<const ConstraintSurface>> constraint_surface_;
  mutable MadeOnce<Staying, std::shared_ptr<const KinkedMotion>> kinked_;
  mutable MadeOnce<Staying, CompiledFunction> kinked_jacobian_;
  using ColumnsKey = std::pair<std::vector<NodeId>, std::optional<Staying>>;
  mutable MadeOnce<ColumnsKey, std::shared_ptr<const CompiledFunction>> columns_;
  mutable MadeOnce<NodeId, std::shared_ptr<const CompiledFunction>> by_accelerations_;
  mutable MadeOnce<Vanishing, std::shared_ptr<const Conserved>> conserved_, found_;
  mutable MadeOnce<Vanishing, std::shared_ptr<const Statics>> statics_;
  mutable MadeOnce<std::pair<std::string, const Statics*>, std::shared_ptr<const void>> derived_;
};

/// The columns' values at one state. Throws Error(invalid_state) where one of them has none.
[[nodiscard]] std::vector<double> values_at(const Dynamics& dynamics, const std::vector<Column>& columns,
                                            std::span<const double> parameters, double t,
                                            std::span<const double> y);

/// The same where their function is there.
[[nodiscard]] std::vector<double> values_at(const CompiledFunction& function,
                                            const std::vector<Column>& columns,
                                            std::span<const double> parameters, double t,
                                            std::span<const double> y);

}  // namespace qdot
