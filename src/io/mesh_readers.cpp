// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_readers.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "io/file_cursor.h"
#include "io/files.h"
#include "io/ply_types.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace pcl_uvol {
namespace io {

namespace {

using Words = std::vector<std::string_view>;
using Corner = std::array<double, 3>;

/** Gathers vertices and triangles. */
class MeshBuilder {
public:
  explicit MeshBuilder(const std::string& path)
      : path_(path)
  {
  }

  void
  addVertex(const Corner& place)
  {
    if (countVertices() == std::numeric_limits<std::uint32_t>::max())
      throwUnreadable(path_, {"uncountable", "vertices"});
    xyz_.insert(xyz_.end(), place.begin(), place.end());
  }

  std::size_t
  countVertices() const
  {
    return xyz_.size() / 3;
  }

  /** A fan of the triangles of a polygon, whose vertices may follow. */
  void
  addPolygon(const std::vector<std::uint32_t>& corners)
  {
    for (std::size_t k = 2; k < corners.size(); ++k)
      triangles_.push_back({corners[0], corners[k - 1], corners[k]});
  }

  /** \param normals three numbers per vertex, or none */
  LoadedMesh
  build(const std::vector<float>& normals = {})
  {
    for (const Triangle& triangle : triangles_)
      for (const std::uint32_t vertex : triangle)
        if (vertex >= countVertices())
          throwUnreadable(path_, {"missing_target", "a face", "a vertex"});
    LoadedMesh mesh;
    mesh.triangles = std::move(triangles_);
    mesh.vertices.double_coordinates = true;
    mesh.vertices.cloud.width = static_cast<std::uint32_t>(countVertices());
    mesh.vertices.cloud.height = 1;
    setCoordinates(mesh.vertices, xyz_);
    for (std::size_t axis = 0; axis < 3 && !normals.empty(); ++axis) {
      std::vector<float> column;
      for (std::size_t i = axis; i < normals.size(); i += 3)
        column.push_back(normals[i]);
      setField(mesh.vertices, cloud_normals[axis], column);
    }
    return mesh;
  }

private:
  const std::string& path_;
  std::vector<double> xyz_;
  std::vector<Triangle> triangles_;
};

/** Lines of words, without comments. */
class MeshText {
public:
  explicit MeshText(const std::string& path)
      : path_(path)
      , cursor_(path, FileCursor::Content::Text)
  {
  }

  /** \return false after the last line that has words */
  bool
  next(Words& words)
  {
    while (cursor_.nextWords(words)) {
      const auto comment = std::find_if(
          words.begin(), words.end(), [](std::string_view w) { return w[0] == '#'; });
      words.erase(comment, words.end());
      if (!words.empty())
        return true;
    }
    return false;
  }

  [[noreturn]] void
  fail(const FileReason& reason) const
  {
    throwUnreadable(path_, cursor_.tell().line, reason);
  }

  /** Three numbers, from that word on. */
  Corner
  takeNumbers(const Words& words, std::size_t first) const
  {
    Corner numbers{};
    if (words.size() < first + 3)
      fail({"incomplete_entry", "a corner", "three coordinates"});
    for (std::size_t i = 0; i < 3; ++i)
      if (!parseNumber(words[first + i], numbers[i]))
        fail({"unexpected_word", shortenText(words[first + i]), "a number"});
    return numbers;
  }

  std::uint64_t
  takeCount(std::string_view word) const
  {
    std::uint64_t count = 0;
    if (!parseCount(word, count))
      fail({"unexpected_word", shortenText(word), "a number of vertices or faces"});
    return count;
  }

private:
  const std::string& path_;
  FileCursor cursor_;
};

/** Reads the lines of an .obj. */
class ObjReader {
public:
  explicit ObjReader(const std::string& path)
      : text_(path)
      , builder_(path)
  {
  }

  LoadedMesh
  read()
  {
    Words words;
    while (text_.next(words)) {
      if (words[0] == "v")
        builder_.addVertex(text_.takeNumbers(words, 1));
      else if (words[0] == "vn")
        normals_.push_back(text_.takeNumbers(words, 1));
      else if (words[0] == "f")
        takeFace(words);
    }
    return builder_.build(collectNormals());
  }

private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /** Corners as vertex, vertex/texture, vertex//normal or vertex/texture/normal. */
  void
  takeFace(const Words& words)
  {
    corners_.clear();
    for (std::size_t k = 1; k < words.size(); ++k) {
      const std::string_view word = words[k];
      const std::size_t slash = word.find('/'), last = word.rfind('/');
      corners_.push_back(indexIn(word.substr(0, slash), builder_.countVertices()));
      const bool has_normal = slash != word.npos && last > slash;
      setNormal(corners_.back(),
                has_normal ? indexIn(word.substr(last + 1), normals_.size()) : none);
    }
    if (corners_.size() < 3)
      text_.fail({"incomplete_entry", "a face", "at least three corners"});
    builder_.addPolygon(corners_);
  }

