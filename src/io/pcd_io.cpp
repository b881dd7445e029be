// SPDX-License-Identifier: BSD-3-Clause
// PCD files: pcl::PCDReader takes garbage for zeros and maps truncated files, so the
// header is checked and the body read here.
#include "columns.h"
#include "files.h"
#include "formats.h"
#include "numbers.h"
#include <pcl_uvol/common/scalar_field.h>

#include <pcl/io/lzf.h>

#include <algorithm>
#include <cstring>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;
using Words = std::vector<std::string_view>;

enum class Encoding { Ascii, Binary, Compressed };

struct Header {
  Fields fields;
  std::uint64_t count = 0;
  Encoding encoding = Encoding::Ascii;
  std::uint64_t body = 0; ///< where the points start
  std::size_t lines = 0;
};

/** A word of the header gives at most that many bytes per field. */
constexpr std::uint64_t most_components = 1u << 20;
/** LZF makes at most 264 bytes of 3. */
constexpr std::uint64_t most_expansion = 88;

std::uint8_t
datatypeOf(std::string_view type, std::string_view size)
{
  constexpr struct {
    char type, size;
    Type::PointFieldTypes datatype;
  } types[] = {{'F', '4', Type::FLOAT32},
               {'F', '8', Type::FLOAT64},
               {'I', '1', Type::INT8},
               {'I', '2', Type::INT16},
               {'I', '4', Type::INT32},
               {'I', '8', Type::INT64},
               {'U', '1', Type::UINT8},
               {'U', '2', Type::UINT16},
               {'U', '4', Type::UINT32},
               {'U', '8', Type::UINT64}};
  for (const auto& known : types)
    if (type.size() == 1 && size.size() == 1 && type[0] == known.type &&
        size[0] == known.size)
      return static_cast<std::uint8_t>(known.datatype);
  return 0;
}

/** Parses the lines of a header, up to DATA. */
class HeaderParser {
public:
  explicit HeaderParser(const std::string& path)
      : path_(path)
  {
  }

  /** \return true after the line that ends the header */
  bool
  take(std::string_view line, std::size_t number);

  Header
  finish(std::uint64_t body) const;

private:
  std::uint64_t
  countIn(const Words& words) const;

  const std::string& path_;
  std::size_t line_ = 0;
  std::vector<std::string> names_, sizes_, types_, counts_;
  std::uint64_t width_ = 0, height_ = 0, points_ = 0;
  bool has_width_ = false, has_height_ = false, has_points_ = false;
  Encoding encoding_ = Encoding::Ascii;
};

std::uint64_t
HeaderParser::countIn(const Words& words) const
{
  std::uint64_t value = 0;
  if (words.size() != 2 || !parseCount(words[1], value))
    throwUnreadable(path_, line_, std::string(words[0]) + " is no count");
  return value;
}

bool
HeaderParser::take(std::string_view line, std::size_t number)
{
  line_ = number;
  Words words;
  splitWords(line, words);
  if (words.empty() || words[0][0] == '#')
    return false;
  const std::string_view key = words[0];
  const auto rest = [&words] {
    return std::vector<std::string>(words.begin() + 1, words.end());
  };
  if (key == "FIELDS" || key == "COLUMNS")
    names_ = rest();
  else if (key == "SIZE")
    sizes_ = rest();
  else if (key == "TYPE")
    types_ = rest();
  else if (key == "COUNT")
    counts_ = rest();
  else if (key == "WIDTH") {
    width_ = countIn(words);
    has_width_ = true;
  }
  else if (key == "HEIGHT") {
    height_ = countIn(words);
    has_height_ = true;
  }
  else if (key == "POINTS") {
    points_ = countIn(words);
    has_points_ = true;
  }
  else if (key == "DATA") {
    if (words.size() == 2 && words[1] == "ascii")
      encoding_ = Encoding::Ascii;
    else if (words.size() == 2 && words[1] == "binary")
      encoding_ = Encoding::Binary;
    else if (words.size() == 2 && words[1] == "binary_compressed")
      encoding_ = Encoding::Compressed;
    else
      throwUnreadable(
          path_, line_, "DATA is none of ascii, binary and binary_compressed");
    return true;
  }
  else if (key != "VERSION" && key != "VIEWPOINT")
    throwUnreadable(path_, line_, "this is no line of a PCD header");
  return false;
}

