// SPDX-License-Identifier: MIT
#include "base/give_back.hpp"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace abbe {

void give_back_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

} // namespace abbe
