#pragma once
// A terminal event that a run nearly meets, or has met and nearly missed (approaches.hpp).

#include <cstddef>
#include <optional>
#include <vector>

namespace qdot {

struct Approach {
  static constexpr unsigned order = 5;
  std::size_t event{};          ///< index into RunRequest::events
  double t{};                   ///< where it turns back
  std::optional<double> met{};  ///< when it was met
  int sign{};                   ///< of g before the event
  double h{};                   ///< of the step that it was seen in
  /// What is near to zero is not g, which has met zero at t, but whether that counts: below zero it does not.
  bool is_condition{};
  bool is_hidden{};  ///< what it does there is hidden by rounding, and may be more than this place shows
  /// Of what is near to zero.
  double distance{};
  /// The motion as it was before the event, around t: coefficients of y_i(t + s), row by row.
  std::vector<double> rows{};
  /// Of a run that is compared with an original: as Run::apart and Run::unseen, where the step ends.
  std::vector<double> apart{}, unseen{};
  /// Others of the same event, no nearer to it, lie in this time; `apart` and `unseen` are of all.
  struct Others {
    double from{}, to{};
  };
  std::optional<Others> others{};

  [[nodiscard]] double instant() const { return met.value_or(t); }
  /// The rows around another t, s later.
  void shift(double s);
  [[nodiscard]] std::vector<double> state_at(double s) const;
  /// Stands for another one, too, by the nearer of both.
  void take_in(Approach other);
};

/// Makes them fewer: each but those that were met stands for the next one of its event, too.
void take_together(std::vector<Approach>& approaches);

}  // namespace qdot