  /** Numbers begin at 1; negative ones count from the last that was read. */
  std::uint32_t
  indexIn(std::string_view word, std::size_t count) const
  {
    const bool is_backwards = !word.empty() && word[0] == '-';
    std::uint64_t number = 0;
    if (!parseCount(is_backwards ? word.substr(1) : word, number) || number == 0 ||
        number >= none || (is_backwards && number > count))
      text_.fail(
          {"unexpected_word", shortenText(word), "the number of a vertex or normal"});
    return static_cast<std::uint32_t>(is_backwards ? count - number : number - 1);
  }

  void
  setNormal(std::uint32_t vertex, std::uint32_t normal)
  {
    if (vertex >= builder_.countVertices()) {
      has_normals_ = false; // build() refuses the vertex unless it follows
      return;
    }
    normal_of_.resize(builder_.countVertices(), none);
    if (normal_of_[vertex] == none)
      normal_of_[vertex] = normal;
    has_normals_ = has_normals_ && normal_of_[vertex] == normal;
  }

  std::vector<float>
  collectNormals() const
  {
    std::vector<float> numbers;
    if (!has_normals_ || normals_.empty())
      return numbers;
    numbers.resize(3 * builder_.countVertices());
    for (std::size_t vertex = 0; vertex < normal_of_.size(); ++vertex) {
      const std::uint32_t normal = normal_of_[vertex];
      if (normal == none) // no face has the vertex
        continue;
      if (normal >= normals_.size())
        text_.fail({"missing_target", "a face", "a normal"});
      for (std::size_t axis = 0; axis < 3; ++axis)
        numbers[3 * vertex + axis] = static_cast<float>(normals_[normal][axis]);
    }
    return numbers;
  }

  MeshText text_;
  MeshBuilder builder_;
  std::vector<Corner> normals_;
  std::vector<std::uint32_t> normal_of_; // by vertex
  bool has_normals_ = true;
  std::vector<std::uint32_t> corners_;
};

struct CornerHash {
  std::size_t
  operator()(const Corner& place) const
  {
    std::size_t hash = 0;
    for (const double coordinate : place)
      hash = 1000003 * hash + std::hash<double>()(coordinate);
    return hash;
  }
};

/** Gives places numbers in the order in which they come. */
class PlaceNumbers {
public:
  explicit PlaceNumbers(MeshBuilder& builder)
      : builder_(builder)
  {
  }

