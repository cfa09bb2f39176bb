// Where the machine has 256-bit vectors they are used: chosen once when the program starts. (ThreadSanitizer cannot run
// such choices.)
#pragma once

#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__)
#define LUEUR_BEST_VECTORS __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define LUEUR_BEST_VECTORS
#endif

namespace lueur {

// Eight channels as one register (two, without 256-bit vectors). Written out, for the compiler would sum channel by
// channel in memory.
using Lanes [[gnu::vector_size(32), gnu::aligned(4), gnu::may_alias]] = float;

} // namespace lueur
