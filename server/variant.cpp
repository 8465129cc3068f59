#include "server/variant.hpp"

#include <iostream>
#include <variant>

#include "api/service.hpp"
#include "server/output.hpp"
#include "server/words.hpp"

namespace qdot::server {

ExitCode print_variant(const VariantOptions& options) {
  const api::Service service({.scenes_directory = options.scenes});
  const auto layout = options.pretty ? api::Layout::pretty : api::Layout::compact;
  const auto drawn = service.variant(request_body(options.key), options.seed, layout);
  if (const auto* error = std::get_if<api::SheetError>(&drawn)) {
    std::cerr << "qdot variant: " << error->text << "\n";
    return ExitCode::invalid_request;
  }
  write_out(std::cout, std::get<std::string>(drawn));
  return ExitCode::ok;
}

}  // namespace qdot::server
