#pragma once
// The kinds of bodies. Each is one record in bodies.cpp: what it is called in JSON, its fields, and the
// struct of core/mechanics/scene.hpp that takes them, for which core has the kinetic energy. Every shape of
// core/mechanics/shapes.hpp is a kind.

#include <functional>
#include <vector>

#include "api/contract/field.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

struct BodyKind {
  FieldSet fields;                               ///< its name is the kind's
  std::function<Body(const Json&)> from_fields;  ///< the body that has what was read by `fields`
};

[[nodiscard]] const std::vector<BodyKind>& body_kinds();

}  // namespace qdot::api
