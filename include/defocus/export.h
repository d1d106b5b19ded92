#pragma once
// What the shared library shows of itself: nothing but what these headers declare.

#if defined(__GNUC__)
#define DEFOCUS_API __attribute__((visibility("default")))
#else
#define DEFOCUS_API
#endif
