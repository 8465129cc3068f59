#include "api/answers/gait/request.hpp"

namespace qdot::api {

const char* name(Gait::Kind kind) {
  switch (kind) {
    case Gait::Kind::short_step:
      return "short";
    case Gait::Kind::long_step:
      return "long";
    case Gait::Kind::other:
      break;
  }
  return "other";
}

const RequestTable<GaitRequest>& gait_table() {
  using R = GaitRequest;
  static const RequestTable<R> table({
      system_field<R>(),
      parameters_field<R>(),
      choice("gait", &R::gait, {{"long", Gait::Kind::long_step}, {"short", Gait::Kind::short_step}},
             "which of two gaits, the one with the long or the short step time; without this field both",
             {.aliases = {"kind", "which"}}),
      digits_field<R>(),
  });
  return table;
}

}  // namespace qdot::api