Header
HeaderParser::finish(std::uint64_t body) const
{
  if (names_.empty() || sizes_.size() != names_.size() ||
      types_.size() != names_.size() ||
      (!counts_.empty() && counts_.size() != names_.size()))
    throwUnreadable(path_, "FIELDS, SIZE, TYPE and COUNT of its header do not agree");
  Header header;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const std::uint8_t datatype = datatypeOf(types_[i], sizes_[i]);
    if (datatype == 0)
      throwUnreadable(path_,
                      "the field '" + names_[i] + "' has the type " + types_[i] +
                          " of size " + sizes_[i] +
                          "; allowed are F of 4 and 8, I and U of 1, 2, 4 and 8");
    std::uint64_t count = 1;
    if (!counts_.empty() &&
        (!parseCount(counts_[i], count) || count < 1 || count > most_components))
      throwUnreadable(path_,
                      "the field '" + names_[i] + "' has the COUNT " + counts_[i] +
                          "; allowed is 1 to " + std::to_string(most_components));
    appendField(header.fields, names_[i], datatype, count);
  }
  const std::uint64_t height = has_height_ ? height_ : 1;
  if (!has_points_ && !has_width_)
    throwUnreadable(path_, "its header has neither POINTS nor WIDTH");
  if (has_width_ && height != 0 && width_ > UINT64_MAX / height)
    throwUnreadable(path_, "WIDTH and HEIGHT of its header are too large");
  header.count = has_points_ ? points_ : width_ * height;
  if (has_width_ && width_ * height != header.count)
    throwUnreadable(path_,
                    "its header has " + std::to_string(header.count) +
                        " POINTS, but WIDTH " + std::to_string(width_) +
                        " and HEIGHT " + std::to_string(height));
  header.encoding = encoding_;
  header.body = body;
  header.lines = line_;
  return header;
}

Header
readHeader(const InputFile& file, const std::string& path)
{
  // fits nearly every header; a longer one is read again, up to the whole file
  for (std::uint64_t bytes = 1u << 14;; bytes *= 16) {
    const std::string head = file.head(bytes);
    HeaderParser parser(path);
    Lines lines(head);
    std::string_view line;
    while (lines.next(line)) {
      const bool complete = !lines.rest().empty() || head.size() == file.getSize();
      if (!complete)
        break;
      if (parser.take(line, lines.lineNumber()))
        return parser.finish(head.size() - lines.rest().size());
    }
    if (head.size() == file.getSize())
      throwUnreadable(path, "its header has no DATA line");
  }
}

[[noreturn]] void
throwTruncated(const std::string& path, std::uint64_t count, std::uint64_t left)
{
  throwUnreadable(path,
                  "it is truncated or damaged: its header promises " +
                      std::to_string(count) + " points, but only " +
                      std::to_string(left) + " bytes follow");
}

/** Points of which a body of that size may hold the numbers. */
std::uint64_t
mostPoints(const Header& header, std::uint64_t left)
{
  std::uint64_t numbers = 0;
  for (const auto& field : header.fields)
    numbers += field.count;
  const std::uint64_t step = recordBytes(header.fields);
  switch (header.encoding) {
  case Encoding::Ascii:
    return (left + 1) / (2 * numbers); // a digit and a blank
  case Encoding::Binary:
    return left / step;
  default:
    return left * most_expansion / step;
  }
}

pcl::PCLPointCloud2
readBinary(const InputFile& file, const std::string& path, Header& header)
{
  const std::uint64_t left = file.getSize() - header.body;
  if (header.count > mostPoints(header, left))
    throwTruncated(path, header.count, left);
  auto records = makeRecords(path, std::move(header.fields), header.count);
  file.read(header.body, records.data.data(), records.data.size());
  return records;
}

pcl::PCLPointCloud2
readCompressed(const InputFile& file, const std::string& path, Header& header)
{
  const std::uint64_t left = file.getSize() - header.body;
  const std::uint64_t step = recordBytes(header.fields);
  std::uint32_t sizes[2] = {0, 0};
  if (header.count > 0) {
    if (left < sizeof(sizes))
      throwTruncated(path, header.count, left);
    file.read(header.body, sizes, sizeof(sizes));
    if (sizes[0] > left - sizeof(sizes) ||
        header.count > sizes[0] * most_expansion / step)
      throwTruncated(path, header.count, left);
    if (sizes[1] != header.count * step)
      throwUnreadable(path,
                      "its compressed data hold " + std::to_string(sizes[1]) +
                          " bytes, but its header promises " +
                          std::to_string(header.count * step));
  }
  auto records = makeRecords(path, std::move(header.fields), header.count);
  if (header.count == 0)
    return records;
  std::vector<std::uint8_t> packed(sizes[0]), unpacked(sizes[1]);
  file.read(header.body + sizeof(sizes), packed.data(), packed.size());
  if (pcl::lzfDecompress(packed.data(), sizes[0], unpacked.data(), sizes[1]) !=
      sizes[1])
    throwUnreadable(path, "its compressed data are damaged");
  const std::uint8_t* from = unpacked.data(); // all of one field, then the next
  for (const auto& field : records.fields) {
    const std::size_t bytes = fieldBytes(field);
    std::uint8_t* to = records.data.data() + field.offset;
    for (std::uint64_t i = 0; i < header.count; ++i, from += bytes, to += step)
      std::memcpy(to, from, bytes);
  }
  return records;
}

