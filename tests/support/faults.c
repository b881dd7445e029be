// SPDX-License-Identifier: BSD-3-Clause
// Calls of the system that fail, and signals at a known moment. Loaded into a tool by
// LD_PRELOAD; UVOL_FAULTS lists what to do, between commas:
//   nameless     there are no files without a name, as on some file systems
//   CALL:N       the N-th call of CALL fails; with N+ that one and all that follow
//   CALL:N:S     signal S arrives at the N-th call of CALL
//   count=FILE   at the end the number of calls of each kind is written to FILE
// CALL is one of those below. Calls are counted while main runs: what is loaded before,
// and what dlopen() loads, is not a tool's.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

enum Call { READ, WRITE, OPEN, MMAP, MALLOC, RENAME, FSYNC, LINKAT, CALLS };

static struct {
  const char* name;
  int error;                  // of a call that fails
  long fail_first, fail_last; // 0: none
  long signal_at;             // 0: never
  int signal;
  atomic_long calls;
} kinds[CALLS] = {[READ] = {"read", EIO},
                  [WRITE] = {"write", ENOSPC},
                  [OPEN] = {"open", EMFILE},
                  [MMAP] = {"mmap", ENOMEM},
                  [MALLOC] = {"malloc", ENOMEM},
                  [RENAME] = {"rename", EIO},
                  [FSYNC] = {"fsync", EIO},
                  [LINKAT] = {"linkat", EPERM}};

static int is_nameless;
static atomic_int is_running;

/** Counts a call. \return whether it shall fail; errno says of what */
static int
meets(enum Call call)
{
  if (!is_running)
    return 0;
  const long number = 1 + atomic_fetch_add(&kinds[call].calls, 1);
  if (number == kinds[call].signal_at)
    raise(kinds[call].signal);
  if (number < kinds[call].fail_first || number > kinds[call].fail_last)
    return 0;
  errno = kinds[call].error;
  return 1;
}

static void
takeFault(const char* fault)
{
  is_nameless |= strncmp(fault, "nameless", 8) == 0;
  for (int i = 0; i < CALLS; ++i) {
    const size_t length = strlen(kinds[i].name);
    if (strncmp(fault, kinds[i].name, length) != 0 || fault[length] != ':')
      continue;
    char* end;
    const long number = strtol(fault + length + 1, &end, 10);
    if (*end == ':') {
      kinds[i].signal_at = number;
      kinds[i].signal = atoi(end + 1);
    }
    else {
      kinds[i].fail_first = number;
      kinds[i].fail_last = *end == '+' ? __LONG_MAX__ : number;
    }
  }
}

static void
writeCounts(void)
{
  const char* const path = strstr(getenv("UVOL_FAULTS"), "count=");
  FILE* const file = path ? fopen(path + 6, "w") : NULL;
  for (int i = 0; file && i < CALLS; ++i)
    fprintf(file, "%s %ld\n", kinds[i].name, (long)kinds[i].calls);
  if (file)
    fclose(file);
}

static int (*tool_main)(int, char**, char**);

static int
countedMain(int argument_count, char** arguments, char** environment)
{
  const char* fault = getenv("UVOL_FAULTS");
  for (; fault != NULL; fault = strchr(fault, ','))
    takeFault(*fault == ',' ? ++fault : fault);
  is_running = 1;
  const int code = tool_main(argument_count, arguments, environment);
  is_running = 0;
  if (getenv("UVOL_FAULTS"))
    writeCounts();
  return code;
}

/** The function that this library stands in front of. */
#define NEXT(function) ((__typeof__(&function))dlsym(RTLD_NEXT, #function))

int
__libc_start_main(int (*main)(int, char**, char**),
                  int argument_count,
                  char** arguments,
                  void (*init)(void),
                  void (*fini)(void),
                  void (*loader)(void),
                  void* stack)
{
  tool_main = main;
  return NEXT(__libc_start_main)(
      countedMain, argument_count, arguments, init, fini, loader, stack);
}

