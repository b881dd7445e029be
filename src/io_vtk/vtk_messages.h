// SPDX-License-Identifier: BSD-3-Clause
// What VTK would print, kept while it reads or writes a file.
#pragma once

#include <pcl_uvol/common/export.h>

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <mutex>
#include <string>

class vtkOutputWindow;
class vtkXMLWriter;

namespace pcl_uvol {
namespace io {

/** \brief Collects VTK's errors instead of printing them. Parts inside VTK's readers
 * report to its global output window only, so that is exchanged; one at a time, calls
 * of other threads wait. */
class PCL_UVOL_EXPORTS VtkMessages {
public:
  VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages&
  operator=(const VtkMessages&) = delete;
  ~VtkMessages();

  /** \brief The first error, its words only; empty if there was none. */
  const std::string&
  getError() const
  {
    return error_;
  }

private:
  static std::mutex mutex_;
  std::lock_guard<std::mutex> lock_;
  vtkSmartPointer<vtkOutputWindow> previous_;
  std::string error_;
  int verbosity_;
};

/** \brief Write what a writer was given, compressed in its binary part.
 * \param file where it is written to
 * \param path the name that errors give
 * \throws IOError */
void
writeXml(vtkXMLWriter& writer, const std::string& file, const std::string& path);

} // namespace io
} // namespace pcl_uvol
