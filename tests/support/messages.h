// SPDX-License-Identifier: BSD-3-Clause
// What messages hold, for tests: codes and values instead of words of their texts.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/message.h>

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace uvol_test {

/** \brief The codes of messages, in their order. */
inline std::vector<std::string>
listCodes(const std::vector<pcl_uvol::Message>& messages)
{
  std::vector<std::string> codes;
  codes.reserve(messages.size());
  for (const auto& message : messages)
    codes.push_back(message.code);
  return codes;
}

/** \brief The value of that name and kind; one that is missing fails the test.
 * \param otherwise comes back for a missing one */
template <typename T>
T
takeValue(const pcl_uvol::Message& message, const std::string& name, const T& otherwise)
{
  for (const auto& value : message.values)
    if (value.name == name && std::holds_alternative<T>(value.value))
      return std::get<T>(value.value);
  ADD_FAILURE() << "The message '" << message.code << "' has no value '" << name
                << "' of that kind.";
  return otherwise;
}

/** \brief What the error tells that this throws; without a code if it throws none. */
template <typename Error = pcl_uvol::IOError, typename Function>
pcl_uvol::Message
thrownBy(Function&& function)
{
  try {
    function();
  }
  catch (const Error& error) {
    return error.asMessage();
  }
  return {"", {}};
}

/** \brief The code of the error that this throws; empty if it throws none. */
template <typename Error = pcl_uvol::IOError, typename Function>
std::string
codeOf(Function&& function)
{
  return thrownBy<Error>(function).code;
}

/** \brief A number of a message; a missing one fails the test and is NaN. */
inline double
numberOf(const pcl_uvol::Message& message, const std::string& name)
{
  return takeValue(message, name, std::numeric_limits<double>::quiet_NaN());
}

/** \brief A word of a message; a missing one fails the test and is empty. */
inline std::string
wordOf(const pcl_uvol::Message& message, const std::string& name)
{
  return takeValue(message, name, std::string());
}

} // namespace uvol_test
