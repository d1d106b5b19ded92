#pragma once
// What the allocator keeps of freed memory for later.

namespace defocus {

// Gives it back to the system, where the C library can (glibc; elsewhere nothing happens). Worth its time (a few
// milliseconds) after freeing tens of megabytes that no one asks for again soon.
void giveBackFreedMemory();

}  // namespace defocus
