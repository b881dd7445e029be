// SPDX-License-Identifier: BSD-3-Clause
// A number that is typed key by key.
#pragma once

#include <optional>
#include <string>

namespace uvol_tools {

/** \brief Begins with =, ends with the return key; escape gives it up. */
class TypedNumber {
public:
  /** \brief Whether keys are digits now. */
  bool
  isBegun() const
  {
    return is_begun_;
  }

  const std::string&
  getText() const
  {
    return text_;
  }

  /** \brief Take a key.
   *
   * \return the number that the return key has ended
   *
   * \throws InvalidArgument if that is none */
  std::optional<double>
  press(char key);

private:
  bool is_begun_ = false;
  std::string text_;
};

} // namespace uvol_tools