pcl::PCLPointCloud2
readAscii(const InputFile& file, const std::string& path, Header& header)
{
  const std::uint64_t left = file.getSize() - header.body;
  std::uint64_t numbers = 0;
  for (const auto& field : header.fields)
    numbers += field.count;
  if (header.count > mostPoints(header, left))
    throwTruncated(path, header.count, left);
  auto records = makeRecords(path, std::move(header.fields), header.count);
  std::string text(left, '\0');
  file.read(header.body, text.data(), left);
  Lines lines(text, header.lines);
  std::string_view line;
  Words words;
  std::uint64_t count = 0;
  while (lines.next(line)) {
    splitWords(line, words);
    if (words.empty())
      continue;
    if (count == header.count)
      throwUnreadable(path,
                      lines.lineNumber(),
                      "it holds more than the " + std::to_string(count) +
                          " points that its header promises");
    if (words.size() != numbers)
      throwUnreadable(path,
                      lines.lineNumber(),
                      "there are " + std::to_string(words.size()) + " numbers where " +
                          std::to_string(numbers) + " belong");
    std::uint8_t* const point =
        records.data.data() + records.point_step * std::size_t(count++);
    const auto* word = words.data();
    for (const auto& field : records.fields) {
      const std::size_t bytes = datatypeSize(field.datatype);
      for (std::size_t i = 0; i < field.count; ++i, ++word)
        if (!parseNumber(*word, field.datatype, point + field.offset + i * bytes))
          throwUnreadable(path,
                          lines.lineNumber(),
                          "'" + std::string(*word) + "' is no number for the field " +
                              describeFields({field}));
    }
  }
  if (count < header.count)
    throwUnreadable(path,
                    "it is truncated: its header promises " +
                        std::to_string(header.count) + " points, but only " +
                        std::to_string(count) + " lines follow");
  return records;
}

std::string
makeHeader(const Fields& fields, std::uint64_t count, const SaveOptions& options)
{
  std::vector<std::string> names, comments = options.comments;
  for (const auto& field : fields)
    names.push_back(field.name);
  makeWords(names, comments);
  std::string text = "# .PCD v0.7 - Point Cloud Data file format\n";
  for (std::string comment : comments) {
    std::replace(comment.begin(), comment.end(), '\n', ' ');
    text += "# " + comment + '\n';
  }
  std::string sizes, types, counts;
  text += "VERSION 0.7\nFIELDS";
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::uint8_t datatype = fields[i].datatype;
    const bool real = datatype == Type::FLOAT32 || datatype == Type::FLOAT64;
    const bool has_sign = datatype == Type::INT8 || datatype == Type::INT16 ||
                          datatype == Type::INT32 || datatype == Type::INT64;
    text += ' ' + names[i];
    sizes += ' ' + std::to_string(datatypeSize(datatype));
    types += real ? " F" : has_sign ? " I" : " U";
    counts += ' ' + std::to_string(fields[i].count);
  }
  const std::string points = std::to_string(count);
  return text + "\nSIZE" + sizes + "\nTYPE" + types + "\nCOUNT" + counts + "\nWIDTH " +
         points + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " +
         (options.ascii ? "ascii" : "binary") + '\n';
}

} // namespace

std::optional<PromisedCloud>
promisePcd(const std::string& path)
{
  const InputFile file(path);
  const Header header = readHeader(file, path);
  const std::uint64_t left = file.getSize() - header.body;
  if (header.count > mostPoints(header, left))
    return std::nullopt;
  double beside = 0.0;
  if (header.encoding != Encoding::Binary)
    beside += static_cast<double>(left);
  if (header.encoding == Encoding::Compressed) // unpacked, field by field
    beside += static_cast<double>(header.count) *
              static_cast<double>(recordBytes(header.fields));
  return promiseOf(header.fields, header.count, beside);
}

Dataset
readPcd(const std::string& path)
{
  const InputFile file(path);
  Header header = readHeader(file, path);
  switch (header.encoding) {
  case Encoding::Ascii:
    return makeDataset(path, readAscii(file, path, header));
  case Encoding::Binary:
    return makeDataset(path, readBinary(file, path, header));
  default:
    return makeDataset(path, readCompressed(file, path, header));
  }
}

void
writePcd(const std::string& file,
         const std::string& path,
         const Dataset& dataset,
         const SaveOptions& options)
{
  Fields fields = savedFields(dataset);
  // packed colours are bits, not a number: as text PCL writes them as integers, too
  for (auto& field : fields)
    if (options.ascii && field.name == "rgb" && field.datatype == Type::FLOAT32)
      field.datatype = Type::UINT32;
  const std::size_t count =
      static_cast<std::size_t>(dataset.cloud.width) * dataset.cloud.height;
  OutputFile out(file, path);
  out.buffer() = makeHeader(fields, count, options);
  writeRecords(out, dataset, columnsOf(dataset, fields), options.ascii);
  out.close();
}

} // namespace io
} // namespace pcl_uvol
