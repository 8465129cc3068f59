#pragma once
// A name that a request can give a value to, with what a message about a wrong value says: the unit and the
// domain, so that the client learns what to write instead.

#include <string>
#include <string_view>

#include "core/mechanics/scene.hpp"

namespace qdot::api {

struct Symbol {
  std::string name;
  std::string unit;
  Domain domain;
  std::string_view meaning{};  ///< the scene's own words, which have to live as long
};

}  // namespace qdot::api
