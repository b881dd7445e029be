// SPDX-License-Identifier: BSD-3-Clause
// An output window for VTK that prints nothing.
#include "io_vtk/vtk_messages.h"

#include "common/numbers.h"
#include "io/files.h"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkXMLWriter.h>

#include <algorithm>

namespace pcl_uvol {
namespace io {
namespace {

/** "ERROR: In file, line 5\nvtkReader (0x1): words.\n\n" -> "words"; warnings without
 * an object have the first line only in front. */
std::string
extractWords(const std::string& message)
{
  std::size_t start = message.find("): ");
  start = start == std::string::npos ? message.find('\n') : start + 2;
  std::string words(trimmed(
      std::string_view(message).substr(start == std::string::npos ? 0 : start)));
  words = words.substr(0, words.find("\n\n"));
  std::replace(words.begin(), words.end(), '\n', ' ');
  return words.substr(0, words.find_last_not_of(".! ") + 1);
}

class KeepingWindow : public vtkOutputWindow {
public:
  vtkTypeMacro(KeepingWindow, vtkOutputWindow);
  static KeepingWindow*
  New();

  void
  DisplayText(const char*) override
  {
  }

  void
  DisplayErrorText(const char* text) override
  {
    const std::string words = extractWords(text);
    // The pipeline tells by addresses of objects that a part of it failed.
    if (error && error->empty() && words.find("(0x") == std::string::npos)
      *error = words;
  }

  /** Readers without an object at hand report damaged data as a generic warning. */
  void
  DisplayGenericWarningText(const char* text) override
  {
    const std::string words = extractWords(text);
    if (words.find("rror") != std::string::npos)
      DisplayErrorText(text);
  }

  std::string* error = nullptr;
};

vtkStandardNewMacro(KeepingWindow);

} // namespace

std::mutex VtkMessages::mutex_;

VtkMessages::VtkMessages()
    : lock_(mutex_)
    , previous_(vtkOutputWindow::GetInstance())
    , verbosity_(vtkLogger::GetCurrentVerbosityCutoff())
{
  vtkNew<KeepingWindow> window;
  window->error = &error_;
  vtkOutputWindow::SetInstance(window);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages()
{
  static_cast<KeepingWindow*>(vtkOutputWindow::GetInstance())->error = nullptr;
  vtkOutputWindow::SetInstance(previous_);
  vtkLogger::SetStderrVerbosity(static_cast<vtkLogger::Verbosity>(verbosity_));
}

/** VTK's writers and their compressor die where they find no memory for their blocks.
 * \throws std::bad_alloc in front of them */
void
checkRoomForBlocks()
{
  constexpr std::size_t bytes = 1 << 20;
  ::operator delete(::operator new(bytes)); // no compiler leaves this out
}

void
writeXml(vtkXMLWriter& writer, const std::string& file, const std::string& path)
{
  checkRoomForBlocks();
  const VtkMessages messages;
  writer.SetFileName(file.c_str());
  writer.SetDataModeToAppended();
  writer.EncodeAppendedDataOff();
  writer.SetCompressorTypeToZLib();
  writer.SetCompressionLevel(1); // the mantissas of floats hardly shrink further
  const bool written = writer.Write() != 0;
  if (!messages.getError().empty())
    throwUnwritable(path, {"library_error", "VTK", messages.getError()});
  if (!written || writer.GetErrorCode() != 0)
    throwUnwritable(path, "full_disk");
}

} // namespace io
} // namespace pcl_uvol
