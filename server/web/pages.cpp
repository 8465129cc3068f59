#include "server/web/pages.hpp"

namespace qdot::server::web {

std::vector<api::Page> pages() {
  const std::span<const api::EmbeddedFile> files = page_files();
  return {
      {"/", "text/html", api::text_of(files, "index.html")},
      {"/docs", "text/html", api::text_of(files, "docs.html")},
      {"/docs/docs.js", "text/javascript", api::text_of(files, "docs.js")},
      {"/docs/style.css", "text/css", api::text_of(files, "style.css")},
  };
}

}  // namespace qdot::server::web
