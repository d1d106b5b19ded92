#pragma once
// Symbol visibility: the shared library exports only declarations with DEFOCUS_API.

#if defined(__GNUC__)
#define DEFOCUS_API __attribute__((visibility("default")))
#define DEFOCUS_HIDDEN __attribute__((visibility("hidden")))
#else
#define DEFOCUS_API
#define DEFOCUS_HIDDEN
#endif
