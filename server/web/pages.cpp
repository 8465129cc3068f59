#include "server/web/pages.hpp"

#include <array>
#include <string>

namespace qdot::server::web {
namespace {

struct Type {
  std::string_view ending;
  std::string_view content_type;
};
constexpr auto types = std::to_array<Type>(
    {{".html", "text/html"}, {".css", "text/css"}, {".svg", "image/svg+xml"}, {".js", "text/javascript"}});

std::string_view content_type_of(std::string_view name) {
  std::size_t i = 0;
  while (!name.ends_with(types[i].ending)) ++i;
  return types[i].content_type;
}

/// "/" is index.html and "/docs" is docs.html; the others are parts of them, "/page/main.js".
std::string address_of(std::string_view name) {
  if (name == "index.html") return "/";
  if (name.ends_with(".html")) return "/" + std::string(name.substr(0, name.size() - 5));
  return "/page/" + std::string(name);
}

}  // namespace

std::vector<api::Page> pages() {
  std::vector<api::Page> all;
  for (const api::EmbeddedFile& file : page_files()) {
    all.push_back({address_of(file.name), content_type_of(file.name), file.text});
  }
  return all;
}

}  // namespace qdot::server::web
