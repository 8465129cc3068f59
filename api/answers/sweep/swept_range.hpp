#pragma once
// One variable of a sweep, read: the values of a grid, or the law that a sample draws from.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "api/contract/field.hpp"
#include "api/contract/field_values.hpp"
#include "api/contract/submission.hpp"
#include "api/contract/written_value.hpp"
#include "core/numerics/real.hpp"

namespace qdot::api {

struct SweepVariable {
  std::string name{};
  SymbolRole role{};  ///< parameter or initial
  std::string unit{};
};

/// One variable as it was given, with where its parts stand.
struct GivenVariable {
  std::string name;
  Json parts;
  bool is_flat;  ///< its parts stand in the request itself
};

/// What one variable runs over: values, each computed where it is asked for, or a law that a sample draws
/// from.
struct SweptRange {
  SweepVariable variable;
  std::function<double(std::size_t)> value{};  ///< of a grid or a list: value i
  std::size_t count{};
  enum class Law { none, uniform, normal } law{Law::none};
  double first{}, second{};
  Json echo{};
};

/// What is said of one variable: from, to and count, values, or a law that a sample draws from.
[[nodiscard]] const FieldSet& parts_of_variable();

class VariableReader {
 public:
  /// `whole` is the place of the request, `asked` the fields of the question that is asked.
  VariableReader(const Scene& scene, const FieldSet& asked, const Place& whole, std::int64_t most_rows,
                 ParameterScope& scope, Errors& errors)
      : scene_(scene),
        asked_(asked),
        whole_(whole),
        vary_(whole.below("vary")),
        most_rows_(most_rows),
        scope_(scope),
        errors_(errors) {}

  /// None after errors were reported.
  [[nodiscard]] std::optional<SweptRange> read(const GivenVariable& given);
  void refuse_rows(const Place& place);
  /// How a value was understood that could be meant otherwise.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  Json resolved_parts(const GivenVariable& given, const Place& place);
  std::optional<SweepVariable> variable_called(const std::string& name, const Place& place);
  Real number(const Json& value, const SweepVariable& variable, const Place& place);
  [[nodiscard]] bool is_what_its_double_says(const Real& number, const SweepVariable& variable);
  void fill(const Json& parts, const Place& place, SweptRange& range);
  void fill_values(const Json& values, const Place& place, SweptRange& range);
  void fill_law(SweptRange::Law law, const Json& pair, const Place& place, SweptRange& range);
  void fill_grid(const Json& parts, const Place& place, SweptRange& range);

  const Scene& scene_;
  const FieldSet& asked_;
  const Place& whole_;
  Place vary_;
  std::int64_t most_rows_;
  ParameterScope& scope_;
  Errors& errors_;
  std::vector<std::string> notes_;
  bool has_noted_meaning_{false}, has_noted_rounding_{false};
};

}  // namespace qdot::api
