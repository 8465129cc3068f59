#pragma once

#include <string>
#include <string_view>

#include "core/mechanics/scene.hpp"

namespace qdot::api {

/// One name that a request can give a value to.
struct Symbol {
  std::string name;
  std::string unit;
  Domain domain;
  std::string_view meaning{};  ///< the scene's own words, which have to live as long
};

}  // namespace qdot::api
