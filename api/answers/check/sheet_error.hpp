#pragma once

#include <string>

namespace qdot::api {

/// What is wrong with a key or with answers to it: one sentence.
struct SheetError {
  std::string text;
};

}  // namespace qdot::api
