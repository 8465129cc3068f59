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
  static const RequestTable<GaitRequest> table({
      system_field<GaitRequest>(),
      parameters_field<GaitRequest>(),
      choice("gait", &GaitRequest::gait, {{"long", Gait::Kind::long_step}, {"short", Gait::Kind::short_step}},
             "which of two gaits, the one with the long or the short step time; without this field both",
             {.aliases = {"kind", "which"}}),
      digits_field<GaitRequest>(),
  });
  return table;
}

}  // namespace qdot::api
