#pragma once

namespace qdot::api {

/// How JSON is laid out: `?pretty` asks for indentation.
enum class Layout { compact, pretty };

}  // namespace qdot::api
