// SPDX-License-Identifier: BSD-3-Clause
#include "promises.h"

#include "common/printable.h"

namespace uvol_fuzz {

void
requireSentence(std::string message, const std::string& path)
{
  constexpr std::size_t most_bytes = 300;
  if (const auto at = path.empty() ? std::string::npos : message.find(path);
      at != std::string::npos)
    message.erase(at, path.size());
  const bool names_other_file =
      !path.empty() &&
      message.find(path.substr(0, path.rfind('/') + 1)) != std::string::npos;
  // Errors of expressions mark the place on two lines below the sentence.
  const std::string sentence = message.substr(0, message.find("\n  "));
  require(!sentence.empty() && (sentence.back() == '.' || sentence.back() == '?'),
          "not a sentence: " + message);
  // An escaped byte, \xff, is one of those that were given.
  std::size_t bytes = sentence.size();
  for (std::size_t at = 0; (at = sentence.find("\\x", at)) != std::string::npos; ++at)
    bytes -= 3;
  require(bytes <= most_bytes || names_other_file, "a long sentence: " + message);
  require(pcl_uvol::isPrintable(sentence), "bytes that steer terminals: " + message);
}

} // namespace uvol_fuzz
