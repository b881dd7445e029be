// SPDX-License-Identifier: BSD-3-Clause
// Files that appear whole or not at all: written beside, flushed, renamed.
#include "files.h"
#include <pcl_uvol/io/dataset.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>

namespace pcl_uvol {
namespace {

/** Removes its file unless told that it has been renamed. */
class TemporaryFile {
public:
  explicit TemporaryFile(const std::string& target);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile&
  operator=(const TemporaryFile&) = delete;
  ~TemporaryFile()
  {
    if (!path_.empty())
      ::unlink(path_.c_str());
  }

  const std::string&
  getPath() const
  {
    return path_;
  }

  void
  release()
  {
    path_.clear();
  }

private:
  std::string path_;
};

TemporaryFile::TemporaryFile(const std::string& target)
{
  static std::atomic<unsigned> serial{0};
  int descriptor = -1;
  do {
    path_ = target + '.' + std::to_string(::getpid()) + '-' + std::to_string(serial++) +
            ".tmp";
    descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) {
    const int reason = errno;
    path_.clear(); // nothing to remove
    io::throwUnwritable(target, std::strerror(reason));
  }
  struct stat status {};
  if (::stat(target.c_str(), &status) == 0) // a replaced file keeps its permissions
    ::fchmod(descriptor, status.st_mode & 07777);
  ::close(descriptor);
}

/** The file behind symbolic links, so that a link stays a link. */
std::string
resolveLinks(const std::string& path)
{
  const std::unique_ptr<char, decltype(&std::free)> real(
      ::realpath(path.c_str(), nullptr), &std::free);
  return real ? real.get() : path;
}

void
flushToDisk(const std::string& file, const std::string& name)
{
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    io::throwUnwritable(name, std::strerror(errno));
  const int failed = ::fsync(descriptor) != 0 ? errno : 0;
  ::close(descriptor);
  if (failed != 0 && failed != EINVAL) // some file systems know no fsync
    io::throwUnwritable(name, std::strerror(failed));
}

} // namespace

void
writeAtomically(const std::string& path,
                const std::function<void(const std::string&)>& writer)
{
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    io::throwUnwritable(path,
                        S_ISDIR(status.st_mode) ? "it is a directory"
                                                : "it is not a regular file");
  const std::string target = resolveLinks(path);
  TemporaryFile temporary(target);
  writer(temporary.getPath());
  flushToDisk(temporary.getPath(), path);
  if (::rename(temporary.getPath().c_str(), target.c_str()) != 0)
    io::throwUnwritable(path, std::strerror(errno));
  temporary.release();
}

} // namespace pcl_uvol
