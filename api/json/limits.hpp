#pragma once
// What a request may cost, in one place; GET /v1/limits shows this table.

#include <cstddef>
#include <cstdint>

namespace qdot::api::limits {

// The JSON door.
inline constexpr std::size_t body_bytes = 64 * 1024;
inline constexpr std::size_t large_body_bytes = 1024 * 1024;  ///< batch, and check with trajectories
inline constexpr std::size_t json_depth = 16;
inline constexpr std::size_t json_nodes = 20'000;
inline constexpr std::size_t answers_bytes = 64 * 1024 * 1024;  ///< a file of answers on the command line
inline constexpr std::size_t large_json_nodes = 200'000;

// Texts.
inline constexpr std::size_t name_bytes = 64;
inline constexpr std::size_t expression_bytes = 4 * 1024;
inline constexpr std::size_t quantity_bytes = 100;
inline constexpr std::size_t listed_errors = 50;

// Submissions that are graded.
inline constexpr std::size_t check_items = 200;
inline constexpr std::uint64_t check_algebra = 300'000;  ///< of one submission

// Many requests in one.
inline constexpr std::size_t id_bytes = 200;
inline constexpr std::size_t batch_lines = 1'000;
inline constexpr std::size_t batch_answer_bytes = 16 * 1024 * 1024;
/// Room for all numbers that may be asked for, in any form, where names have up to 30 letters.
inline constexpr std::size_t sweep_answer_bytes = 32 * 1024 * 1024;
inline constexpr std::int64_t sweep_rows = 10'000;
inline constexpr std::size_t sweep_variables = 8;
inline constexpr std::size_t sweep_columns = 50;

// Equations derived, and searches in them: products of terms, operations on intervals.
inline constexpr std::uint64_t algebra = 10'000'000;

// Trajectories.
inline constexpr std::int64_t rows = 100'000;
inline constexpr std::int64_t numbers = 1'000'000;  ///< rows times columns
inline constexpr std::size_t events = 20;
inline constexpr std::int64_t impacts = 10'000;
inline constexpr double largest_time = 1e9;

// Tolerances of one run.
inline constexpr double least_rtol = 1e-14;
inline constexpr double largest_rtol = 1e-2;
inline constexpr double least_error = 1e-14;
inline constexpr std::int64_t evaluations = 12'000'000;
inline constexpr double largest_atol = 1;

}  // namespace qdot::api::limits
