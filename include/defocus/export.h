#pragma once
// What the shared library shows of itself: nothing but what these headers declare.

#if defined(__GNUC__)
#define DEFOCUS_API __attribute__((visibility("default")))
#define DEFOCUS_HIDDEN __attribute__((visibility("hidden")))
#else
#define DEFOCUS_API
#define DEFOCUS_HIDDEN
#endif
