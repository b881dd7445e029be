// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/typed_number.h"

#include "common/numbers.h"
#include "common/printable.h"
#include <pcl_uvol/common/exceptions.h>

#include <cstring>

namespace uvol_tools {

namespace {

constexpr char backspace = '\b', delete_key = '\x7f', escape = '\x1b';

} // namespace

std::optional<double>
TypedNumber::press(char key)
{
  if (key == '=' || key == escape) {
    is_begun_ = key == '=';
    text_.clear();
    return std::nullopt;
  }
  if (key == backspace || key == delete_key) {
    if (!text_.empty())
      text_.pop_back();
    return std::nullopt;
  }
  if (key != '\r' && key != '\n') {
    if (key != '\0' && std::strchr("0123456789.eE+-", key) != nullptr)
      text_ += key;
    return std::nullopt;
  }
  is_begun_ = false;
  double number = 0.0;
  if (!pcl_uvol::parseNumber(text_, number))
    throw pcl_uvol::InvalidArgument("not_a_number",
                                    {{"text", pcl_uvol::quoteText(text_)}});
  return number;
}

} // namespace uvol_tools
