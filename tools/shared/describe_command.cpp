// SPDX-License-Identifier: BSD-3-Clause
// Where a picture is from, for whoever finds it years later.
#include "common/printable.h"
#include "shared/options.h"
#include <pcl_uvol/io/image_file.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace uvol_tools {

namespace {

/** A word as a shell takes it. */
std::string
quoted(const std::string& word)
{
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                "0123456789+-.,:=@%^/_";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos)
    return word;
  std::string text = "'";
  for (const char c : word)
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string
fileOf(const std::string& path)
{
  return std::filesystem::path(path).filename().string();
}

/** A result has the same name in all commands: pictures of the same are the same. */
std::string
resultOf(const std::string& path)
{
  return "out" + std::filesystem::path(path).extension().string();
}

} // namespace

std::string
Options::describeCommand() const
{
  constexpr std::array<const char*, 4> without_effect = {
      "threads", "max-memory", "v", "json"};
  std::string text = tool_;
  for (std::size_t i = 0; i < command_.size(); ++i) {
    const std::string& word = command_[i];
    const auto option =
        std::find_if(options_.begin(), options_.end(), [&](const Option& known) {
          return word == "-" + known.name;
        });
    if (option == options_.end()) {
      text += ' ' + quoted(word == output_ ? resultOf(word) : fileOf(word));
      continue;
    }
    const bool has_value = option->flag == nullptr;
    if (std::find(without_effect.begin(), without_effect.end(), option->name) ==
        without_effect.end()) {
      text += ' ' + word;
      if (has_value)
        text += ' ' + quoted(option->written != nullptr ? resultOf(command_[i + 1])
                                                        : command_[i + 1]);
    }
    i += has_value ? 1 : 0;
  }
  return text;
}

std::vector<pcl_uvol::ImageText>
describeOrigin(const Options& options)
{
  return {{"Software", std::string("pcl_uvol ") + PCL_UVOL_VERSION},
          {"Command", pcl_uvol::printable(options.describeCommand())}};
}

} // namespace uvol_tools
