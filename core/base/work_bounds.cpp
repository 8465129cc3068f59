#include "core/base/work_bounds.hpp"

#include <utility>

namespace qdot {
namespace {

thread_local WorkBounds bounds_in_force = WorkBounds::of_a_service;

}  // namespace

WorkBoundsScope::WorkBoundsScope(WorkBounds bounds) : outer_(std::exchange(bounds_in_force, bounds)) {}

WorkBoundsScope::~WorkBoundsScope() { bounds_in_force = outer_; }

WorkBounds work_bounds() { return bounds_in_force; }

}  // namespace qdot
