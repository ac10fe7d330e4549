// Invariants of the program itself (not of its input). Always on; cheap enough to stay on.
#pragma once

#include <cstdio>
#include <cstdlib>

#define OCTOLUX_CHECK(condition)                                                           \
  do {                                                                                     \
    if (!(condition)) {                                                                    \
      std::fprintf(stderr, "%s:%d: internal error: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                        \
    }                                                                                      \
  } while (false)