ssize_t
read(int descriptor, void* bytes, size_t count)
{
  return meets(READ) ? -1 : NEXT(read)(descriptor, bytes, count);
}

ssize_t
pread(int descriptor, void* bytes, size_t count, off_t offset)
{
  return meets(READ) ? -1 : NEXT(pread)(descriptor, bytes, count, offset);
}

/** Disks are full, not terminals and not the wires of MPI. */
static int
isOnDisk(int descriptor)
{
  struct stat status;
  return descriptor != STDERR_FILENO && fstat(descriptor, &status) == 0 &&
         S_ISREG(status.st_mode);
}

ssize_t
write(int descriptor, const void* bytes, size_t count)
{
  return isOnDisk(descriptor) && meets(WRITE) ? -1
                                              : NEXT(write)(descriptor, bytes, count);
}

ssize_t
pwrite(int descriptor, const void* bytes, size_t count, off_t offset)
{
  return meets(WRITE) ? -1 : NEXT(pwrite)(descriptor, bytes, count, offset);
}

int
open(const char* path, int flags, ...)
{
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = va_arg(arguments, mode_t);
  va_end(arguments);
  if (is_nameless && (flags & O_TMPFILE) == O_TMPFILE) {
    errno = EOPNOTSUPP;
    return -1;
  }
  return meets(OPEN) ? -1 : NEXT(open)(path, flags, mode);
}

void*
mmap(void* address, size_t size, int protection, int flags, int file, off_t offset)
{
  return meets(MMAP) ? MAP_FAILED
                     : NEXT(mmap)(address, size, protection, flags, file, offset);
}

int
rename(const char* from, const char* to)
{
  return meets(RENAME) ? -1 : NEXT(rename)(from, to);
}

int
fsync(int descriptor)
{
  return meets(FSYNC) ? -1 : NEXT(fsync)(descriptor);
}

int
linkat(int from_folder, const char* from, int to_folder, const char* to, int flags)
{
  return meets(LINKAT) ? -1 : NEXT(linkat)(from_folder, from, to_folder, to, flags);
}

/** The path is that of the caller's folder: the search would begin at this library. */
void*
dlopen(const char* file, int mode)
{
  char path[4096];
  Dl_info caller;
  if (file != NULL && strchr(file, '/') == NULL &&
      dladdr(__builtin_return_address(0), &caller) != 0) {
    const char* const slash = strrchr(caller.dli_fname, '/');
    if (slash != NULL) {
      snprintf(path,
               sizeof path,
               "%.*s/%s",
               (int)(slash - caller.dli_fname),
               caller.dli_fname,
               file);
      if (access(path, R_OK) == 0)
        file = path;
    }
  }
  const int was_running = atomic_exchange(&is_running, 0);
  void* const library = NEXT(dlopen)(file, mode);
  atomic_store(&is_running, was_running);
  return library;
}

// dlsym allocates: what allocates has to be known without it.
void*
__libc_malloc(size_t size);
void*
__libc_calloc(size_t count, size_t size);
void*
__libc_realloc(void* bytes, size_t size);
void*
__libc_memalign(size_t alignment, size_t size);

void*
malloc(size_t size)
{
  return meets(MALLOC) ? NULL : __libc_malloc(size);
}

void*
calloc(size_t count, size_t size)
{
  return meets(MALLOC) ? NULL : __libc_calloc(count, size);
}

void*
realloc(void* bytes, size_t size)
{
  return meets(MALLOC) ? NULL : __libc_realloc(bytes, size);
}

void*
aligned_alloc(size_t alignment, size_t size)
{
  return meets(MALLOC) ? NULL : __libc_memalign(alignment, size);
}

int
posix_memalign(void** bytes, size_t alignment, size_t size)
{
  void* const got = aligned_alloc(alignment, size);
  if (got != NULL)
    *bytes = got;
  return got != NULL ? 0 : ENOMEM;
}
