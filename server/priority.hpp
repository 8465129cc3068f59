#pragma once
// Who of the server's threads computes first where there are fewer processors than threads.
//
// The kernel's scheduler lets who computes go on for the rest of its slice, 3 ms usually, also where who
// wakes has a lower niceness. A thread that asks for short slices is let in at once when it wakes (EEVDF,
// Linux 6.12: include/uapi/linux/sched/types.h, sched_runtime); earlier kernels take no notice.

namespace qdot::server {

/// Of heavy work: beside a light one such a thread gets about a tenth of a core, alone all of it.
void give_way();
/// Of threads that wait for requests, or answer light ones.
void wake_at_once();

}  // namespace qdot::server
