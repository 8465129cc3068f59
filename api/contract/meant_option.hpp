#pragma once
// "Did you mean" for the words of a choice.

#include <string>
#include <string_view>
#include <vector>

namespace qdot::api {

/// The option that a word means, by its spelling or by what others call it; empty where it means none.
[[nodiscard]] std::string meant_option(const std::string& word, const std::vector<std::string>& options);

/// "energy;momenta" as "energy,momenta"; empty where that is no list of options.
[[nodiscard]] std::string with_commas(std::string_view words, const std::vector<std::string>& options);

}  // namespace qdot::api
