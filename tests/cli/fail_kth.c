// SPDX-License-Identifier: MIT
// Loaded before the C library (LD_PRELOAD): the call number ABBE_FAIL_AT, from 1, of ABBE_FAIL_KIND (memory, write, sync or
// thread) fails, and no other does.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

static atomic_long left;
static char kind;

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);

__attribute__((constructor)) static void begin(void) {
  char const *which = getenv("ABBE_FAIL_KIND"), *at = getenv("ABBE_FAIL_AT");
  if (which == NULL || at == NULL) return;
  left = atol(at);
  kind = which[0];
}

static int fails(char of, int error) {
  if (kind != of || atomic_fetch_sub(&left, 1) != 1) return 0;
  errno = error;
  return 1;
}

void* malloc(size_t size) { return fails('m', ENOMEM) ? NULL : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return fails('m', ENOMEM) ? NULL : __libc_calloc(count, size); }
void* realloc(void* old, size_t size) { return fails('m', ENOMEM) ? NULL : __libc_realloc(old, size); }
void* memalign(size_t to, size_t size) { return fails('m', ENOMEM) ? NULL : __libc_memalign(to, size); }
void* aligned_alloc(size_t to, size_t size) { return memalign(to, size); }
int posix_memalign(void** out, size_t to, size_t size) {
  void* const got = memalign(to, size);
  if (got == NULL) return ENOMEM;
  *out = got;
  return 0;
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
ssize_t write(int file, void const* from, size_t size) {
  return fails('w', ENOSPC) ? -1 : NEXT(write)(file, from, size);
}
ssize_t pwrite(int file, void const* from, size_t size, off_t at) {
  return fails('w', ENOSPC) ? -1 : NEXT(pwrite)(file, from, size, at);
}
ssize_t pwrite64(int file, void const* from, size_t size, off64_t at) {
  return fails('w', ENOSPC) ? -1 : NEXT(pwrite64)(file, from, size, at);
}
int fsync(int file) { return fails('s', EIO) ? -1 : NEXT(fsync)(file); }
int pthread_create(pthread_t* thread, pthread_attr_t const* how, void* (*run)(void*), void* with) {
  return fails('t', 0) ? EAGAIN : NEXT(pthread_create)(thread, how, run, with);
}
