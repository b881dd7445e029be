// SPDX-License-Identifier: BSD-3-Clause
// Calls of the system that fail as on other file systems, and signals at a known moment.
// Loaded into a tool by LD_PRELOAD; UVOL_FAULTS lists what to do: "nameless": no files
// without a name; "link": they cannot be given one; "term", "kill": that signal when a
// file is flushed.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

static int
has(const char* fault)
{
  const char* const faults = getenv("UVOL_FAULTS");
  return faults != NULL && strstr(faults, fault) != NULL;
}

int
open(const char* path, int flags, ...)
{
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = va_arg(arguments, mode_t);
  va_end(arguments);
  if ((flags & O_TMPFILE) == O_TMPFILE && has("nameless")) {
    errno = EOPNOTSUPP;
    return -1;
  }
  int (*const next)(const char*, int, ...) =
      (int (*)(const char*, int, ...))dlsym(RTLD_NEXT, "open");
  return next(path, flags, mode);
}

int
linkat(int from_folder, const char* from, int to_folder, const char* to, int flags)
{
  if (has("link")) {
    errno = EPERM;
    return -1;
  }
  int (*const next)(int, const char*, int, const char*, int) =
      (int (*)(int, const char*, int, const char*, int))dlsym(RTLD_NEXT, "linkat");
  return next(from_folder, from, to_folder, to, flags);
}

int
fsync(int descriptor)
{
  if (has("term"))
    raise(SIGTERM);
  if (has("kill"))
    raise(SIGKILL);
  int (*const next)(int) = (int (*)(int))dlsym(RTLD_NEXT, "fsync");
  return next(descriptor);
}
