#pragma once
// Of several formulas for one number the shortest, as the sheet would print it.

#include <optional>
#include <utility>
#include <vector>

#include "core/closed/closed_form.hpp"

namespace qdot {

/// Keeps the shortest of the formulas that agree with a number, and the relations that it uses.
class BestForm {
 public:
  BestForm(const ExactValues& values, std::vector<Expression> allowed)
      : values_(values), allowed_(std::move(allowed)) {}

  /// Whether it is the best so far.
  bool consider(const Expression& e, const Relations& relations) {
    if (length_ && *length_ <= written_length(e)) return false;
    auto form = closed_form(values_, e, relations, allowed_);
    if (!form) return false;
    length_ = written_length(e);
    form_ = std::move(form);
    chosen_ = {e, relations};
    return true;
  }
  [[nodiscard]] const std::optional<ClosedForm>& form() const { return form_; }
  /// What was kept; only where there is a form.
  [[nodiscard]] const std::pair<Expression, Relations>& chosen() const { return chosen_; }

 private:
  const ExactValues& values_;
  std::vector<Expression> allowed_;
  std::optional<std::size_t> length_;
  std::optional<ClosedForm> form_;
  std::pair<Expression, Relations> chosen_;
};

}  // namespace qdot
