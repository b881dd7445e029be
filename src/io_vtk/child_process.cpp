// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/child_process.h"

#include "io/files.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pcl_uvol {
namespace io {
namespace {

using Clock = std::chrono::steady_clock;

/** Limits of a child. */
struct Limits {
  /** VTK's slowest readers, those of texts, take 0.2 s per MB: five times as long, and
   * 10 s, so that a broken file of 1 MB costs less than 20 s on a busy machine. */
  explicit Limits(std::uint64_t bytes)
      : seconds(10 + bytes / 1000000)
      , memory((std::uint64_t(1) << 29) + 64 * bytes)
  {
  }

  std::uint64_t seconds; ///< of the processor
  /** A cell of a packed file may take a byte there, and its corners, its types, its
   * centre and its data 64 bytes and more; 512 MB are for small files that unpack to
   * much. */
  std::uint64_t memory;
};

/** A child that waits for a lock, or for a disk, takes no time of the processor: it is
 * given up after that many times its limit. */
constexpr int most_waiting = 6;

/** The shadow of a sanitizer takes terabytes of addresses: nothing can be limited. */
constexpr std::uint64_t most_addresses = std::uint64_t(1) << 40;

/** Address space of this process, in bytes. */
std::uint64_t
usedMemory()
{
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void
limit(decltype(RLIMIT_AS) resource, std::uint64_t most)
{
  rlimit now{};
  ::getrlimit(resource, &now);
  now.rlim_cur = std::min<rlim_t>(now.rlim_cur, most);
  ::setrlimit(resource, &now);
}

/** What a child tells. */
enum class Answer : std::uint64_t { Content = 1, Error = 2, NoMemory = 3 };

/** The end of a pipe that a child writes to. */
class Sender {
public:
  explicit Sender(int descriptor)
      : descriptor_(descriptor)
  {
  }

  void
  send(const void* bytes, std::uint64_t count) const
  {
    const auto* from = static_cast<const char*>(bytes);
    while (count > 0) {
      const ssize_t written = ::write(descriptor_, from, count);
      if (written < 0 && errno == EINTR)
        continue;
      if (written <= 0)
        ::_exit(1);
      from += written;
      count -= static_cast<std::uint64_t>(written);
    }
  }

  void
  send(std::uint64_t number) const
  {
    send(&number, sizeof(number));
  }

  void
  send(const std::string& text) const
  {
    send(text.size());
    send(text.data(), text.size());
  }

  void
  send(vtkDataArray& array) const
  {
    send(std::string(array.GetName() ? array.GetName() : ""));
    send(static_cast<std::uint64_t>(array.GetDataType()));
    send(static_cast<std::uint64_t>(array.GetNumberOfComponents()));
    send(static_cast<std::uint64_t>(array.GetNumberOfTuples()));
    send(array.GetVoidPointer(0),
         static_cast<std::uint64_t>(array.GetNumberOfValues() *
                                    array.GetDataTypeSize()));
  }

  void
  send(const Message& message) const
  {
    send(message.code);
    send(message.about);
    send(std::uint64_t{message.values.size()});
    for (const auto& [name, value] : message.values) {
      const auto* const number = std::get_if<double>(&value);
      send(name);
      send(std::uint64_t{number != nullptr});
      if (number)
        send(number, sizeof(*number));
      else
        send(std::get<std::string>(value));
    }
  }

  void
  send(VtkContent& content) const;

private:
  int descriptor_;
};

void
Sender::send(VtkContent& content) const
{
  vtkPointData& data = *content.data->GetPointData();
  std::vector<vtkDataArray*> arrays;
  std::vector<std::uint64_t> roles;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    vtkDataArray* const array = data.GetArray(i);
    // Bits, which take no whole bytes, and texts are no numbers.
    if (!array || array->GetDataTypeSize() == 0) {
      content.notes.push_back(describeTexts(data.GetArrayName(i)));
      continue;
    }
    arrays.push_back(array);
    const int role = data.IsArrayAnAttribute(i);
    roles.push_back(static_cast<std::uint64_t>(
        role < 0 ? int(vtkDataSetAttributes::NUM_ATTRIBUTES) : role));
  }
  auto& points = *vtkPointSet::SafeDownCast(content.data);
  send(*points.GetPoints()->GetData());
  send(arrays.size());
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    send(roles[i]);
    send(*arrays[i]);
  }
  vtkFieldData& others = *content.data->GetFieldData();
  send(static_cast<std::uint64_t>(others.GetNumberOfArrays()));
  for (int i = 0; i < others.GetNumberOfArrays(); ++i)
    send(*others.GetArray(i));
  send(content.notes.size());
  for (const Message& note : content.notes)
    send(note);
}

/** Reads, tells and ends. */
[[noreturn]] void
runChild(int descriptor,
         const Limits& limits,
         pid_t parent,
         const std::function<VtkContent()>& read)
{
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent)
    ::_exit(1);
  for (int signal = 1; signal < NSIG; ++signal)
    ::signal(signal, SIG_DFL); // handlers would clean up what is the parent's
  sigset_t none;
  ::sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(nothing, STDERR_FILENO);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.seconds);
  if (const std::uint64_t used = usedMemory(); used < most_addresses)
    limit(RLIMIT_AS, used + limits.memory);
  vtkSMPTools::SetBackend("Sequential"); // other threads were not copied
  const Sender sender(descriptor);
  try {
    VtkContent content = read();
    sender.send(static_cast<std::uint64_t>(Answer::Content));
    sender.send(content);
    ::_exit(0);
  }
  catch (const IOError& error) {
    sender.send(static_cast<std::uint64_t>(Answer::Error));
    sender.send(error.asMessage());
  }
  catch (const std::bad_alloc&) {
    sender.send(static_cast<std::uint64_t>(Answer::NoMemory));
  }
  ::_exit(1);
}

