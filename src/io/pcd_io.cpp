// SPDX-License-Identifier: BSD-3-Clause
// PCD files: pcl::PCDReader takes garbage for zeros and maps truncated files, so the
// header is checked and the body read here.
#include "common/numbers.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/columns.h"
#include "io/files.h"
#include "io/formats.h"
#include "io/label_comments.h"
#include "io/memory_need.h"
#include "io/record_source.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <liblzf/lzf.h>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;
using Words = std::vector<std::string_view>;

enum class Encoding { Ascii, Binary, Compressed };

struct Header {
  RecordInfo info;
  Encoding encoding = Encoding::Ascii;
  std::uint64_t body = 0; ///< where the points start
};

/** A word of the header gives at most that many bytes per field. */
constexpr std::uint64_t most_components = 1u << 20;
/** LZF makes at most 264 bytes of 3. */
constexpr std::uint64_t lzf_expansion = 88;

std::uint8_t
parseDatatype(std::string_view type, std::string_view size)
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
    if (size.size() == 1 && size[0] == known.size && type.size() == 1 &&
        lowerCase(type)[0] == lowerCase({&known.type, 1})[0])
      return static_cast<std::uint8_t>(known.datatype);
  return 0;
}

/** Parses the lines of a header, up to DATA. */
class PcdHeaderParser {
public:
  explicit PcdHeaderParser(const std::string& path)
      : path_(path)
  {
  }

  /** \return true after the line that ends the header */
  bool
  take(std::string_view line, std::size_t number);

  /** The header but for the place of the body. */
  Header
  finish() const;

private:
  std::uint64_t
  countIn(const Words& words) const;

  std::string
  nameOf(const std::string& name) const;

  const std::string& path_;
  std::size_t line_ = 0;
  std::vector<std::string> names_, sizes_, types_, counts_;
  std::uint64_t width_ = 0, height_ = 0, points_ = 0;
  bool has_width_ = false, has_height_ = false, has_points_ = false;
  Encoding encoding_ = Encoding::Ascii;
  LabelNames labels_;
};

std::uint64_t
PcdHeaderParser::countIn(const Words& words) const
{
  std::uint64_t value = 0;
  if (words.size() != 2 || !parseCount(words[1], value))
    throwUnreadable(
        path_, line_, {"incomplete_entry", quoteText(words[0]), "one count"});
  return value;
}

bool
PcdHeaderParser::take(std::string_view line, std::size_t number)
{
  line_ = number;
  Words words;
  splitWords(line, words);
  if (words.empty())
    return false;
  if (words[0][0] == '#') {
    takeLabelComment(line.substr(line.find('#') + 1), labels_);
    return false;
  }
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
      throwUnreadable(path_,
                      line_,
                      {"unsupported_value",
                       "DATA",
                       shortenText(words.size() > 1 ? words[1] : ""),
                       "ascii, binary and binary_compressed"});
    return true;
  }
  else if (key != "VERSION" && key != "VIEWPOINT")
    throwUnreadable(path_, line_, {"foreign_line", "a PCD header"});
  return false;
}

/** Coordinates may be in capitals. */
std::string
PcdHeaderParser::nameOf(const std::string& name) const
{
  const std::string lower = lowerCase(name);
  const bool is_axis = lower.size() == 1 && lower[0] >= 'x' && lower[0] <= 'z';
  return is_axis && std::find(names_.begin(), names_.end(), lower) == names_.end()
             ? lower
             : name;
}

Header
PcdHeaderParser::finish() const
{
  if (names_.empty() || sizes_.size() != names_.size() ||
      types_.size() != names_.size() ||
      (!counts_.empty() && counts_.size() != names_.size()))
    throwUnreadable(
        path_, {"disagreeing_parts", "FIELDS, SIZE, TYPE and COUNT of its header"});
  Header header;
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const std::uint8_t datatype = parseDatatype(types_[i], sizes_[i]);
    if (datatype == 0)
      throwUnreadable(path_,
                      {"unsupported_value",
                       "the type of the field " + quoteText(names_[i]),
                       shortenText(types_[i] + " of size " + sizes_[i]),
                       "F of 4 and 8, I and U of 1, 2, 4 and 8"});
    std::uint64_t count = 1;
    if (!counts_.empty() &&
        (!parseCount(counts_[i], count) || count < 1 || count > most_components))
      throwUnreadable(path_,
                      {"unsupported_value",
                       "COUNT of the field " + quoteText(names_[i]),
                       shortenText(counts_[i]),
                       "1 to " + std::to_string(most_components)});
    bytes += count * datatypeSize(datatype);
    if (bytes > most_points)
      throwUnreadable(path_, {"uncountable", "bytes per point"});
    appendField(header.info.fields, nameOf(names_[i]), datatype, count);
  }
  const std::uint64_t height = has_height_ ? height_ : 1;
  if (!has_points_ && !has_width_)
    throwUnreadable(path_, {"missing_part", "POINTS or WIDTH of its header"});
  if (has_width_ && height != 0 && width_ > UINT64_MAX / height)
    throwUnreadable(path_, {"uncountable", "points"});
  header.info.count = has_points_ ? points_ : width_ * height;
  if (has_width_ && width_ * height != header.info.count)
    throwUnreadable(
        path_,
        {"wrong_count", "its header", header.info.count, "POINTS", width_ * height});
  header.encoding = encoding_;
  header.info.labels = labels_;
  return header;
}

