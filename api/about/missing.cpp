#include "api/about/missing.hpp"

#include <vector>

#include "api/about/documents.hpp"
#include "api/about/signposts.hpp"
#include "api/http/dispatch.hpp"
#include "api/http/problem.hpp"
#include "api/json/text.hpp"

namespace qdot::api {

Response not_found(const Call& call, const std::string& what, const std::string& meant,
                   const std::string& rest) {
  Problem problem{.kind = ProblemKind::not_found, .detail = what + "; " + rest};
  if (!meant.empty()) {
    problem.detail = what + "; did you mean " + meant + "? " + rest;
    problem.members = {{"did_you_mean", meant}};
  }
  static const std::vector<std::string> offers{"application/problem+json", "application/json", "text/html"};
  const std::string* accepted = negotiated(header(call.request, "accept"), offers);
  if (accepted == nullptr || *accepted != "text/html")
    return to_response(problem, call.target.path, call.layout);
  Response page = problem_page(problem_type(ProblemKind::not_found), problem.detail);
  page.status = 404;
  page.headers["Vary"] = "Accept";
  restrict_page(page);
  return page;
}

Response redirected_or_not_found(const Call& call, const Routes& routes, const Catalogue& catalogue) {
  const Signpost signpost = signpost_for(call.target.path, routes, catalogue);
  const bool is_elsewhere = signpost.address != call.target.path;
  if (signpost.is_same && is_elsewhere) return moved_to(signpost.address, call);
  return not_found(call, "There is nothing at " + in_quotes(call.target.path),
                   is_elsewhere ? signpost.address : "", "/ lists what there is.");
}

}  // namespace qdot::api