/** A child process, and the end of a pipe that it writes to. */
class Child {
public:
  Child(const std::string& path,
        const Limits& limits,
        const std::function<VtkContent()>& read);
  Child(const Child&) = delete;
  Child&
  operator=(const Child&) = delete;
  ~Child()
  {
    finish();
  }

  VtkContent
  take();

private:
  void
  receive(void* bytes, std::uint64_t count);
  std::uint64_t
  receiveNumber();
  std::string
  receiveText();
  Message
  receiveMessage();
  vtkSmartPointer<vtkDataArray>
  receiveArray();
  int
  finish();
  [[noreturn]] void
  fail();

  const std::string& path_;
  const Limits limits_;
  const Clock::time_point end_;
  int descriptor_ = -1;
  pid_t process_ = -1;
  bool late_ = false;
};

Child::Child(const std::string& path,
             const Limits& limits,
             const std::function<VtkContent()>& read)
    : path_(path)
    , limits_(limits)
    , end_(Clock::now() + std::chrono::seconds(most_waiting * limits.seconds))
{
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throwUnreadable(path, {"reader_not_started", std::strerror(errno)});
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0)
    runChild(ends[1], limits, parent, read);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ::close(ends[1]);
  descriptor_ = ends[0];
  if (process_ < 0) {
    const int error = errno;
    ::close(descriptor_);
    throwUnreadable(path, {"reader_not_started", std::strerror(error)});
  }
}

/** Ends it if it still runs.
 * \return the status */
int
Child::finish()
{
  int status = 0;
  if (process_ < 0)
    return status;
  ::close(descriptor_);
  if (late_)
    ::kill(process_, SIGKILL);
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR)
    continue;
  process_ = -1;
  return status;
}

void
Child::fail()
{
  const int status = finish();
  if (late_ || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
    throwUnreadable(path_, {"reader_too_slow", limits_.seconds});
  throwUnreadable(path_, "reader_failed");
}

void
Child::receive(void* bytes, std::uint64_t count)
{
  auto* to = static_cast<char*>(bytes);
  while (count > 0) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end_ - Clock::now());
    pollfd waiting{descriptor_, POLLIN, 0};
    const int ready =
        ::poll(&waiting,
               1,
               static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 60000)));
    if (ready == 0 && left.count() <= 60000) {
      late_ = true;
      fail();
    }
    if (ready <= 0)
      continue;
    const ssize_t got = ::read(descriptor_, to, count);
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      fail();
    to += got;
    count -= static_cast<std::uint64_t>(got);
  }
}

std::uint64_t
Child::receiveNumber()
{
  std::uint64_t number = 0;
  receive(&number, sizeof(number));
  return number;
}

std::string
Child::receiveText()
{
  const std::uint64_t size = receiveNumber();
  if (size > limits_.memory) // a child whose memory was overwritten
    fail();
  std::string text(size, '\0');
  receive(text.data(), size);
  return text;
}

Message
Child::receiveMessage()
{
  Message message(receiveText(), {});
  message.about = receiveText();
  const std::uint64_t values = receiveNumber();
  for (std::uint64_t i = 0; i < values; ++i) {
    const std::string name = receiveText();
    if (receiveNumber() == 0)
      message.values.emplace_back(name, receiveText());
    else {
      double number = 0.0;
      receive(&number, sizeof(number));
      message.values.emplace_back(name, number);
    }
  }
  return message;
}

vtkSmartPointer<vtkDataArray>
Child::receiveArray()
{
  const std::string name = receiveText();
  const std::uint64_t type = receiveNumber(), components = receiveNumber(),
                      tuples = receiveNumber();
  if (type > VTK_OBJECT || components < 1 || components > limits_.memory ||
      tuples > limits_.memory / components)
    fail();
  auto array = vtkSmartPointer<vtkDataArray>::Take(
      vtkDataArray::CreateDataArray(static_cast<int>(type)));
  if (!name.empty())
    array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(components));
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  receive(array->GetVoidPointer(0),
          components * tuples * static_cast<std::uint64_t>(array->GetDataTypeSize()));
  return array;
}

VtkContent
Child::take()
{
  switch (static_cast<Answer>(receiveNumber())) {
  case Answer::Content:
    break;
  case Answer::Error:
    throw IOError(receiveMessage());
  case Answer::NoMemory:
    throwUnreadable(path_, {"reader_too_large", limits_.memory >> 20});
  default:
    fail();
  }
  auto set = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(receiveArray());
  set->SetPoints(points);
  auto& data = *set->GetPointData();
  const std::uint64_t arrays = receiveNumber();
  for (std::uint64_t i = 0; i < arrays; ++i) {
    const std::uint64_t role = receiveNumber();
    const auto array = receiveArray();
    const int index = data.AddArray(array);
    if (role < vtkDataSetAttributes::NUM_ATTRIBUTES)
      data.SetActiveAttribute(index, static_cast<int>(role));
  }
  const std::uint64_t others = receiveNumber();
  for (std::uint64_t i = 0; i < others; ++i)
    set->GetFieldData()->AddArray(receiveArray());
  VtkContent content{set, {}};
  const std::uint64_t notes = receiveNumber();
  for (std::uint64_t i = 0; i < notes; ++i)
    content.notes.push_back(receiveMessage());
  return content;
}

} // namespace

VtkContent
readInChild(const std::string& path,
            std::uint64_t bytes,
            const std::function<VtkContent()>& read)
{
  return Child(path, Limits(bytes), read).take();
}

} // namespace io
} // namespace pcl_uvol
