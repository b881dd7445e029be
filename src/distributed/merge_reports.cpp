// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/merge_reports.h"

#include "distributed/byte_stream.h"

#include <algorithm>
#include <variant>

namespace pcl_uvol {

namespace {

void
put(ByteWriter& writer, const std::string& text)
{
  writer.put(std::vector<char>(text.begin(), text.end()));
}

std::string
getText(ByteReader& reader)
{
  std::vector<char> text;
  reader.get(text);
  return {text.begin(), text.end()};
}

void
put(ByteWriter& writer, const Message& warning)
{
  put(writer, warning.code);
  put(writer, warning.about);
  writer.put(warning.values.size());
  for (const auto& [name, value] : warning.values) {
    const auto* const number = std::get_if<double>(&value);
    put(writer, name);
    writer.put(number != nullptr);
    if (number != nullptr)
      writer.put(*number);
    else
      put(writer, std::get<std::string>(value));
  }
}

Message
getWarning(ByteReader& reader)
{
  Message warning(getText(reader), {});
  warning.about = getText(reader);
  for (auto count = reader.get<std::size_t>(); count > 0; --count) {
    const std::string name = getText(reader);
    if (reader.get<bool>())
      warning.values.emplace_back(name, reader.get<double>());
    else
      warning.values.emplace_back(name, getText(reader));
  }
  return warning;
}

Bytes
toBytes(const Report& report)
{
  Bytes bytes;
  ByteWriter writer(bytes);
  const auto putAll = [&](const auto& entries) {
    writer.put(entries.size());
    for (const auto& [name, value] : entries) {
      put(writer, name);
      writer.put(value);
    }
  };
  putAll(report.counts);
  putAll(report.milliseconds);
  writer.put(report.warnings.size());
  for (const Message& warning : report.warnings)
    put(writer, warning);
  return bytes;
}

Report
fromBytes(const Bytes& bytes)
{
  Report report;
  ByteReader reader(bytes);
  for (auto count = reader.get<std::size_t>(); count > 0; --count) {
    const std::string name = getText(reader);
    report.count(name, reader.get<std::uint64_t>());
  }
  for (auto count = reader.get<std::size_t>(); count > 0; --count) {
    const std::string step = getText(reader);
    report.time(step, reader.get<double>());
  }
  for (auto count = reader.get<std::size_t>(); count > 0; --count)
    report.warn({getWarning(reader)});
  return report;
}

/** Let the largest value of a name stand. */
template <typename T>
void
keepLargest(std::vector<std::pair<std::string, T>>& entries,
            const std::string& name,
            T value)
{
  const auto same = std::find_if(entries.begin(), entries.end(), [&](const auto& one) {
    return one.first == name;
  });
  if (same == entries.end())
    entries.emplace_back(name, value);
  else
    same->second = std::max(same->second, value);
}

} // namespace

Report
mergeReports(const Report& report,
             Communicator& communicator,
             const std::vector<std::string>& largest)
{
  Report merged;
  std::vector<std::pair<std::string, std::uint64_t>> most;
  for (const Bytes& bytes : communicator.allGather(toBytes(report))) {
    const Report other = fromBytes(bytes);
    for (const auto& [name, value] : other.counts)
      merged.count(name, value);
    for (const std::string& name : largest)
      keepLargest(most, "largest_" + name, other.getCount(name));
    for (const auto& [step, value] : other.milliseconds)
      keepLargest(merged.milliseconds, step, value);
    merged.warn(other.warnings);
  }
  merged.counts.insert(merged.counts.end(), most.begin(), most.end());
  return merged;
}

} // namespace pcl_uvol
