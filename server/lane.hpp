#pragma once
// The lanes of work, and how threads of heavy work stay behind light ones (lanes.hpp decides who computes).

#include <array>

namespace qdot::server {

/// Of the threads of heavy and lengthy work: beside a light one such a thread gets about a tenth of a core,
/// alone all of it.
inline constexpr int heavy_niceness = 10;

/// Of this thread, to theirs. On Linux each thread has its own.
void lower_priority();

enum class Lane { light, heavy, lengthy };
inline constexpr std::array all_lanes{Lane::light, Lane::heavy, Lane::lengthy};

}  // namespace qdot::server
