#include "api/gait_request.hpp"

namespace qdot::api {

const RequestTable<GaitRequest>& gait_table() {
  using R = GaitRequest;
  static const RequestTable<R> table({
      system_field<R>(),
      parameters_field<R>(),
      choice("gait", &R::gait, {{"long", Gait::Kind::long_step}, {"short", Gait::Kind::short_step}},
             "which one of two gaits, by its step time; both without it", {.aliases = {"kind", "which"}}),
      integer("digits", &R::digits, {1, 17}, "significant digits of the answer's numbers; all without it",
              {.aliases = {"precision", "significant_digits"}}),
  });
  return table;
}

}  // namespace qdot::api
