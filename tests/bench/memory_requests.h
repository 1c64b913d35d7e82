// Counts every request for memory that a thread makes; glibc's own functions do the work. To be included by exactly one
// file of a program, and not under a sanitizer, which has its own.
#pragma once

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#define STILLHOOK_COUNTS_MEMORY 1
#include <cstddef>

namespace stillhook {
/// Requests of the calling thread since it began.
inline thread_local long memory_requests = 0;
}  // namespace stillhook

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++stillhook::memory_requests;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++stillhook::memory_requests;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++stillhook::memory_requests;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++stillhook::memory_requests;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  ++stillhook::memory_requests;
  *out = __libc_memalign(alignment, size);
  return *out == nullptr ? 12 : 0;  // ENOMEM
}
}
#endif