Header
readHeader(FileCursor& cursor, const std::string& path)
{
  PcdHeaderParser parser(path);
  std::string_view line;
  while (cursor.nextLine(line))
    if (parser.take(line, cursor.tell().line)) {
      Header header = parser.finish();
      header.body = cursor.tell().offset;
      return header;
    }
  throwUnreadable(path, {"missing_part", "the DATA line of its header"});
}

[[noreturn]] void
throwTruncated(const std::string& path, std::uint64_t count, std::uint64_t left)
{
  throwUnreadable(path, {"truncated_data", count, "points", left});
}

/** Bytes of the packed and of the unpacked points, as far as the file can hold them. */
std::array<std::uint32_t, 2>
compressedSizes(const InputFile& file, const std::string& path, const Header& header)
{
  const std::uint64_t body = header.body;
  const std::uint64_t left = file.getSize() - body, count = header.info.count;
  const std::uint64_t step = recordBytes(header.info.fields);
  std::array<std::uint32_t, 2> sizes{};
  if (count > 0) {
    if (left < sizeof(sizes))
      throwTruncated(path, count, left);
    file.read(body, sizes.data(), sizeof(sizes));
    if (sizes[0] > left - sizeof(sizes) || count > sizes[0] * lzf_expansion / step)
      throwTruncated(path, count, left);
    if (sizes[1] != count * step)
      throwUnreadable(
          path,
          {"wrong_count", "the compressed body", sizes[1], "bytes", count * step});
  }
  return sizes;
}

pcl::PCLPointCloud2
readCompressed(const InputFile& file, const std::string& path, const Header& header)
{
  const std::array<std::uint32_t, 2> sizes = compressedSizes(file, path, header);
  const std::uint64_t count = header.info.count;
  const std::uint64_t step = recordBytes(header.info.fields);
  checkReading(header.info, sizes[0], 0);
  auto records = makeRecords(header.info.fields, count);
  if (count == 0)
    return records;
  std::vector<std::uint8_t> packed(sizes[0]), unpacked(sizes[1]);
  file.read(header.body + sizeof(sizes), packed.data(), packed.size());
  if (lzf_decompress(packed.data(), sizes[0], unpacked.data(), sizes[1]) != sizes[1])
    throwUnreadable(path, "damaged_compression");
  const std::uint8_t* from = unpacked.data(); // all of one field, then the next
  for (const auto& field : records.fields) {
    const std::size_t bytes = fieldBytes(field);
    std::uint8_t* to = records.data.data() + field.offset;
    for (std::uint64_t i = 0; i < count; ++i, from += bytes, to += step)
      std::memcpy(to, from, bytes);
  }
  return records;
}

/** Points as lines of numbers. */
class AsciiSource : public SequentialSource {
public:
  AsciiSource(const std::string& path,
              std::unique_ptr<FileCursor> cursor,
              const RecordInfo& info);

private:
  void
  readRecord(std::uint8_t* record) override;
  void
  skipRecord() override
  {
    nextWords();
  }
  void
  finish() override;
  void
  nextWords();
  void
  splitAtCommas();

  std::size_t numbers_ = 0; ///< of a point
  Words words_;
  std::string line_; ///< what they are parts of, where commas are between them
};

AsciiSource::AsciiSource(const std::string& path,
                         std::unique_ptr<FileCursor> cursor,
                         const RecordInfo& info)
    : SequentialSource(path, std::move(cursor), info)
{
  for (const auto& field : info_.fields)
    numbers_ += field.count;
  const std::uint64_t left = cursor_->left();
  if (info_.count > (left + 1) / (2 * numbers_)) // a digit and a blank
    throwTruncated(path, info_.count, left);
}