  std::uint32_t
  numberVertex(Corner place)
  {
    for (double& coordinate : place)
      coordinate += 0.0; // -0 is 0
    const auto [at, is_new] =
        numbers_.insert({place, static_cast<std::uint32_t>(builder_.countVertices())});
    if (is_new)
      builder_.addVertex(place);
    return at->second;
  }

private:
  MeshBuilder& builder_;
  std::unordered_map<Corner, std::uint32_t, CornerHash> numbers_;
};

constexpr std::size_t stl_header = 84, stl_triangle = 50;

bool
isBinaryStl(const std::string& path)
{
  const InputFile file(path);
  const std::string head = file.head(stl_header);
  std::uint32_t count = 0;
  if (head.size() < stl_header)
    return false;
  std::memcpy(&count, &head[stl_header - sizeof(count)], sizeof(count));
  // Binary files may begin with "solid" as well.
  return file.getSize() == stl_header + stl_triangle * std::uint64_t{count} ||
         head.rfind("solid", 0) != 0;
}

void
checkFinite(const std::string& path, const Corner& place)
{
  for (const double coordinate : place)
    if (!std::isfinite(coordinate))
      throwUnreadable(path, {"invalid_part", "a corner of a triangle"});
}

LoadedMesh
readBinaryStl(const std::string& path)
{
  FileCursor cursor(path);
  cursor.skip(stl_header - sizeof(std::uint32_t));
  std::uint32_t count = 0;
  std::memcpy(&count, cursor.take(sizeof(count)), sizeof(count));
  MeshBuilder builder(path);
  PlaceNumbers places(builder);
  for (std::uint32_t i = 0; i < count; ++i) {
    const char* const bytes = cursor.take(stl_triangle);
    if (bytes == nullptr)
      throwUnreadable(path, {"truncated_rows", count, "triangles", i});
    std::array<float, 12> numbers; // the normal comes first
    std::memcpy(numbers.data(), bytes, sizeof(numbers));
    std::vector<std::uint32_t> corners;
    for (std::size_t k = 3; k < numbers.size(); k += 3) {
      const Corner place = {numbers[k], numbers[k + 1], numbers[k + 2]};
      checkFinite(path, place);
      corners.push_back(places.numberVertex(place));
    }
    builder.addPolygon(corners);
  }
  return builder.build();
}

LoadedMesh
readTextStl(const std::string& path)
{
  MeshText text(path);
  MeshBuilder builder(path);
  PlaceNumbers places(builder);
  std::vector<std::uint32_t> corners;
  Words words;
  bool has_end = false;
  while (text.next(words)) {
    has_end = words[0] == "endsolid";
    if (words[0] == "vertex") {
      const Corner place = text.takeNumbers(words, 1);
      checkFinite(path, place);
      corners.push_back(places.numberVertex(place));
    }
    else if (words[0] == "endfacet") {
      if (corners.size() != 3)
        text.fail({"wrong_count", "a facet", corners.size(), "corners", 3});
      builder.addPolygon(corners);
      corners.clear();
    }
  }
  if (!has_end)
    throwUnreadable(path, {"missing_part", "endsolid at its end"});
  return builder.build();
}

} // namespace

LoadedMesh
readObj(const std::string& path)
{
  return ObjReader(path).read();
}

LoadedMesh
readOff(const std::string& path)
{
  MeshText text(path);
  Words words;
  if (!text.next(words) || (words[0] != "OFF" && words[0] != "COFF"))
    throwUnreadable(path, {"wrong_start", "an OFF file", "OFF"});
  words.erase(words.begin()); // counts may follow in the same line
  if (words.empty() && !text.next(words))
    throwUnreadable(path, {"nothing_inside", "vertices"});
  if (words.size() < 2)
    text.fail({"incomplete_entry", "a header", "the numbers of vertices and faces"});
  const std::uint64_t vertices = text.takeCount(words[0]),
                      faces = text.takeCount(words[1]);
  MeshBuilder builder(path);
  const auto take = [&](const char* what) {
    if (!text.next(words))
      throwUnreadable(path, {"truncated_part", std::string("its list of ") + what});
  };
  for (std::uint64_t i = 0; i < vertices; ++i) {
    take("vertices");
    builder.addVertex(text.takeNumbers(words, 0));
  }
  std::vector<std::uint32_t> corners;
  for (std::uint64_t i = 0; i < faces; ++i) {
    take("faces");
    const std::uint64_t count = text.takeCount(words[0]);
    if (count < 3 || count >= words.size())
      text.fail({"incomplete_entry",
                 "a face",
                 "at least three corners, and as many as it promises"});
    corners.clear();
    for (std::size_t k = 1; k <= count; ++k) {
      const std::uint64_t corner = text.takeCount(words[k]);
      if (corner >= vertices)
        text.fail({"missing_target", "a face", "a vertex"});
      corners.push_back(static_cast<std::uint32_t>(corner));
    }
    builder.addPolygon(corners);
  }
  return builder.build();
}

LoadedMesh
readStl(const std::string& path)
{
  LoadedMesh mesh = isBinaryStl(path) ? readBinaryStl(path) : readTextStl(path);
  mesh.vertices.double_coordinates = false;
  return mesh;
}

std::uint64_t
countCorners(const std::string& path, const std::vector<double>& ends)
{
  double begin = 0.0;
  for (const double end : ends) {
    if (!(end >= begin && end <= 0x1p53))
      throwUnreadable(path, {"disagreeing_parts", "the offsets of its cells"});
    begin = end;
  }
  return static_cast<std::uint64_t>(begin);
}

void
addFans(const std::string& path,
        const std::vector<double>& ends,
        const std::vector<double>& corners,
        std::uint64_t points,
        std::uint64_t first,
        std::vector<Triangle>& triangles)
{
  const auto vertex = [&](std::size_t corner) {
    if (!(corners[corner] >= 0.0 && corners[corner] < static_cast<double>(points)))
      throwUnreadable(path, {"missing_target", "a polygon", "a point"});
    return static_cast<std::uint32_t>(first +
                                      static_cast<std::uint64_t>(corners[corner]));
  };
  std::size_t start = 0;
  for (const double end : ends) {
    for (std::size_t k = start + 2; k < static_cast<std::size_t>(end); ++k)
      triangles.push_back({vertex(start), vertex(k - 1), vertex(k)});
    start = static_cast<std::size_t>(end);
  }
}

} // namespace io
} // namespace pcl_uvol
