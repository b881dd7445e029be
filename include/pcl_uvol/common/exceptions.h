// SPDX-License-Identifier: BSD-3-Clause
// Exceptions of pcl_uvol: each says what was given, what is allowed and what to do.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/message.h>

#include <pcl/exceptions.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Base of everything this library throws on purpose. message() and
 * what() are the bare text, without the place that PCL puts in front. */
class PCL_UVOL_EXPORTS Exception : public pcl::PCLException {
public:
  /** \param message code and values; its text names parameters as members */
  explicit Exception(Message message);

  /** \param text in words, for one that has no row in the table of messages */
  explicit Exception(const std::string& text)
      : Exception(Message(text))
  {
  }

  /** \param code row of the table of messages
   * \param values all that the text of that row holds */
  Exception(std::string code, std::vector<MessageValue> values)
      : Exception(Message(std::move(code), std::move(values)))
  {
  }

  /** \return The text. */
  const char*
  what() const noexcept override
  {
    return text_.c_str();
  }

  /** \return The text. */
  const std::string&
  message() const noexcept
  {
    return text_;
  }

  /** \return Code and values, for a text with other names of parameters. */
  const Message&
  asMessage() const noexcept
  {
    return message_;
  }

private:
  Exception(Message message, const std::string& text);

  Message message_;
  std::string text_;
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