void
AsciiSource::nextWords()
{
  if (!cursor_->nextWords(words_))
    throwUnreadable(path_, {"truncated_rows", info_.count, "points", next_ - 1});
}

/** Numbers may have commas between them, all of them. */
void
AsciiSource::splitAtCommas()
{
  line_.clear();
  for (const std::string_view word : words_)
    line_ += std::string(line_.empty() ? "" : " ") + std::string(word);
  Words parts;
  for (std::size_t at = 0; at <= line_.size();) {
    const std::size_t end = std::min(line_.find(',', at), line_.size());
    parts.push_back(trimmed(std::string_view(line_).substr(at, end - at)));
    at = end + 1;
  }
  if (parts.size() == numbers_)
    words_ = parts;
}

void
AsciiSource::readRecord(std::uint8_t* record)
{
  nextWords();
  if (words_.size() < numbers_ || words_[0].find(',') != std::string_view::npos)
    splitAtCommas();
  if (words_.size() != numbers_)
    throwUnreadable(path_,
                    cursor_->tell().line,
                    {"wrong_count", "the line", words_.size(), "numbers", numbers_});
  const auto* word = words_.data();
  for (const auto& field : info_.fields) {
    const std::size_t bytes = datatypeSize(field.datatype);
    for (std::size_t i = 0; i < field.count; ++i, ++word)
      if (!parseNumber(*word, field.datatype, record + field.offset + i * bytes))
        throwUnreadable(path_,
                        cursor_->tell().line,
                        {"unexpected_word",
                         shortenText(*word),
                         "a number for the field " + describeFields({field})});
  }
}

void
AsciiSource::finish()
{
  if (cursor_->nextWords(words_))
    throwUnreadable(
        path_,
        cursor_->tell().line,
        {"too_many_parts", "it", info_.count, "points, which its header promises"});
}

std::unique_ptr<RecordSource>
makeSource(const std::string& path,
           std::unique_ptr<FileCursor> cursor,
           const Header& header)
{
  if (header.encoding == Encoding::Ascii)
    return std::make_unique<AsciiSource>(path, std::move(cursor), header.info);
  const std::uint64_t left = cursor->left();
  if (header.info.count > left / recordBytes(header.info.fields))
    throwTruncated(path, header.info.count, left);
  return std::make_unique<FixedSource>(path, header.info, header.body, false);
}

std::string
makeHeader(const Dataset& dataset, const Fields& fields, const SaveOptions& options)
{
  std::vector<std::string> names, comments = options.comments;
  for (const auto& field : fields)
    names.push_back(field.name);
  const std::vector<std::string> originals = names;
  makeWords(names, comments);
  addLabelComments(dataset, originals, names, comments);
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
  const std::string points =
      std::to_string(std::size_t{dataset.cloud.width} * dataset.cloud.height);
  return text + "\nSIZE" + sizes + "\nTYPE" + types + "\nCOUNT" + counts + "\nWIDTH " +
         points + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " +
         (options.ascii ? "ascii" : "binary") + '\n';
}

} // namespace

Dataset
readPcd(const std::string& path, const ProgressCallback& progress)
{
  auto cursor = std::make_unique<FileCursor>(path);
  const Header header = readHeader(*cursor, path);
  if (header.encoding == Encoding::Compressed)
    return makeDataset(readCompressed(cursor->getFile(), path, header), header.info);
  return readWhole(makeSource(path, std::move(cursor), header), progress);
}

std::unique_ptr<RecordSource>
openPcd(const std::string& path)
{
  auto cursor = std::make_unique<FileCursor>(path);
  const Header header = readHeader(*cursor, path);
  if (header.encoding == Encoding::Compressed)
    throwNoStream(path, "points compressed as binary_compressed");
  return makeSource(path, std::move(cursor), header);
}

std::optional<CompressedInfo>
findCompressed(const std::string& path)
{
  FileCursor cursor(path);
  const Header header = readHeader(cursor, path);
  if (header.encoding != Encoding::Compressed)
    return std::nullopt;
  return CompressedInfo{header.info,
                        compressedSizes(cursor.getFile(), path, header)[0]};
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
  OutputFile out(file, path);
  out.buffer() = makeHeader(dataset, fields, options);
  writeRecords(out, dataset, findColumns(dataset, fields), options);
  out.close();
}

} // namespace io
} // namespace pcl_uvol
