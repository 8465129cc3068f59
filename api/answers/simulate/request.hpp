#pragma once
// /v1/simulate: a motion as columns, sampled at the instants that the request names.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/answers/endpoint.hpp"
#include "core/dynamics/watch.hpp"
#include "core/integrate/methods.hpp"

namespace qdot::api {

/// Columns beside t, the coordinates and the velocities.
enum class Extra {
  energy,
  kinetic_energy,
  potential_energy,
  momenta,
  positions,
  accelerations,
  multipliers,
  validity
};

/// Each promises an error over a column's largest magnitude.
enum class Preset { fast, balanced, accurate };

enum class Format { json, csv, ndjson };

/// Of numbers, all through the computation.
enum class Precision { double_precision, extended };

struct SimulateRequest {
  SystemChoice system{};
  double t_start{};
  std::optional<double> t_end{};
  std::optional<std::int64_t> samples{};
  std::optional<double> dt{};
  std::vector<double> times{};
  std::vector<Extra> include{};
  std::vector<std::string> events{};  ///< "theta=0+", not parsed yet
  OnInvalid on_invalid{OnInvalid::stop};
  bool impacts{true};
  std::optional<std::int64_t> steps{};  ///< impacts
  std::optional<double> h{};            ///< the step of a method that does not choose its own
  double rtol{};
  double atol{};
  std::optional<Preset> accuracy{};
  std::optional<double> max_error{};
  std::optional<std::int64_t> max_evaluations{};
  Method method{methods().front().method};
  bool verify{true};
  std::optional<Precision> precision{};
  std::optional<int> digits{};
  std::optional<Format> format{};  ///< none: what the Accept header says

  [[nodiscard]] bool is_extended() const { return precision == Precision::extended; }

  Real start{};  ///< t_start as it was typed
  /// The instants to answer at, from the fields above; empty where the last of `steps` impacts ends the
  /// motion.
  Reals grid{};
};

[[nodiscard]] const RequestTable<SimulateRequest>& simulate_table();

[[nodiscard]] Endpoint simulate_endpoint();

/// How many columns an answer with these extras has, t included.
[[nodiscard]] std::int64_t column_count(const Scene& scene, const std::vector<Extra>& include);

}  // namespace qdot::api
