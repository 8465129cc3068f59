#pragma once
// Domains in text: one bound or two, "> 0" or ">= 0, < 1".

#include <optional>
#include <string>
#include <string_view>

#include "core/mechanics/scene.hpp"

namespace qdot::api {

/// No value for a text that is no domain, has two bounds on one side, or leaves no number.
[[nodiscard]] std::optional<Domain> parse_domain(std::string_view text);

/// What every domain's text matches, as a regular expression of ECMAScript. Some that match leave no number.
[[nodiscard]] std::string domain_pattern();

/// "> 0 and <= 1"; empty where every number is allowed.
[[nodiscard]] std::string to_text(const Domain& domain);

}  // namespace qdot::api
