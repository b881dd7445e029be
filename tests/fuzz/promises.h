// SPDX-License-Identifier: BSD-3-Clause
// What the library promises for any input, and how a target says that it is broken.
#pragma once

#include <pcl_uvol/common/exceptions.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace uvol_fuzz {

/** \brief A promise that does not hold. */
class BrokenPromise : public std::logic_error {
public:
  using std::logic_error::logic_error;
};

/** \throws BrokenPromise unless it holds */
inline void
require(bool holds, const std::string& promise)
{
  if (!holds)
    throw BrokenPromise(promise);
}

/** \brief An error is one sentence for a user: printable and short.
 * \param path of the file read: it, and files beside it, may be part of it, of any
 * length */
void
requireSentence(std::string message, const std::string& path = {});

/** \brief So is every warning, however it names parameters. */
inline void
requireSentences(const std::vector<pcl_uvol::Message>& warnings)
{
  for (const pcl_uvol::Message& warning : warnings)
    for (const auto names : {pcl_uvol::ParameterNames::Members,
                             pcl_uvol::ParameterNames::Options,
                             pcl_uvol::ParameterNames::Properties})
      requireSentence(warning.text(names));
}

/** \brief Runs what may refuse its input, but only by this exception and with one
 * sentence.
 * \return the code of the error, "" where it accepted */
template <typename ExceptionT = pcl_uvol::Exception, typename Function>
std::string
refusalOf(const Function& function, const std::string& path = {})
{
  try {
    function();
  }
  catch (const ExceptionT& error) {
    requireSentence(error.message(), path);
    return error.asMessage().code;
  }
  return {};
}

} // namespace uvol_fuzz
