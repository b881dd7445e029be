// SPDX-License-Identifier: BSD-3-Clause
// Files that appear whole or not at all: written beside, flushed, renamed.
#include "io/files.h"
#include "io/folder.h"
#include "io/unpacked_file.h"
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace pcl_uvol {
namespace {

namespace fs = std::filesystem;

/** Names of unfinished files where a signal handler finds them: no locks, no memory
 * that grows. More files than that at a time are not removed by handlers. */
class PartNames {
public:
  /** \return the slot, -1 without one */
  int
  add(const std::string& name)
  {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      State free = State::Free;
      if (name.size() < PATH_MAX &&
          slots_[i].state.compare_exchange_strong(free, State::Changing)) {
        name.copy(slots_[i].name, PATH_MAX - 1);
        slots_[i].name[name.size()] = '\0';
        slots_[i].state = State::Taken;
        return static_cast<int>(i);
      }
    }
    return -1;
  }

  void
  release(int slot)
  {
    if (slot >= 0)
      slots_[static_cast<std::size_t>(slot)].state = State::Free;
  }

  void
  unlinkAll() const
  {
    for (const Slot& slot : slots_)
      if (slot.state == State::Taken)
        ::unlink(slot.name);
  }

private:
  enum class State { Free, Changing, Taken };
  struct Slot {
    std::atomic<State> state{State::Free};
    char name[PATH_MAX];
  };
  std::array<Slot, 8> slots_;
};

PartNames part_names;

std::string
hostName()
{
  char name[HOST_NAME_MAX + 1] = "host";
  ::gethostname(name, sizeof(name) - 1);
  return name;
}

/** ".out.csv.node7.": what unfinished files of a target begin with. The host is part of
 * it, because folders are shared by hosts that count their processes on their own. */
std::string
partPrefix(const fs::path& target)
{
  constexpr std::size_t most_bytes = 120; // names of files have 255
  return '.' + target.filename().string().substr(0, most_bytes) + '.' +
         hostName().substr(0, most_bytes / 2) + '.';
}

constexpr const char* part_ending = ".part";

/** Remove the unfinished files of a target whose processes are gone; whoever lives
 * holds a lock on his. */
void
removeLeftParts(const fs::path& target, const fs::path& folder)
{
  const std::string prefix = partPrefix(target), ending = part_ending;
  for (const std::string& name : io::listFolder(folder.string())) {
    if (name.size() <= prefix.size() + ending.size() ||
        name.compare(0, prefix.size(), prefix) != 0 ||
        name.compare(name.size() - ending.size(), ending.size(), ending) != 0)
      continue;
    pid_t process = 0;
    std::from_chars(name.data() + prefix.size(), name.data() + name.size(), process);
    if (process <= 0 || ::kill(process, 0) == 0 || errno != ESRCH)
      continue;
    const std::string part = (folder / name).string();
    const int descriptor = ::open(part.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
      ::unlink(part.c_str());
    ::close(descriptor);
  }
}

/** A file that is nobody's until it is whole. Where the file system allows it has no
 * name, so that even a killed process leaves nothing behind; elsewhere it has a name of
 * its own and is removed unless it took its place. */
class UnfinishedFile {
public:
  /** \param target the file that it shall become
   * \param name the name that errors give */
  UnfinishedFile(const std::string& target, std::string name);
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile&
  operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile()
  {
    if (!part_.empty())
      ::unlink(part_.c_str());
    part_names.release(slot_);
    ::close(descriptor_);
  }

  /** A path to write it by. */
  std::string
  getPath() const
  {
    return part_.empty() ? "/proc/self/fd/" + std::to_string(descriptor_) : part_;
  }

  /** Flush it to the disk and let it replace the target. */
  void
  finish();

private:
  [[noreturn]] void
  fail() const
  {
    io::throwUnwritable(name_, io::systemError());
  }

  template <typename Create>
  void
  createPart(const Create& create);
  void
  openPart();
  void
  flush() const;

  fs::path target_, folder_;
  std::string name_, part_;
  int descriptor_ = -1, slot_ = -1;
};

UnfinishedFile::UnfinishedFile(const std::string& target, std::string name)
    : target_(target)
    , folder_(target_.has_parent_path() ? target_.parent_path() : fs::path("."))
    , name_(std::move(name))
{
  removeLeftParts(target_, folder_);
  if (::access("/proc/self/fd", X_OK) == 0)
    descriptor_ = ::open(folder_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    openPart();
  struct stat status {};
  if (::stat(target_.c_str(), &status) == 0) // a replaced file keeps its permissions
    ::fchmod(descriptor_, status.st_mode & 07777);
}

/** Calls create(name) with names that nobody has until it gives true; errno says why it
 * does not. */
template <typename Create>
void
UnfinishedFile::createPart(const Create& create)
{
  const std::string start =
      (folder_ / partPrefix(target_)).string() + std::to_string(::getpid());
  for (int serial = 0;; ++serial) { // threads may write one file at once
    // Named before it is there: from then on nothing may fail.
    part_ = start + (serial > 0 ? '-' + std::to_string(serial) : std::string()) +
            part_ending;
    slot_ = part_names.add(part_);
    if (create(part_))
      return;
    part_names.release(slot_);
    slot_ = -1;
    part_.clear();
    if (errno != EEXIST)
      return;
  }
}

void
UnfinishedFile::openPart()
{
  createPart([this](const std::string& part) {
    descriptor_ = ::open(part.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return descriptor_ >= 0;
  });
  if (part_.empty())
    fail();
  ::flock(descriptor_, LOCK_EX | LOCK_NB);
}

void
UnfinishedFile::flush() const
{
  if (::fsync(descriptor_) != 0 && errno != EINVAL) // some file systems know no fsync
    fail();
}

void
UnfinishedFile::finish()
{
  flush();
  if (part_.empty()) { // linking cannot replace a file, renaming can
    const std::string nameless = getPath();
    createPart([&nameless](const std::string& part) {
      return ::linkat(AT_FDCWD,
                      nameless.c_str(),
                      AT_FDCWD,
                      part.c_str(),
                      AT_SYMLINK_FOLLOW) == 0;
    });
    if (part_.empty()) { // some file systems do not let it have a name
      const int from = descriptor_;
      openPart();
      std::error_code error;
      fs::copy_file(nameless, part_, fs::copy_options::overwrite_existing, error);
      ::close(from);
      if (error)
        io::throwUnwritable(name_, {"system_error", error.message()});
      flush();
    }
  }
  if (::rename(part_.c_str(), target_.c_str()) != 0)
    fail();
  part_.clear();
}

/** What is read from a pipe comes only once it is complete. */
void
writeToStandardOutput(const std::function<void(const std::string&)>& writer)
{
  const std::string name = "standard output";
  const io::Descriptor file(io::openTemporary(name));
  writer("/proc/self/fd/" + std::to_string(file.get()));
  std::vector<char> block(std::size_t(1) << 16);
  off_t at = 0;
  while (const ssize_t got = ::pread(file.get(), block.data(), block.size(), at)) {
    for (ssize_t sent = 0; got > 0 && sent < got;) {
      const ssize_t now = ::write(
          STDOUT_FILENO, block.data() + sent, static_cast<std::size_t>(got - sent));
      if (now < 0 && errno != EINTR)
        io::throwUnwritable(name, io::systemError());
      sent += std::max<ssize_t>(now, 0);
    }
    if (got < 0)
      io::throwUnwritable(name, io::systemError());
    at += got;
  }
}

} // namespace

std::string
resolveLinks(const std::string& path)
{
  constexpr int most_links = 40; // as the system
  std::error_code error;
  fs::path file = path;
  for (int i = 0; i < most_links && fs::is_symlink(fs::symlink_status(file, error));
       ++i)
    file = file.parent_path() / fs::read_symlink(file, error);
  fs::path folder = file.parent_path();
  folder = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
  return error ? path : (folder / file.filename()).string();
}

void
removeUnfinishedFiles()
{
  part_names.unlinkAll();
}

void
writeAtomically(const std::string& path,
                const std::function<void(const std::string&)>& writer)
{
  if (io::isStandardStream(path))
    return writeToStandardOutput(writer);
  struct stat status {};
  const bool is_there = ::stat(path.c_str(), &status) == 0;
  if (!is_there && errno == ELOOP)
    io::throwUnwritable(path, io::systemError());
  if (is_there && !S_ISREG(status.st_mode))
    io::throwUnwritable(path,
                        S_ISDIR(status.st_mode) ? "is_directory" : "not_regular_file");
  UnfinishedFile file(resolveLinks(path), path);
  writer(file.getPath());
  file.finish();
}

} // namespace pcl_uvol
