#pragma once
// Standard streams that a program was started without, as by `<&- >&- 2>&-`.

namespace qdot::server {

/// Nothing that is opened later gets the number of one: a message would be written into a file of answers, or
/// a log to a client. To read and to write them fails as before, and is told. Call it before any file is
/// opened.
void keep_closed_standard_streams();

}  // namespace qdot::server
