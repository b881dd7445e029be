// SPDX-License-Identifier: BSD-3-Clause
// Exceptions of pcl_uvol: each message is one sentence that says what was given, what
// is allowed and what to do.
#pragma once

#include <pcl_uvol/common/export.h>

#include <pcl/exceptions.h>

#include <string>

namespace pcl_uvol {

/** \brief Base of everything this library throws on purpose. message() and
 * what() are the bare sentence, without the place that PCL puts in front. */
class PCL_UVOL_EXPORTS Exception : public pcl::PCLException {
public:
  /** \param message one sentence */
  explicit Exception(const std::string& message)
      : pcl::PCLException(message)
      , message_(message)
  {
  }

  /** \return The sentence. */
  const char*
  what() const noexcept override
  {
    return message_.c_str();
  }

  /** \return The sentence. */
  const std::string&
  message() const noexcept
  {
    return message_;
  }

private:
  std::string message_;
};

/** \brief A parameter or an input cloud that a stage cannot work with. */
class PCL_UVOL_EXPORTS InvalidArgument : public Exception {
public:
  using Exception::Exception;
};

/** \brief A file that cannot be read or written: missing, malformed, truncated, full
 * disk.
 */
class PCL_UVOL_EXPORTS IOError : public Exception {
public:
  using Exception::Exception;
};

/** \brief An iteration that grows beyond bounds: nothing came of it. */
class PCL_UVOL_EXPORTS Diverged : public Exception {
public:
  using Exception::Exception;
};

} // namespace pcl_uvol
