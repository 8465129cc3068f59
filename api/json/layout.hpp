#pragma once
// How JSON is laid out: in one line, as programs want it, or indented, for people, where the address has
// `?pretty`.

namespace qdot::api {

enum class Layout { compact, pretty };

}  // namespace qdot::api
