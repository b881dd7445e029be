// SPDX-License-Identifier: BSD-3-Clause
// Files that appear whole or not at all: written beside, flushed, renamed.
#include "files.h"
#include <pcl_uvol/io/dataset.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace pcl_uvol {
namespace {

/** A file that is nobody's until it is whole. Where the file system allows it has no
 * name, so that even a killed process leaves nothing behind; elsewhere it has a name of
 * its own and is removed unless it took its place. */
class UnfinishedFile {
public:
  /** \param target the file that it shall become
   * \param name the name that errors give */
  UnfinishedFile(std::string target, std::string name);
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile&
  operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile()
  {
    if (!linked_as_.empty())
      ::unlink(linked_as_.c_str());
    ::close(descriptor_);
  }

  /** A path to write it by. */
  std::string
  getPath() const
  {
    return linked_as_.empty() ? "/proc/self/fd/" + std::to_string(descriptor_)
                              : linked_as_;
  }

  /** Flush it to the disk and let it replace the target. */
  void
  finish();

private:
  [[noreturn]] void
  fail() const
  {
    io::throwUnwritable(name_, std::strerror(errno));
  }

  std::string
  freshName() const
  {
    static std::atomic<unsigned> serial{0};
    return target_ + '.' + std::to_string(::getpid()) + '-' + std::to_string(serial++) +
           ".tmp";
  }

  std::string target_, name_, linked_as_;
  int descriptor_ = -1;
};

UnfinishedFile::UnfinishedFile(std::string target, std::string name)
    : target_(std::move(target))
    , name_(std::move(name))
{
  std::string folder = std::filesystem::path(target_).parent_path().string();
  if (folder.empty())
    folder = ".";
  if (::access("/proc/self/fd", X_OK) == 0)
    descriptor_ = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  while (descriptor_ < 0) {
    linked_as_ = freshName();
    descriptor_ =
        ::open(linked_as_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST)
      fail();
  }
  struct stat status {};
  if (::stat(target_.c_str(), &status) == 0) // a replaced file keeps its permissions
    ::fchmod(descriptor_, status.st_mode & 07777);
}

void
UnfinishedFile::finish()
{
  if (::fsync(descriptor_) != 0 && errno != EINVAL) // some file systems know no fsync
    fail();
  while (linked_as_.empty()) { // linking cannot replace a file, renaming can
    const std::string path = getPath(), fresh = freshName();
    if (::linkat(AT_FDCWD, path.c_str(), AT_FDCWD, fresh.c_str(), AT_SYMLINK_FOLLOW) ==
        0)
      linked_as_ = fresh;
    else if (errno != EEXIST)
      fail();
  }
  if (::rename(linked_as_.c_str(), target_.c_str()) != 0)
    fail();
  linked_as_.clear();
}

/** The file behind symbolic links, so that a link stays a link. */
std::string
resolveLinks(const std::string& path)
{
  const std::unique_ptr<char, decltype(&std::free)> real(
      ::realpath(path.c_str(), nullptr), &std::free);
  return real ? real.get() : path;
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
  UnfinishedFile file(resolveLinks(path), path);
  writer(file.getPath());
  file.finish();
}

} // namespace pcl_uvol
