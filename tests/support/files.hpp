#pragma once
// JSON files of the project, by their path inside it.

#include <fstream>
#include <stdexcept>
#include <string>

#include "api/json/json.hpp"

namespace qdot::test {

inline api::Json json_file(const std::string& path) {
  std::ifstream file(QDOT_SOURCE_DIR "/" + path);
  if (!file) throw std::runtime_error("cannot read " + path);
  return api::Json::parse(file);
}

}  // namespace qdot::test
